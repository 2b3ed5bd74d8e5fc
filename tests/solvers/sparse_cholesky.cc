// Proves that the sparse Cholesky factorisation solves to the precision of its
// numbers, whatever the scaling, shape and number of parts of the matrix, on
// every number of ranks, and that it tells a matrix that is not positive
// definite.
#include <deal.II/base/mpi.h>

#include <Epetra_MpiComm.h>
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

    Epetra_CrsMatrix
    matrix() const
    {
      const Epetra_MpiComm comm(MPI_COMM_WORLD);
      const Epetra_Map     map(size(), 0, comm);
      Epetra_CrsMatrix     result(Copy, map, 0);
      for (int local = 0; local < map.NumMyElements(); ++local)
        {
          const int row = map.GID(local), point = row / block,
                    part = point / (n * n), x = point % n, y = point / n % n;
          for (int i = std::max(x - 1, 0); i <= std::min(x + 1, n - 1); ++i)
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, n - 1); ++j)
              for (int c = 0; c < block; ++c)
                {
                  int column = (part * n * n + j * n + i) * block + c;
                  // what couples a row with another is symmetric in both
                  const int    key   = row + column;
                  const double value = (row == column ? 9. * block + shift :
                                                        -1. + (key % 7) / 10.) *
                                       scale(row) * scale(column);
                  result.InsertGlobalValues(row, 1, &value, &column);
                }
        }
      result.FillComplete();
      return result;
    }
  };

  template <typename Number>
  void
  check(const std::string &name, const Grids &grids, const double accuracy)
  {
    const Epetra_CrsMatrix matrix = grids.matrix();
    SparseCholesky<Number> inverse;
    say(name + ": positive definite",
        inverse.initialize(rows_as_nodes(matrix), MPI_COMM_WORLD) ? 0 : 1,
        0);
    Epetra_Vector x(matrix.RowMap()), b(x), y(x);
    for (int i = 0; i < x.MyLength(); ++i)
      x[i] = std::sin(1. + matrix.GRID(i)) / grids.scale(matrix.GRID(i));
    matrix.Multiply(false, x, b);
    for (unsigned int twice = 0; twice < 2; ++twice)
      inverse.solve(y, b);
    double error = 0.;
    for (int i = 0; i < x.MyLength(); ++i)
      error =
        std::max(error, std::fabs(y[i] - x[i]) * grids.scale(matrix.GRID(i)));
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
