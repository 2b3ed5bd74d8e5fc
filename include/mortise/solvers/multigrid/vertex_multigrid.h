// Multigrid for degree one: on the hierarchy of refined meshes, then on subsets
// of the vertices (select_vertices), with a factorisation of the coarsest
// level.
#pragma once

#include <mortise/body/spaces/thickness_coarsening.h>
#include <mortise/operators/block_system.h>
#include <mortise/operators/levels/constraint_penalty.h>

#include <memory>
#include <string>

namespace mortise
{
  template <typename Number>
  class VertexMultigrid
  {
  public:
    /// @p level: of degree one in all bodies, kept by reference.
    /// @p smooth_finest: false if the caller smooths on the finest mesh.
    /// Collective.
    VertexMultigrid(const MultigridLevel &level, bool smooth_finest);

    /// On the functions of @p thickness for the finest level of @p system,
    /// which the caller smooths. Collective.
    VertexMultigrid(const BlockSystem                    &system,
                    const ThicknessCoarsening            &thickness,
                    const std::vector<ConstraintPenalty> &jumps);
    ~VertexMultigrid();

    /// False if a matrix is not positive definite.
    bool
    is_valid() const;

    /// x = approximately (K + J)^{-1} b with vectors on the layout of the
    /// level; x is overwritten. Collective.
    void
    vmult(LevelVector<Number> &x, const LevelVector<Number> &b) const;

    std::string
    description() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace mortise
