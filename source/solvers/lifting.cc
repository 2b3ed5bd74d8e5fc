// See lifting.h.
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <mortise/solvers/lifting.h>

namespace mortise
{
  namespace
  {
    /// The largest relative correction by which a solution may be wrong. It is
    /// 3e-7 where no side is much stiffer; with a slave 1e6 times stiffer than
    /// a coarser master 2e-4 to 7e-2, and conjugate gradients came to a stop
    /// with 2e-4.
    constexpr double accurate_enough = 1e-5;

    /// The number of rows that a last attempt may have on all ranks.
    constexpr std::size_t always_gathered = 100000;

    /// By how much a second solve corrects a first one.
    double
    relative_correction(const SparseCholesky<float>   &inverse,
                        const SchwarzInverse::Product &product,
                        const Epetra_Map              &map)
    {
      Epetra_Vector b(map), x(map), y(map);
      for (int i = 0; i < y.MyLength(); ++i)
        y[i] = (map.GID(i) * 2654435761U) % 1000 / 500. - 1.;
      product(b, y);
      inverse.solve(x, b);
      product(y, x);
      b.Update(-1., y, 1.);
      inverse.solve(y, b);
      double norm_x = 0., norm_y = 0.;
      x.Norm2(&norm_x);
      y.Norm2(&norm_y);
      return norm_x > 0. ? norm_y / norm_x : 0.;
    }
  } // namespace

  void
  Lifting::factorise(const NodeRows         &schur,
                     SchwarzInverse::Product product,
                     const Epetra_Map       &map,
                     const std::size_t       max_gathered)
  {
    const MPI_Comm comm =
      dynamic_cast<const Epetra_MpiComm &>(map.Comm()).Comm();
    const std::size_t size = map.NumGlobalElements();
    const bool together    = map.Comm().NumProc() == 1 || size <= max_gathered;
    if (!together)
      {
        distributed = std::make_unique<SchwarzInverse>();
        valid       = distributed->initialize(schur, product, map);
        if (valid)
          return;
        distributed.reset();
      }
    if (together || size <= always_gathered)
      {
        light = std::make_unique<SparseCholesky<float>>();
        valid = light->initialize(schur, comm) &&
                relative_correction(*light, product, map) < accurate_enough;
        if (valid)
          return;
        light.reset();
        exact = std::make_unique<SparseCholesky<double>>();
        valid = exact->initialize(schur, comm);
        if (valid)
          return;
        exact.reset();
      }
    const auto matrix = as_matrix(schur, map.Comm());
    factorise(*matrix);
    heavy_entries = schur.entries;
    heavy_x       = std::make_unique<Epetra_Vector>(matrix->RowMap());
    heavy_b       = std::make_unique<Epetra_Vector>(matrix->RowMap());
  }

  void
  Lifting::factorise(const Epetra_CrsMatrix &schur)
  {
    valid = heavy.initialize(schur, MatrixKind::positive_definite);
  }

  void
  Lifting::apply_inverse_schur(Epetra_Vector       &y,
                               const Epetra_Vector &jump) const
  {
    if (distributed)
      distributed->solve(y, jump);
    else if (light)
      light->solve(y, jump);
    else if (exact)
      exact->solve(y, jump);
    else if (heavy_entries.empty())
      heavy.solve(y, jump);
    else
      {
        for (unsigned int i = 0; i < heavy_entries.size(); ++i)
          (*heavy_b)[i] = heavy_entries[i] < 0 ? 0. : jump[heavy_entries[i]];
        heavy.solve(*heavy_x, *heavy_b);
        for (unsigned int i = 0; i < heavy_entries.size(); ++i)
          if (heavy_entries[i] >= 0)
            y[heavy_entries[i]] = (*heavy_x)[i];
      }
  }
} // namespace mortise
