// A symmetric matrix in block compressed row format (BCSR) with a 3 x 3 block
// per pair of nodes, and its assembly.
#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/base/partitioner.h>

#include <mortise/base/sparse_matrix.h>

#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

namespace mortise
{
  /// Rows and columns of constrained components are zero.
  struct BlockCsrMatrix
  {
    /// Component c of node n has index 3 n + c. Ghosts: the columns of owned
    /// rows, and those given to finish().
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<std::size_t>  begin;   ///< by owned node
    std::vector<unsigned int> columns; ///< local nodes
    /// Nine per column, entry (r, c) at 3 c + r.
    std::vector<double> values;

    unsigned int
    size() const
    {
      return begin.size() - 1;
    }
  };

  /// Indices of owned components that are constrained.
  std::vector<unsigned int>
  constrained_components(const BlockCsrMatrix &blocks);

  /// The same matrix by rows; constrained components have a diagonal as large
  /// as others. Collective.
  SparseMatrix
  as_sparse_matrix(const BlockCsrMatrix &blocks);

  /// Assembles rows of any nodes, first their sparsity, then their values, and
  /// sends them to their owners.
  class BlockCsrMatrixBuilder
  {
  public:
    using Index = dealii::types::global_dof_index;

    /// @p owned: a contiguous range.
    BlockCsrMatrixBuilder(const dealii::IndexSet &owned, MPI_Comm comm);

    /// A number for a node here, to be used below.
    unsigned int
    local_number(Index node);

    /// Each of @p rows with each of @p columns.
    void
    couple(const std::vector<unsigned int> &rows,
           const std::vector<unsigned int> &columns);

    /// Each of @p nodes with each other and itself.
    void
    couple(const std::vector<unsigned int> &nodes)
    {
      couple(nodes, {});
    }

    /// Ends the sparsity pattern. Collective.
    void
    close();

    /// Nine entries as in BlockCsrMatrix, for a pair that was coupled.
    double *
    block(unsigned int row, unsigned int column);

    /// Move the matrix out. @p ghosts: further ghost nodes of its vectors.
    /// Collective.
    BlockCsrMatrix
    finish(const dealii::IndexSet &ghosts);

  private:
    bool
    is_owned(const Index node) const
    {
      return node >= first && node < first + n_owned;
    }
    Index
    node(const unsigned int index) const
    {
      return index < n_owned ? first + index : others[index - n_owned];
    }
    /// Rows and columns that couple, from begin on in members.
    struct Group
    {
      std::size_t  begin;
      unsigned int n_rows, n_columns; ///< no columns: the rows themselves
    };

    void
    unite_groups();
    void
    exchange_pattern();

    dealii::IndexSet                        owned;
    MPI_Comm                                comm;
    Index                                   first = 0, n_owned = 0;
    std::vector<Index>                      others; ///< nodes, by index
    std::unordered_map<Index, unsigned int> index_of_other;
    std::vector<Group>                      groups;  ///< before close()
    std::vector<unsigned int>               members; ///< of groups, indices
    std::vector<std::size_t>                begin;   ///< by index
    std::vector<unsigned int>               columns; ///< indices
    std::vector<double>                     values;
    /// By rank: rows that it gets, and pairs of which it sends blocks.
    std::map<unsigned int, std::vector<unsigned int>> sent_rows;
    std::map<unsigned int, std::vector<unsigned int>> received_rows;
    std::map<unsigned int, std::vector<unsigned int>> received_columns;
  };
} // namespace mortise
