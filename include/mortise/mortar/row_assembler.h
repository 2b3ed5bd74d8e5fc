// Assembly of dense blocks into a sparse matrix, where each row and column of a
// block expands into global ones.
#pragma once

#include <deal.II/base/index_set.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/base/sparse_matrix.h>

#include <map>
#include <vector>

namespace mortise
{
  /// Local functions in global ones: function i is sum_e weight[e] index[e],
  /// begin[offset + i] <= e < begin[offset + i + 1].
  struct Expansion
  {
    const std::vector<unsigned int>                    &begin;
    const std::vector<dealii::types::global_dof_index> &index;
    const std::vector<double>                          &weight;
    unsigned int                                        offset;
  };

  /// An Expansion that owns its numbers, filled function by function.
  class ExpansionList
  {
  public:
    ExpansionList() = default;

    /// The given @p functions of @p all.
    ExpansionList(const Expansion                 &all,
                  const std::vector<unsigned int> &functions)
    {
      for (const unsigned int i : functions)
        {
          for (unsigned int e = all.begin[all.offset + i];
               e < all.begin[all.offset + i + 1];
               ++e)
            add(all.index[e], all.weight[e]);
          close();
        }
    }

    /// Add a term to the present function.
    void
    add(const dealii::types::global_dof_index term, const double factor)
    {
      index.push_back(term);
      weight.push_back(factor);
    }

    /// End the present function.
    void
    close()
    {
      begin.push_back(index.size());
    }

    void
    clear()
    {
      begin = {0};
      index.clear();
      weight.clear();
    }

    /// Number of functions.
    unsigned int
    size() const
    {
      return begin.size() - 1;
    }

    bool
    has_terms() const
    {
      return !index.empty();
    }

    Expansion
    operator()() const
    {
      return {begin, index, weight, 0};
    }

  private:
    std::vector<unsigned int>                    begin{0};
    std::vector<dealii::types::global_dof_index> index;
    std::vector<double>                          weight;
  };

  /// Adds sum_ij (row expansion of i) block_ij (column expansion of j): first
  /// record the sparsity of all blocks, then add their entries.
  class RowAssembler
  {
  public:
    /// Owned ranges of the matrix, contiguous and rank by rank. Expansions are
    /// in nodes of @p n_components rows and columns each.
    RowAssembler(const dealii::IndexSet &rows,
                 const dealii::IndexSet &columns,
                 unsigned int            n_components = 1);

    void
    record(const Expansion &row,
           unsigned int     n_rows,
           const Expansion &column,
           unsigned int     n_columns);

    /// To be called after the last record() and before the first add().
    void
    allocate();

    /// Adds factor times @p block or its transpose; its rows and columns are
    /// those of the first component, then those of the second.
    void
    add(const Expansion                  &row,
        const Expansion                  &column,
        const dealii::FullMatrix<double> &block,
        double                            factor,
        bool                              transposed);

    /// The sum; @p n_shared: SparseMatrix's n_components. Collective.
    SparseMatrix
    create(MPI_Comm comm, unsigned int n_shared = 1);

  private:
    using Index = dealii::types::global_dof_index;
    int
    find(Index row) const;
    unsigned int
    find_or_insert(Index row);
    /// Positions of @p wanted in @p pattern, mostly the same as in the last
    /// call with this @p guess, for another component of the same block.
    const std::vector<unsigned int> &
    find_positions(const std::vector<Index> &wanted,
                   const std::vector<Index> &pattern,
                   unsigned int              guess);

    const dealii::IndexSet &rows, &columns;
    unsigned int            n_components;
    dealii::IndexSet        nodes;    ///< owned, of rows
    std::vector<int> number_of_owned; ///< by owned node; -1: not recorded
    std::map<Index, unsigned int>   number_of_other;
    std::vector<std::vector<Index>> sets; ///< columns of one record()
    /// By recorded node of rows: its sets, until allocate().
    std::vector<std::vector<unsigned int>> sets_of;
    std::vector<std::vector<Index>>        patterns;   ///< columns, ascending
    std::vector<unsigned int>              pattern_of; ///< by recorded node
    std::vector<std::size_t> begin; ///< of values, by recorded node
    std::vector<double>      values;
    std::vector<std::vector<unsigned int>> guesses; ///< see find_positions()
  };
} // namespace mortise
