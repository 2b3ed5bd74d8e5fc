// Products with sparse matrices: members of SparseMatrix.
#include <deal.II/base/mpi.h>

#include <mortise/base/sparse_matrix.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// dst = A src, the components of an index one after the other.
    template <unsigned int n>
    void
    multiply_rows(const SparseMatrix &A, double *dst, const double *src)
    {
      for (unsigned int i = 0; i < A.n_rows(); ++i, dst += n)
        {
          const auto row     = A.row(i);
          double     sums[n] = {};
          for (unsigned int k = 0; k < row.length; ++k)
            for (unsigned int c = 0; c < n; ++c)
              sums[c] += row.values[k] * src[n * row.columns[k] + c];
          std::copy_n(sums, n, dst);
        }
    }

    /// dst += A^T src.
    template <unsigned int n>
    void
    multiply_rows_transposed(const SparseMatrix &A,
                             double             *dst,
                             const double       *src)
    {
      for (unsigned int i = 0; i < A.n_rows(); ++i, src += n)
        {
          const auto row = A.row(i);
          for (unsigned int k = 0; k < row.length; ++k)
            for (unsigned int c = 0; c < n; ++c)
              dst[n * row.columns[k] + c] += row.values[k] * src[c];
        }
    }
  } // namespace

  void
  SparseMatrix::multiply(double *dst, const double *of_columns) const
  {
    if (n_components == 1)
      multiply_rows<1>(*this, dst, of_columns);
    else
      multiply_rows<dim>(*this, dst, of_columns);
  }

  void
  SparseMatrix::multiply_transposed_add(double       *of_columns,
                                        const double *src) const
  {
    if (n_components == 1)
      multiply_rows_transposed<1>(*this, of_columns, src);
    else
      multiply_rows_transposed<dim>(*this, of_columns, src);
  }

  std::vector<double>
  SparseMatrix::on_columns(const double *of_owned) const
  {
    const unsigned int  n = n_components;
    std::vector<double> result(n * n_columns());
    double             *to = result.data() + n * n_below;
    for (const unsigned int k : owned)
      to = std::copy_n(of_owned + n * k, n, to);
    if (layout->n_mpi_processes() == 1)
      return result;
    std::vector<double> ghosts(layout->n_ghost_indices()),
      sent(layout->n_import_indices());
    std::vector<MPI_Request> requests;
    layout->export_to_ghosted_array_start<double, MemorySpace::Host>(
      0,
      ArrayView<const double>(of_owned, layout->locally_owned_size()),
      make_array_view(sent),
      make_array_view(ghosts),
      requests);
    layout->export_to_ghosted_array_finish<double, MemorySpace::Host>(
      make_array_view(ghosts), requests);
    std::copy_n(ghosts.begin(), n * n_below, result.begin());
    std::copy(ghosts.begin() + n * n_below, ghosts.end(), to);
    return result;
  }

  void
  SparseMatrix::add_to_owned(double                    *of_owned,
                             const std::vector<double> &values) const
  {
    const unsigned int n    = n_components;
    const double      *from = values.data() + n * n_below;
    for (const unsigned int k : owned)
      for (unsigned int c = 0; c < n; ++c)
        of_owned[n * k + c] += *from++;
    if (layout->n_mpi_processes() == 1)
      return;
    std::vector<double> ghosts(values.begin(), values.begin() + n * n_below),
      received(layout->n_import_indices());
    ghosts.insert(ghosts.end(),
                  values.begin() + n * (n_below + owned.size()),
                  values.end());
    std::vector<MPI_Request> requests;
    layout->import_from_ghosted_array_start<double, MemorySpace::Host>(
      VectorOperation::add,
      0,
      make_array_view(ghosts),
      make_array_view(received),
      requests);
    layout->import_from_ghosted_array_finish<double, MemorySpace::Host>(
      VectorOperation::add,
      ArrayView<const double>(received.data(), received.size()),
      ArrayView<double>(of_owned, layout->locally_owned_size()),
      make_array_view(ghosts),
      requests);
  }
} // namespace mortise
