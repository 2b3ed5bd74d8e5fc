// Products with B and B^T by dense blocks: a block is the rows of one entity of
// the slave's mesh, and stands once for all components where they have the same
// entries. It never looks at other matrices.
#pragma once

#include <deal.II/base/aligned_vector.h>

#include <Epetra_Vector.h>
#include <mortise/operators/block_system.h>
#include <mortise/solvers/epetra_tools.h>

#include <memory>
#include <vector>

namespace mortise
{
  template <typename Number>
  class CouplingProduct
  {
  public:
    /// Collective.
    explicit CouplingProduct(const BlockSystem &system);

    /// The owned displacements that multipliers of any rank move.
    const std::vector<unsigned int> &
    places() const
    {
      return moved;
    }

    /// A vector with one entry for each of places(), in their order.
    void
    initialize(LevelVector<Number> &trace) const
    {
      trace.reinit(layout);
    }

    /// jump = B u, @p trace the values of u at places(). Collective.
    void
    multiply(Epetra_Vector &jump, const LevelVector<Number> &trace) const;

    /// @p trace = the values of B^T y at places(); it is zero elsewhere.
    /// Collective.
    void
    multiply_transposed(LevelVector<Number> &trace,
                        const Epetra_Vector &y) const;

  private:
    /// Rows with the same columns, or three times as many: those of one
    /// component after the other.
    struct Block
    {
      int                                    n_rows = 0;
      std::vector<int>                       first_row; ///< by component
      std::vector<std::vector<unsigned int>> columns;   ///< of traces, likewise
    };

    /// The entry of a trace for each local column of the matrix.
    std::vector<unsigned int>
    make_layout(const Epetra_CrsMatrix      &matrix,
                const std::vector<RowGroup> &groups,
                const BlockSystem           &system);
    void
    make_blocks(const Epetra_CrsMatrix          &matrix,
                const std::vector<RowGroup>     &groups,
                const std::vector<unsigned int> &entry_of_column);
    template <unsigned int n_components>
    void
    multiply_block(const Block   &block,
                   const Number  *entries,
                   const Number  *trace,
                   Epetra_Vector &jump) const;
    template <unsigned int n_components>
    void
    multiply_block_transposed(const Block         &block,
                              const Number        *entries,
                              Number              *trace,
                              const Epetra_Vector &y) const;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<unsigned int>                                  moved;
    std::vector<Block>                                         blocks;
    dealii::AlignedVector<Number>         entries; ///< by block, rows padded
    mutable dealii::AlignedVector<Number> workspace;
  };
} // namespace mortise
