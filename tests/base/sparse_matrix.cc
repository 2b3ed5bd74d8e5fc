// Proves that products with a sparse matrix and its transpose, for one and
// three unknowns of an index, rows of other ranks and entries that others add
// are those of the matrix, whichever rank owns what, one without rows included.
#include <deal.II/base/mpi.h>

#include <mortise/base/sparse_matrix.h>
#include <verdict.h>

#include <cmath>

using namespace dealii;
using mortise::owned_range;

namespace
{
  using Matrix = mortise::SparseMatrix;
  using Index  = Matrix::Index;

  constexpr Index n_rows = 13, n_columns = 21;

  bool
  has_entry(const Index i, const Index j)
  {
    return (5 * i + 3 * j) % 7 < 2 && j != 4;
  }

  double
  value(const Index i, const Index j)
  {
    return has_entry(i, j) ? std::cos(3. * i + j) : 0.;
  }

  double
  given(const Index i, const unsigned int c)
  {
    return std::sin(1. + i + 0.3 * c);
  }

  /// By owned index and component.
  std::vector<double>
  vector(const IndexSet &owned, const unsigned int n)
  {
    std::vector<double> result;
    for (const Index i : owned)
      for (unsigned int c = 0; c < n; ++c)
        result.push_back(given(i, c));
    return result;
  }

  void
  say(const std::string &what, const double error)
  {
    const double largest = Utilities::MPI::max(error, MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      verdict(what, largest, 1e-14);
  }

  /// The largest difference from A @p given, or from its transpose.
  double
  error(const IndexSet            &owned,
        const std::vector<double> &got,
        const unsigned int         n,
        const bool                 transposed)
  {
    double       worst = 0.;
    unsigned int next  = 0;
    for (const Index i : owned)
      for (unsigned int c = 0; c < n; ++c)
        {
          double sum = 0.;
          for (Index j = 0; j < (transposed ? n_rows : n_columns); ++j)
            sum += (transposed ? value(j, i) : value(i, j)) * given(j, c);
          worst = std::max(worst, std::abs(got[next++] - sum));
        }
    return worst;
  }

  void
  check(const IndexSet &rows, const IndexSet &columns, const unsigned int n)
  {
    const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
                       size = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    std::vector<Matrix::Entry> halves, all;
    for (Index i = 0; i < n_rows; ++i)
      for (Index j = 0; j < n_columns; ++j)
        if (has_entry(i, j))
          {
            for (unsigned int half = 0; half < 2; ++half)
              if ((i + 2 * j + half) % size == rank)
                halves.push_back({i, j, 0.5 * value(i, j)});
            all.push_back({i, j, value(i, j)});
          }
    const std::string name =
      n == 1 ? "" : ", " + std::to_string(n) + " components";
    for (const bool added : {true, false})
      {
        const Matrix A =
          added ?
            Matrix(
              rows, columns, MPI_COMM_WORLD, halves, VectorOperation::add, n) :
            Matrix(
              rows, columns, MPI_COMM_WORLD, all, VectorOperation::insert, n);
        std::vector<double> product(n * A.n_rows()),
          transposed(n * columns.n_elements());
        A.vmult(product.data(), vector(columns, n).data());
        A.Tvmult_add(transposed.data(), vector(rows, n).data());
        const std::string what = (added ? "added" : "inserted") + name;
        say(what + ", A u", error(rows, product, n, false));
        say(what + ", A^T v", error(columns, transposed, n, true));
        if (n > 1)
          continue;
        std::vector<double> again(columns.n_elements());
        A.transposed().vmult(again.data(), vector(rows, 1).data());
        say(what + ", transposed", error(columns, again, 1, true));
        std::vector<double> square(A.n_rows()), of_square(A.n_rows());
        A.times(A.transposed()).vmult(square.data(), vector(rows, 1).data());
        A.vmult(of_square.data(), transposed.data());
        double difference = 0.;
        for (unsigned int i = 0; i < square.size(); ++i)
          difference = std::max(difference, std::abs(square[i] - of_square[i]));
        say(what + ", A A^T", difference);
        const auto fetched = A.fetch({12, 0, 5, 12});
        double     worst   = fetched.begin.size() == 5 ? 0. : 1.;
        Index      k       = 0;
        for (const Index i : {12, 0, 5, 12})
          for (Index j = 0; j < n_columns; ++j)
            if (has_entry(i, j))
              {
                worst = std::max(worst,
                                 std::abs(fetched.values[k] - value(i, j)) +
                                   (fetched.columns[k] == j ? 0. : 1.));
                ++k;
              }
        say(what + ", rows of all ranks", worst);
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
                     size = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  // the second of three ranks has no row
  const Index own_rows[][3]    = {{13, 0, 0}, {6, 7, 0}, {5, 0, 8}},
              own_columns[][3] = {{21, 0, 0}, {12, 9, 0}, {4, 7, 10}};
  for (const unsigned int n : {1u, mortise::dim})
    check(owned_range(own_rows[size - 1][rank], MPI_COMM_WORLD),
          owned_range(own_columns[size - 1][rank], MPI_COMM_WORLD),
          n);
}
