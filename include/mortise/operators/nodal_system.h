// The bulk of a scene without a matrix, in values at nodes: its levels, the
// product with the stiffness, loads, and the way back to hierarchical
// coefficients. It never solves.
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/operators/elasticity.h>
#include <mortise/operators/nodal_level.h>

#include <memory>
#include <vector>

namespace mortise
{
  class NodalSystem
  {
  public:
    /// What the constructor reads and does not keep.
    struct Scene
    {
      const DisplacementNumbering             &numbering;
      const dealii::AffineConstraints<double> &constraints; ///< of the scene
      const std::vector<Coupling>             &couplings;
    };

    /// The traces of the couplings have the nodes of @p spaces. Collective;
    /// throws InputError for tangled cells.
    NodalSystem(NodalSpaces spaces, const Scene &scene, MPI_Comm comm);

    /// The finest first.
    const std::vector<NodalLevel> &
    levels() const
    {
      return all_levels;
    }

    /// dst = K src; zero where src is held. Collective.
    void
    apply_stiffness(Vector &dst, const Vector &src) const;

    /// diag(K), 1 where held.
    const LevelVector<double> &
    diagonal() const
    {
      return stiffness_diagonal;
    }

    /// int b.v + int t.v less the work of prescribed displacements; zero where
    /// held. @p loads: by body. Collective.
    void
    assemble_load(const std::vector<Loads> &loads,
                  const Scene              &scene,
                  Vector                   &load) const;

    /// B without the columns of prescribed components, which hanging nodes
    /// bring in. Collective.
    void
    drop_held_columns(SparseMatrix &coupling) const;

    /// Hierarchical coefficients in the numbering of the scene's bodies, one
    /// per dof of each owned cell: calls set(body, dof, value). Prescribed ones
    /// are left out. @p displacement: values at nodes. Collective.
    void
    for_each_coefficient(
      const Vector                            &displacement,
      const std::function<void(unsigned int                    body,
                               dealii::types::global_dof_index dof,
                               double value)> &set) const;

  private:
    void
    subtract_prescribed(const Scene &scene, LevelVector<double> &load) const;

    std::vector<NodalLevel>                all_levels;
    std::unique_ptr<LevelOperator<double>> stiffness;
    LevelVector<double>                    stiffness_diagonal;
    mutable LevelVector<double>            in, out;
  };
} // namespace mortise
