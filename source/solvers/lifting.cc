// See lifting.h.
#include <Epetra_Import.h>
#include <Epetra_LocalMap.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
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
                        const SparseRows            &matrix,
                        const Epetra_Map            &map)
    {
      Epetra_Vector         b(map), x(map), y(map);
      const Epetra_LocalMap everywhere(map.NumGlobalElements(), 0, map.Comm());
      Epetra_Vector         all_x(everywhere);
      const std::size_t     n = matrix.lengths.size();
      for (std::size_t i = 0, k = 0; i < n; k += matrix.lengths[i++])
        for (std::size_t l = k; l < k + matrix.lengths[i]; ++l)
          if (matrix.columns[l] == map.GID(static_cast<int>(i)))
            b[i] = std::sqrt(matrix.values[l]) *
                   ((matrix.columns[l] * 2654435761U) % 1000 / 500. - 1.);
      inverse.solve(x, b);
      all_x.Import(x, Epetra_Import(everywhere, map), Insert);
      for (std::size_t i = 0, k = 0; i < n; ++i)
        for (const std::size_t end = k + matrix.lengths[i]; k < end; ++k)
          b[i] -= matrix.values[k] * all_x[matrix.columns[k]];
      inverse.solve(y, b);
      double norm_x = 0., norm_y = 0.;
      x.Norm2(&norm_x);
      y.Norm2(&norm_y);
      return norm_x > 0. ? norm_y / norm_x : 0.;
    }

    Epetra_CrsMatrix
    as_matrix(const SparseRows &rows, const Epetra_Map &map)
    {
      const std::vector<int> lengths(rows.lengths.begin(), rows.lengths.end());
      Epetra_CrsMatrix       matrix(Copy, map, lengths.data(), true);
      for (std::size_t i = 0, k = 0; i < rows.lengths.size();
           k += rows.lengths[i++])
        matrix.InsertGlobalValues(map.GID(static_cast<int>(i)),
                                  lengths[i],
                                  &rows.values[k],
                                  &rows.columns[k]);
      matrix.FillComplete();
      return matrix;
    }
  } // namespace

  void
  Lifting::factorise(SparseRows schur, const Epetra_Map &map)
  {
    constexpr int max_gathered = 100000;
    if (map.NumGlobalElements() <= max_gathered)
      {
        const MPI_Comm comm =
          dynamic_cast<const Epetra_MpiComm &>(map.Comm()).Comm();
        light = std::make_unique<SparseCholesky<float>>();
        valid = light->initialize(schur, comm) &&
                relative_correction(*light, schur, map) < accurate_enough;
        if (valid)
          return;
        light.reset();
        exact = std::make_unique<SparseCholesky<double>>();
        valid = exact->initialize(schur, comm);
        if (valid)
          return;
        exact.reset();
      }
    factorise(as_matrix(schur, map));
  }

  void
  Lifting::factorise(const Epetra_CrsMatrix &schur)
  {
    valid = heavy.initialize(schur, MatrixKind::positive_definite);
  }
} // namespace mortise
