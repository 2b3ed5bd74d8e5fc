// Proves that the sparse Cholesky factorisation solves to the precision of its
// numbers, whatever the scaling, shape and number of parts of the matrix, on
// every number of ranks, and that it tells a matrix that is not positive
// definite.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/factorisation/sparse_cholesky.h>
#include <verdict.h>

#include <cmath>

using namespace mortise;

namespace
{
  bool
  on_first_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  void
  say(const std::string &what, const double got, const double allowed)
  {
    if (on_first_rank())
      verdict(what, got, allowed);
  }

  /// A difference star with full blocks of @p block rows on @p parts separate
  /// grids of @p n x @p n points; rows are scaled by up to 10^decades.
  struct Grids
  {
    int    n, parts, block;
    double decades, shift;

    int
    size() const
    {
      return parts * n * n * block;
    }

    double
    scale(const int row) const
    {
      return std::pow(10., decades * ((row * 37) % 101) / 100.);
    }

    SparseMatrix
    matrix() const
    {
      using namespace dealii::Utilities::MPI;
      const int n_ranks = n_mpi_processes(MPI_COMM_WORLD),
                rank    = this_mpi_process(MPI_COMM_WORLD),
                first   = size() * rank / n_ranks,
                end     = size() * (rank + 1) / n_ranks;
      const auto owned  = owned_range(end - first, MPI_COMM_WORLD);
      std::vector<SparseMatrix::Entry> entries;
      for (int row = first; row < end; ++row)
        {
          const int point = row / block, part = point / (n * n), x = point % n,
                    y = point / n % n;
          for (int i = std::max(x - 1, 0); i <= std::min(x + 1, n - 1); ++i)
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, n - 1); ++j)
              for (int c = 0; c < block; ++c)
                {
                  const int column = (part * n * n + j * n + i) * block + c;
                  // what couples a row with another is symmetric in both
                  const int    key   = row + column;
                  const double value = (row == column ? 9. * block + shift :
                                                        -1. + (key % 7) / 10.) *
                                       scale(row) * scale(column);
                  entries.push_back({static_cast<unsigned int>(row),
                                     static_cast<unsigned int>(column),
                                     value});
                }
        }
      return SparseMatrix(owned, owned, MPI_COMM_WORLD, entries);
    }
  };

  template <typename Number>
  void
  check(const std::string &name, const Grids &grids, const double accuracy)
  {
    const SparseMatrix     matrix = grids.matrix();
    SparseCholesky<Number> inverse;
    say(name + ": positive definite",
        inverse.initialize(rows_as_nodes(matrix), MPI_COMM_WORLD) ? 0 : 1,
        0);
    std::vector<double> x, b(matrix.n_rows()), y(b);
    for (unsigned int i = 0; i < b.size(); ++i)
      x.push_back(std::sin(1. + matrix.global_row(i)) /
                  grids.scale(matrix.global_row(i)));
    matrix.vmult(b.data(), x.data());
    for (unsigned int twice = 0; twice < 2; ++twice)
      inverse.solve(y.data(), b.data());
    double error = 0.;
    for (unsigned int i = 0; i < x.size(); ++i)
      error =
        std::max(error,
                 std::fabs(y[i] - x[i]) * grids.scale(matrix.global_row(i)));
    say(name, dealii::Utilities::MPI::max(error, MPI_COMM_WORLD), accuracy);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const double decades : {0., 6.})
    {
      const std::string end = decades > 0. ? ", scaled" : "";
      check<double>("one grid" + end, {23, 1, 3, decades, 0.}, 1e-13);
      check<double>("three grids" + end, {12, 3, 2, decades, 0.}, 1e-13);
      check<float>("three grids, single" + end, {12, 3, 2, decades, 0.}, 1e-5);
      check<double>("seventy grids" + end, {2, 70, 4, decades, 0.}, 1e-13);
      check<double>("a dense matrix" + end, {2, 1, 20, decades, 0.}, 1e-13);
      check<double>("one row" + end, {1, 1, 1, decades, 0.}, 1e-15);
    }
  for (const double shift : {-30., -22.})
    {
      SparseCholesky<double> inverse;
      const Grids            grids{15, 2, 3, 0., shift};
      say("shift " + std::to_string(static_cast<int>(shift)) +
            ": not positive definite",
          inverse.initialize(rows_as_nodes(grids.matrix()), MPI_COMM_WORLD) ?
            1 :
            0,
          0);
    }
}
