// One level of the p-multigrid: its space, the layout of its vectors,
// constrained components, and the penalties of interfaces.
#pragma once

#include <deal.II/base/partitioner.h>

#include <mortise/mortar/coupling.h>
#include <mortise/operators/cells/linear_cell_matrices.h>
#include <mortise/operators/levels/jump_penalty.h>
#include <mortise/operators/levels/level_operator_base.h>
#include <mortise/operators/matrix_free/hanging_nodes.h>
#include <mortise/operators/matrix_free/matrix_free_elasticity.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// Tangents of bodies whose law is not linear.
  struct Linearisation
  {
    const MatrixFreeElasticity<double> &finest; ///< at the points of its cells
    CellModuli                          by_cell;
    /// Without it the tangent is positive in most states in which it would not
    /// be.
    bool has_initial_stress = true;
  };

  struct MultigridLevel
  {
    std::shared_ptr<const NodalSpace> space;
    /// Component c of node n has index 3 n + c. Ghosts: of owned cells.
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    /// Indices of owned components that are prescribed or hang.
    std::vector<unsigned int> constrained;
    /// Of interfaces; null without.
    std::shared_ptr<const JumpPenalties> penalties;
    /// Null where there is nothing but Hooke's law.
    std::shared_ptr<const Linearisation> linearisation;

    const CellModuli *
    cell_moduli() const
    {
      return linearisation ? &linearisation->by_cell : nullptr;
    }
  };

  /// The level of the scene on @p space, without penalties. @p numbering and
  /// @p constraints: of the scene, which constrain whole faces. Collective.
  MultigridLevel
  make_multigrid_level(std::shared_ptr<const NodalSpace>        space,
                       const FieldNumbering                    &numbering,
                       const dealii::AffineConstraints<double> &constraints,
                       MPI_Comm                                 comm);

  /// 1 at constrained components, 0 elsewhere, with ghost values; @p layout
  /// owns the same range as that of the level. Collective.
  LevelVector<double>
  constrained_components(
    const MultigridLevel                                             &level,
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout);

  /// The layout of @p level, number @p number of the scene, with the partners
  /// of owned slave faces as ghosts. Collective.
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
  interface_layout(const MultigridLevel        &level,
                   unsigned int                 number,
                   const std::vector<Coupling> &couplings);

  /// One part for each kind of interface. Collective.
  std::shared_ptr<const JumpPenalties>
  make_jump_penalties(const MultigridLevel        &level,
                      unsigned int                 number,
                      const std::vector<Coupling> &couplings);

  /// K of one level, with the tangents of its linearisation, or K + J, for
  /// vectors that are zero at constrained components.
  template <typename Number>
  class LevelOperator : public LevelOperatorBase<Number>
  {
  public:
    /// @p level is kept by reference; @p pressures as for MatrixFreeElasticity.
    /// Collective; throws InputError for tangled cells.
    LevelOperator(const MultigridLevel &level,
                  bool                  with_penalty,
                  const PressureNodes  *pressures = nullptr);

    /// dst = A src. Collective.
    void
    vmult(LevelVector<Number>       &dst,
          const LevelVector<Number> &src) const override
    {
      vmult_free(dst, src);
      this->clear_constrained(dst);
    }

    /// As vmult(), with constrained components.
    void
    vmult_free(LevelVector<Number> &dst, const LevelVector<Number> &src) const;

    void
    diagonal(LevelVector<Number> &diagonal) const override;

    const std::vector<unsigned int> &
    constrained() const override
    {
      return level.constrained;
    }

    /// Set the values of @p v at ghosts and hanging nodes. Collective.
    void
    complete(const LevelVector<Number> &v) const
    {
      v.update_ghost_values();
      // these indices hold no values of v's own, as those of ghosts
      hanging.fill(const_cast<Number *>(v.begin()));
    }

    /// Undoes complete().
    void
    release(const LevelVector<Number> &v) const
    {
      hanging.clear(const_cast<Number *>(v.begin()));
      v.zero_out_ghost_values();
    }

    /// Add the results of local products in @p v at ghosts and hanging nodes to
    /// owned nodes. Collective.
    void
    gather(LevelVector<Number> &v) const
    {
      hanging.collect(v.begin());
      v.compress(dealii::VectorOperation::add);
    }

    void
    initialize(LevelVector<Number> &v) const override
    {
      v.reinit(level.layout);
    }

    const std::vector<CellBatches<Number>> &
    cells() const
    {
      return stiffness.cells();
    }

    /// The products of this rank's cells, K alone.
    const MatrixFreeElasticity<Number> &
    elasticity() const
    {
      return stiffness;
    }

    MatrixFreeElasticity<Number> &
    elasticity()
    {
      return stiffness;
    }

  private:
    const MultigridLevel                   &level;
    MatrixFreeElasticity<Number>            stiffness;
    const HangingNodes<Number>              hanging;
    std::unique_ptr<PenaltyProduct<Number>> penalty; ///< null without
  };
} // namespace mortise
