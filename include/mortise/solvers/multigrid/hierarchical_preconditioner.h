// An approximate inverse of the elasticity block A = K + J that uses the
// hierarchy of the element: algebraic multigrid on the vertex functions, block
// smoothers on the higher modes, for scenes with degrees above one. All
// corrections stay among what satisfies the constraint.
#pragma once

#include <mortise/solvers/multigrid/bulk_preconditioner.h>

#include <memory>
#include <string>

namespace mortise
{
  class HierarchicalPreconditioner : public BulkPreconditioner
  {
  public:
    HierarchicalPreconditioner();
    ~HierarchicalPreconditioner() override;

    bool
    initialize(const BlockSystem &system) override;

    bool
    update_active() override;

    void
    vmult(Vector &dst, const Vector &src) const override;

    /// With the lifting by the patches of the smoother.
    const Vector &
    spring_multipliers() const override;

    const ConstraintProjector *
    projector() const override;

    std::string
    description() const override;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace mortise
