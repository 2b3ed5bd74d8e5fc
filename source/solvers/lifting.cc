// See lifting.h.
#include <mortise/solvers/lifting.h>

#include <cmath>

namespace mortise
{
  namespace
  {
    /// The largest relative correction by which a solution may be wrong. It is
    /// 3e-7 where no side is much stiffer; with a slave 1e6 times stiffer than
    /// a coarser master 2e-4 to 7e-2, and conjugate gradients came to a stop
    /// with 2e-4.
    constexpr double accurate_enough = 1e-5;

    /// By how much a second solve corrects a first one.
    double
    relative_correction(const SparseCholesky<float> &inverse,
                        const Epetra_CrsMatrix      &matrix)
    {
      Epetra_Vector b(matrix.RowMap()), x(b), r(b), y(b);
      matrix.ExtractDiagonalCopy(b);
      for (int i = 0; i < b.MyLength(); ++i)
        b[i] =
          std::sqrt(b[i]) * ((matrix.GRID(i) * 2654435761U) % 1000 / 500. - 1.);
      inverse.solve(x, b);
      matrix.Multiply(false, x, r);
      r.Update(1., b, -1.);
      inverse.solve(y, r);
      double norm_x = 0., norm_y = 0.;
      x.Norm2(&norm_x);
      y.Norm2(&norm_y);
      return norm_x > 0. ? norm_y / norm_x : 0.;
    }
  } // namespace

  void
  Lifting::factorise(const Epetra_CrsMatrix &schur, const bool single_precision)
  {
    constexpr int max_gathered = 100000;
    if (single_precision && schur.NumGlobalRows() <= max_gathered)
      {
        light = std::make_unique<SparseCholesky<float>>();
        valid = light->initialize(schur) &&
                relative_correction(*light, schur) < accurate_enough;
        if (valid)
          return;
        light.reset();
        exact = std::make_unique<SparseCholesky<double>>();
        valid = exact->initialize(schur);
        if (valid)
          return;
        exact.reset();
      }
    valid = heavy.initialize(schur, MatrixKind::positive_definite);
  }
} // namespace mortise
