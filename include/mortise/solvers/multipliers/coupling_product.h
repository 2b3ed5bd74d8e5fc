// Products with B and B^T by dense blocks of the rows of neighbouring entities
// of the slave's mesh. A block serves all components with the same entries,
// even if one lacks rows or columns at prescribed displacements. The single
// slave entry of dual multipliers is kept apart.
#pragma once

#include <deal.II/base/aligned_vector.h>

#include <mortise/operators/block_system.h>
#include <mortise/solvers/multipliers/rows_by_entity.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// T is zero for independent displacements.
  enum class CoupledNodes : unsigned char
  {
    all,
    dependent
  };

  template <typename Number>
  class CouplingProduct
  {
  public:
    /// @p rows: of system.directed_constraint(). Collective.
    CouplingProduct(const BlockSystem &system, const RowsByEntity &rows);

    /// Take the frames of the constraint, which alone have changed.
    void
    take_frames(const BlockSystem &system);

    /// The owned displacements with a column in B of any rank.
    const std::vector<unsigned int> &
    indices() const
    {
      return coupled_indices;
    }

    /// A vector with one entry for each of indices(), in their order.
    void
    initialize(LevelVector<Number> &coupled_values) const
    {
      coupled_values.reinit(layout);
    }

    /// jump = B u, @p coupled_values the values of u at indices(); nodes other than
    /// @p nodes are zero and may be left out. Collective.
    void
    multiply(Vector                    &jump,
             const LevelVector<Number> &coupled_values,
             CoupledNodes               nodes = CoupledNodes::all) const;

    /// @p coupled_values = the values of B^T y at indices(), where alone it is not zero;
    /// nodes other than @p nodes may be left out. Collective.
    void
    multiply_transposed(LevelVector<Number> &coupled_values,
                        const Vector        &y,
                        CoupledNodes         nodes = CoupledNodes::all) const;

  private:
    /// Rows by node of multipliers for all components, and the nodes of their
    /// columns.
    struct Block
    {
      std::vector<int>          rows;  ///< by node and component; -1: none
      std::vector<unsigned int> nodes; ///< among those of values
      /// The first nodes are dependent, the others independent.
      unsigned int        n_dependent = 0;
      std::vector<int>    own_node;  ///< by node: the single entry; -1: none
      std::vector<Number> own_entry; ///< likewise

      /// Entries of a row, padded.
      unsigned int
      width(CoupledNodes which) const;
    };

    /// Numbers the entries of traces.
    void
    make_layout(const BlockSystem &system, const RowsByEntity &rows);
    void
    make_blocks(const RowsByEntity      &rows,
                const std::vector<bool> &is_independent);
    /// visit(block, entries).
    template <typename Visit>
    void
    for_each_block(const Visit &visit) const;
    void
    multiply_block(const Block  &block,
                   const Number *entries,
                   double       *jump,
                   CoupledNodes  nodes) const;
    void
    multiply_block_transposed(const Block  &block,
                              const Number *entries,
                              const double *y,
                              CoupledNodes  nodes) const;

    /// Of the matrix; null without.
    const SparseMatrix         *frames = nullptr;
    mutable std::vector<double> by_component; ///< rows of B_c, with frames
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<unsigned int>                                  coupled_indices;
    std::vector<Block>                                         blocks;
    dealii::AlignedVector<Number> entries; ///< by block, rows padded
    /// Of a trace; -1: none.
    std::vector<int> entry_of_value;
    /// Displacements by node and component, 0 if prescribed.
    mutable std::vector<Number>           values;
    mutable dealii::AlignedVector<Number> workspace; ///< of one block
  };
} // namespace mortise
