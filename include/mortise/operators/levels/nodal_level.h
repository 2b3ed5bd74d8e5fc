// One level of the matrix-free system: its space, where its components stand in
// vectors, which are constrained, and the coupling that preconditioners see.
#pragma once

#include <deal.II/base/partitioner.h>

#include <mortise/mortar/coupling.h>
#include <mortise/operators/levels/nodal_operator.h>
#include <mortise/operators/levels/nodal_penalty.h>
#include <mortise/operators/matrix_free/hanging_nodes.h>
#include <mortise/operators/matrix_free/matrix_free_elasticity.h>

#include <memory>
#include <vector>

namespace mortise
{
  struct NodalLevel
  {
    std::shared_ptr<const NodalSpace> space;
    /// Component c of node n has index 3 n + c. Ghosts: of owned cells.
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    /// Owned components that are prescribed or hang, indices in vectors.
    std::vector<unsigned int> constrained;
    /// Of interfaces; null without.
    std::shared_ptr<const NodalPenalties> penalties;
  };

  /// The level of the scene on @p space, without penalties. @p numbering and
  /// @p constraints are those of the scene, which hold or let hang whole faces or nothing.
  /// Collective.
  NodalLevel
  make_nodal_level(std::shared_ptr<const NodalSpace>        space,
                   const FieldNumbering                    &numbering,
                   const dealii::AffineConstraints<double> &constraints,
                   MPI_Comm                                 comm);

  /// 1 where components are constrained, 0 elsewhere; with the ghost values of
  /// @p layout, which owns what that of the level does. Collective.
  LevelVector<double>
  constrained_components(
    const NodalLevel                                                 &level,
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout);

  /// The displacements of @p level, number @p number of the scene, with those of the
  /// faces that the slave faces of this rank meet as ghosts. Collective.
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
  interface_layout(const NodalLevel            &level,
                   unsigned int                 number,
                   const std::vector<Coupling> &couplings);

  /// A part for each kind of interface that there is. Collective.
  std::shared_ptr<const NodalPenalties>
  make_nodal_penalties(const NodalLevel            &level,
                       unsigned int                 number,
                       const std::vector<Coupling> &couplings);

  /// K of one level, or K + J. Vectors are zero where components are
  /// constrained, and stay so.
  template <typename Number>
  class LevelOperator : public NodalOperator<Number>
  {
  public:
    /// @p level is kept by reference; @p pressures as for MatrixFreeElasticity.
    /// Collective; throws InputError for tangled cells.
    LevelOperator(const NodalLevel    &level,
                  bool                 with_penalty,
                  const PressureNodes *pressures = nullptr);

    /// dst = A src. Collective.
    void
    vmult(LevelVector<Number>       &dst,
          const LevelVector<Number> &src) const override
    {
      vmult_free(dst, src);
      this->clear_constrained(dst);
    }

    /// As vmult(), without regard to what is constrained.
    void
    vmult_free(LevelVector<Number> &dst, const LevelVector<Number> &src) const;

    void
    diagonal(LevelVector<Number> &diagonal) const override;

    const std::vector<unsigned int> &
    constrained() const override
    {
      return level.constrained;
    }

    /// Ghost values and those of hanging nodes of the function that @p v holds.
    /// Collective.
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

    /// What local products left in @p v brought to the nodes that do not hang
    /// and to their owners. Collective.
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

  private:
    const NodalLevel                       &level;
    const MatrixFreeElasticity<Number>      stiffness;
    const HangingNodes<Number>              hanging;
    std::unique_ptr<PenaltyProduct<Number>> penalty; ///< null without
  };
} // namespace mortise
