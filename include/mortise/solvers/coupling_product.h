// Products with B and B^T by dense blocks: a block is the rows of one entity of
// the slave's mesh, and stands once for all components where they have the same
// entries. It never looks at other matrices.
#pragma once

#include <deal.II/base/aligned_vector.h>

#include <Epetra_Vector.h>
#include <mortise/operators/block_system.h>

#include <array>
#include <vector>

namespace mortise
{
  template <typename Number>
  class CouplingProduct
  {
  public:
    /// Collective.
    explicit CouplingProduct(const BlockSystem &system);

    /// A vector on the displacements, with room for those of others that
    /// multiply() needs.
    void
    initialize(LevelVector<Number> &u) const
    {
      u.reinit(layout);
    }

    /// Places of owned displacements that multipliers of any rank move.
    const std::vector<unsigned int> &
    places() const
    {
      return moved;
    }

    /// jump = B u; of @p u only values at places() are read. Collective.
    void
    multiply(Epetra_Vector &jump, const LevelVector<Number> &u) const;

    /// f = B^T y at places(); other entries are left alone. Collective.
    void
    multiply_transposed(LevelVector<Number> &f, const Epetra_Vector &y) const;

  private:
    /// Rows with the same columns, or three times as many: those of one
    /// component after the other.
    struct Block
    {
      int                                    n_rows = 0;
      std::vector<int>                       first_row; ///< by component
      std::vector<std::vector<unsigned int>> columns;   ///< places, likewise
    };

    void
    make_blocks(const Epetra_CrsMatrix &matrix);
    template <unsigned int n_components>
    void
    multiply_block(const Block   &block,
                   const Number  *entries,
                   const Number  *u,
                   Epetra_Vector &jump) const;
    template <unsigned int n_components>
    void
    multiply_block_transposed(const Block         &block,
                              const Number        *entries,
                              Number              *f,
                              const Epetra_Vector &y) const;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<unsigned int>                                  moved;
    std::vector<Block>                                         blocks;
    dealii::AlignedVector<Number>         entries; ///< by block, rows padded
    mutable dealii::AlignedVector<Number> workspace;
  };
} // namespace mortise
