// The rows of all ranks, for factorisation on all of them.
#pragma once

#include <mortise/solvers/factorisation/elimination_tree.h>
#include <mortise/solvers/factorisation/rows_by_node.h>
#include <mpi.h>

#include <vector>

namespace mortise
{
  struct GatheredRows : MatrixGraph
  {
    /// @p rows must stay alive, since a single rank refers to them. Collective.
    GatheredRows(const RowsByNode &rows, MPI_Comm comm);
    GatheredRows(const GatheredRows &) = delete;

    /// Values of the columns of node @p i.
    const double *
    row(const unsigned int i, const unsigned int component) const
    {
      return &values[begin_values[i]] +
             (variants[i] == 1 ?
                0 :
                std::size_t(component) * (begin[i + 1] - begin[i]));
    }

    unsigned int                          n_components;
    dealii::ArrayView<const unsigned int> variants; ///< as in RowsByNode
    std::vector<std::size_t>              begin_values;
    dealii::ArrayView<const double>       values;
    /// Scaling to diagonals of at most one, by node for all components. 0: not
    /// possible.
    std::vector<double> scale;

  private:
    RowsByNode gathered; ///< with several ranks
  };
} // namespace mortise
