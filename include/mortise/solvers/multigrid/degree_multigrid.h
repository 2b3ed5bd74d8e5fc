// Multigrid in the degree for a bulk without a matrix: Chebyshev smoothers on
// the degree and those of lower_degree(), the vertex functions by
// VertexMultigrid. On the finest level smoothers stay among what satisfies the
// constraint; the others see the tie by the jump penalty J of BlockSystem.
#pragma once

#include <mortise/solvers/multigrid/bulk_preconditioner.h>

namespace mortise
{
  class DegreeMultigrid : public BulkPreconditioner
  {
  public:
    /// @p max_gathered: as in SolverOptions.
    explicit DegreeMultigrid(std::size_t max_gathered);
    ~DegreeMultigrid() override;

    bool
    initialize(const BlockSystem &system) override;

    bool
    update_active() override;

    void
    vmult(Vector &dst, const Vector &src) const override;

    const Vector &
    spring_multipliers() const override;

    /// With the lifting by the diagonal of K.
    const ConstraintProjector *
    projector() const override;

    std::string
    description() const override;

  private:
    struct Implementation;
    std::size_t                     max_gathered;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace mortise
