// A sparse matrix whose rows are dealt out to the ranks.
#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/base/partitioner.h>

#include <deal.II/lac/vector_operation.h>

#include <mortise/base/types.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// The numbers 0, 1, ... over the ranks, of which this one owns @p n. Collective.
  dealii::IndexSet
  owned_range(dealii::types::global_dof_index n, MPI_Comm comm);

  /// Indices n i + c, c < n, of each i in @p set.
  dealii::IndexSet
  by_component(const dealii::IndexSet &set, unsigned int n);

  /// Indices i of a contiguous @p set of all n i + c, c < n.
  dealii::IndexSet
  nodes_of(const dealii::IndexSet &set, unsigned int n);

  /// Rows and columns are owned in contiguous ranges that ascend with the rank.
  /// A rank has its rows, and numbers the columns in which they have entries in
  /// ascending order: its columns, which other ranks may own. An entry couples
  /// n_components unknowns of its row with as many of its column, the same
  /// components with each other; in vectors those of an index stand one after
  /// the other.
  class SparseMatrix
  {
  public:
    using Index = dealii::types::global_dof_index;

    struct Entry
    {
      Index  row = 0, column = 0;
      double value = 0.;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &row &column &value;
      }
    };

    /// Entries by columns of this rank, in ascending order.
    struct Row
    {
      unsigned int  length;
      const Index  *columns;
      const double *values;
    };

    /// Without rows and columns.
    SparseMatrix() = default;

    /// @p rows, @p columns: owned. @p entries: of any rank's rows, added; or with insert those given
    /// more than once have the same value each time. Collective.
    SparseMatrix(
      const dealii::IndexSet         &rows,
      const dealii::IndexSet         &columns,
      MPI_Comm                        comm,
      const std::vector<Entry>       &entries,
      dealii::VectorOperation::values operation = dealii::VectorOperation::add,
      unsigned int                    n_components = 1);

    /// Owned rows one after the other.
    struct CompressedRows
    {
      std::vector<std::size_t> begin{0}; ///< of rows, and behind the last
      std::vector<Index>       columns;  ///< global, ascending in a row
      std::vector<double>      values;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &begin &columns &values;
      }
    };

    /// Collective.
    SparseMatrix(const dealii::IndexSet &rows,
                 const dealii::IndexSet &columns,
                 MPI_Comm                comm,
                 CompressedRows          given,
                 unsigned int            n_components = 1);

    Index
    m() const
    {
      return owned_rows.size();
    }

    Index
    n() const
    {
      return layout->size() / n_components;
    }

    /// Owned ones.
    const dealii::IndexSet &
    rows() const
    {
      return owned_rows;
    }

    unsigned int
    n_rows() const
    {
      return all.begin.size() - 1;
    }

    Index
    global_row(const unsigned int i) const
    {
      return first_row + i;
    }

    MPI_Comm
    communicator() const
    {
      return layout->get_mpi_communicator();
    }

    /// The unknowns of owned columns: numbers of vectors that the matrix is
    /// multiplied with.
    const dealii::IndexSet &
    owned_unknowns() const
    {
      return layout->locally_owned_range();
    }

    /// Columns of this rank.
    unsigned int
    n_columns() const
    {
      return column_indices.size();
    }

    Index
    global_column(const unsigned int k) const
    {
      return column_indices[k];
    }

    Row
    row(const unsigned int i) const
    {
      return {static_cast<unsigned int>(all.begin[i + 1] - all.begin[i]),
              all.columns.data() + all.begin[i],
              all.values.data() + all.begin[i]};
    }

    /// visit(owned row, column of this rank, value)
    template <typename Visit>
    void
    for_each_entry(const Visit &visit)
    {
      for (unsigned int i = 0; i < n_rows(); ++i)
        for (std::size_t k = all.begin[i]; k < all.begin[i + 1]; ++k)
          visit(i, all.columns[k], all.values[k]);
    }

    /// By owned row.
    std::vector<double>
    diagonal() const;

    /// The rows with these global numbers, of any rank. Collective.
    CompressedRows
    fetch(const std::vector<Index> &wanted) const;

    /// Collective.
    SparseMatrix
    transposed() const;

    /// The product with @p B, whose rows are dealt out as these columns, of one
    /// component both. Collective.
    SparseMatrix
    times(const SparseMatrix &B) const;

    /// dst = A src, both by owned index. Collective.
    void
    vmult(double *dst, const double *src) const
    {
      multiply(dst, on_columns(src).data());
    }

    void
    vmult(Vector &dst, const Vector &src) const
    {
      vmult(dst.begin(), src.begin());
    }

    /// dst += A^T src. Collective.
    void
    Tvmult_add(double *dst, const double *src) const
    {
      std::vector<double> values(n_components * n_columns());
      multiply_transposed_add(values.data(), src);
      add_to_owned(dst, values);
    }

    /// Values by owned index as values by column of this rank. Collective.
    std::vector<double>
    on_columns(const double *owned) const;

    /// Adds @p values by column of this rank to what is given by owned index. Collective.
    void
    add_to_owned(double *owned, const std::vector<double> &values) const;

    /// The products between on_columns() or add_to_owned() and rows.
    void
    multiply(double *dst, const double *of_columns) const;
    void
    multiply_transposed_add(double *of_columns, const double *src) const;

  private:
    /// Numbers the columns of this rank.
    void
    number_columns(const dealii::IndexSet &columns);

    dealii::IndexSet owned_rows;
    Index            first_row    = 0;
    unsigned int     n_components = 1;
    CompressedRows   all; ///< with columns of this rank
    /// Owned columns and those of this rank, by component.
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<Index>                                         column_indices;
    unsigned int              n_below = 0; ///< columns in front of owned ones
    std::vector<unsigned int> owned;       ///< those of this rank among these
  };
} // namespace mortise
