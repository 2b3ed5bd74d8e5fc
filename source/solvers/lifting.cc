// See lifting.h.
#include <mortise/solvers/lifting.h>

namespace mortise
{
  namespace
  {
    /// The number of rows that a last attempt may have on all ranks.
    constexpr std::size_t always_gathered = 100000;
  } // namespace

  void
  Lifting::factorise(NodeRows                schur,
                     SchwarzInverse::Product product,
                     const Epetra_Map       &map,
                     const std::size_t       max_gathered)
  {
    const auto        C = std::make_shared<NodeMatrix>(std::move(schur), map);
    const std::size_t size = map.NumGlobalElements();
    const bool together    = map.Comm().NumProc() == 1 || size <= max_gathered;
    if (!together)
      {
        distributed = std::make_unique<SchwarzInverse>();
        valid       = distributed->initialize(C, std::move(product));
        if (valid)
          return;
        distributed.reset();
      }
    if (together || size <= always_gathered)
      {
        gathered = std::make_unique<CholeskyInverse<double>>();
        valid    = gathered->initialize(
          C->rows(),
          [&C](Epetra_Vector &y, const Epetra_Vector &x) { C->vmult(y, x); },
          map,
          true);
        if (valid)
          return;
        gathered.reset();
      }
    const auto matrix = as_matrix(C->rows(), map.Comm());
    factorise(*matrix);
    heavy_entries = C->rows().entries;
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
    else if (gathered)
      gathered->solve(y, jump);
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

  std::string
  Lifting::description() const
  {
    if (distributed)
      return "multipliers by parts";
    if (!gathered)
      return "multipliers by MUMPS";
    return gathered->is_single() ? "" : "multipliers in double precision";
  }
} // namespace mortise
