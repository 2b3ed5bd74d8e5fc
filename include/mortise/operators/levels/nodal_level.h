// One level of the matrix-free system: its space, where its components stand in
// vectors, which are constrained, and the coupling that preconditioners see.
#pragma once

#include <deal.II/base/partitioner.h>

#include <mortise/mortar/coupling.h>
#include <mortise/operators/levels/nodal_operator.h>
#include <mortise/operators/matrix_free/hanging_nodes.h>
#include <mortise/operators/matrix_free/matrix_free_elasticity.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// The jump penalty sum over interfaces of gamma int [[u]].[[v]], see
  /// BlockSystem, between the nodes that this rank's slave faces and their
  /// partners have; the same for each component.
  struct NodalPenalty
  {
    /// Nodes that couple with the same others, as those inside a face do.
    struct Group
    {
      std::vector<unsigned int> rows;    ///< indices of first components
      std::vector<unsigned int> columns; ///< indices of first components
      std::vector<double>       values;  ///< row by row
    };
    std::vector<Group> groups;
  };

  struct NodalLevel
  {
    std::unique_ptr<NodalSpace> space;
    /// Component c of node n has index 3 n + c. Ghosts: of owned cells, and of
    /// the faces that the slave faces of this rank meet.
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    /// Owned components that are prescribed or hang, indices in vectors.
    std::vector<unsigned int> constrained;
    NodalPenalty              penalty;
  };

  /// Level @p number of the scene on @p space, without its penalty. @p numbering and
  /// @p constraints are those of the scene, which hold or let hang whole faces or nothing.
  /// Collective.
  NodalLevel
  make_nodal_level(std::unique_ptr<NodalSpace>              space,
                   unsigned int                             number,
                   const FieldNumbering                    &numbering,
                   const dealii::AffineConstraints<double> &constraints,
                   const std::vector<Coupling>             &couplings,
                   MPI_Comm                                 comm);

  NodalPenalty
  make_nodal_penalty(const NodalLevel            &level,
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
          const LevelVector<Number> &src) const override;

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
    const NodalLevel                  &level;
    const MatrixFreeElasticity<Number> stiffness;
    const HangingNodes<Number>         hanging;
    void
    add_penalty(const Number *src, Number *dst) const;

    dealii::AlignedVector<Number>         penalty; ///< of all groups
    mutable dealii::AlignedVector<Number> workspace;
  };
} // namespace mortise
