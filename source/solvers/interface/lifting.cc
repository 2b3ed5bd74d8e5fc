// See lifting.h.
#include <mortise/solvers/interface/lifting.h>

namespace mortise
{
  namespace
  {
    /// The number of rows that a last attempt may have on all ranks.
    constexpr std::size_t always_gathered = 100000;
  } // namespace

  void
  Lifting::factorise(NodalMatrix             schur,
                     SchwarzInverse::Product product,
                     const Epetra_Map       &map,
                     const std::size_t       max_gathered)
  {
    schwarz.reset();
    cholesky.reset();
    mumps_x.reset();
    uses_mumps = false;
    lone.clear();
    std::vector<std::pair<int, double>> uncoupled;
    NodalMatrix coupled = take_coupled(schur, map.Comm(), uncoupled);
    int         mine[]  = {0, static_cast<int>(coupled.entries.size())};
    for (auto &[entry, diagonal] : uncoupled)
      {
        mine[0] += diagonal > 0. ? 0 : 1;
        diagonal = 1. / diagonal;
      }
    int all[2];
    map.Comm().SumAll(mine, all, 2);
    valid                  = all[0] == 0;
    const std::size_t size = all[1];
    if (!valid)
      return;
    const bool together = map.Comm().NumProc() == 1 || size <= max_gathered;
    if (!together)
      {
        schwarz = std::make_unique<SchwarzInverse>();
        valid   = schwarz->initialize(
          std::make_shared<DistributedNodalMatrix>(std::move(schur), map),
          std::move(product));
        if (valid)
          return;
        schwarz.reset();
      }
    lone = std::move(uncoupled);
    if (size == 0)
      return;
    const DistributedNodalMatrix C(std::move(coupled), map);
    if (together || size <= always_gathered)
      {
        cholesky = std::make_unique<CholeskyInverse<double>>();
        valid    = cholesky->initialize(
          C.rows(),
          [&C](Epetra_Vector &y, const Epetra_Vector &x) {
            y.PutScalar(0.); // where nothing couples
            C.vmult(y, x);
          },
          map,
          true);
        if (valid)
          return;
        cholesky.reset();
      }
    const auto matrix = as_matrix(C.rows(), map.Comm());
    factorise(*matrix);
    mumps_entries = C.rows().entries;
    mumps_x       = std::make_unique<Epetra_Vector>(matrix->RowMap());
    mumps_b       = std::make_unique<Epetra_Vector>(matrix->RowMap());
  }

  void
  Lifting::factorise(const Epetra_CrsMatrix &schur)
  {
    valid      = mumps.initialize(schur, MatrixKind::positive_definite);
    uses_mumps = true;
  }

  void
  Lifting::apply_inverse_schur(Epetra_Vector       &y,
                               const Epetra_Vector &jump) const
  {
    if (!system.active)
      {
        solve(y, jump);
        return;
      }
    Epetra_Vector of_active(jump);
    system.clear_inactive(of_active.Values());
    solve(y, of_active);
    system.clear_inactive(y.Values());
  }

  void
  Lifting::solve(Epetra_Vector &y, const Epetra_Vector &jump) const
  {
    for (const auto &[entry, inverse] : lone)
      y[entry] = inverse * jump[entry];
    if (schwarz)
      schwarz->solve(y, jump);
    else if (cholesky)
      cholesky->solve(y, jump);
    else if (uses_mumps && !mumps_x)
      mumps.solve(y, jump);
    else if (uses_mumps)
      {
        for (unsigned int i = 0; i < mumps_entries.size(); ++i)
          (*mumps_b)[i] = mumps_entries[i] < 0 ? 0. : jump[mumps_entries[i]];
        mumps.solve(*mumps_x, *mumps_b);
        for (unsigned int i = 0; i < mumps_entries.size(); ++i)
          if (mumps_entries[i] >= 0)
            y[mumps_entries[i]] = (*mumps_x)[i];
      }
  }

  std::string
  Lifting::description() const
  {
    if (schwarz)
      return "multipliers by parts";
    if (uses_mumps)
      return "multipliers by MUMPS";
    return !cholesky || cholesky->is_single() ?
             "" :
             "multipliers in double precision";
  }
} // namespace mortise
