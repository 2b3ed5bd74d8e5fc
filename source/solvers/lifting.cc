// See lifting.h.
#include <mortise/solvers/lifting.h>
#include <mortise/solvers/relative_correction.h>

namespace mortise
{
  namespace
  {
    /// The largest relative correction, in the norm of C, by which a solution
    /// may be wrong. It is 4e-7 to 9e-6 (p = 2..8) where no side is much
    /// stiffer, and 2e-5, 7e-5, 4e-4, 8e-3 with a slave 10, 100, 1e3, 1e6 times
    /// stiffer than a coarser master: none, one, two, three or four iterations
    /// more.
    constexpr double accurate_enough = 1e-4;

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
    const MPI_Comm    comm = C->communicator();
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
        const auto multiply = [&C](Epetra_Vector &y, const Epetra_Vector &x) {
          C->vmult(y, x);
        };
        light = std::make_unique<SparseCholesky<float>>();
        valid = light->initialize(C->rows(), comm) &&
                relative_correction(*light, multiply, map) < accurate_enough;
        if (valid)
          return;
        light.reset();
        exact = std::make_unique<SparseCholesky<double>>();
        valid = exact->initialize(C->rows(), comm);
        if (valid)
          return;
        exact.reset();
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

  std::string
  Lifting::description() const
  {
    return distributed ? "multipliers by parts" :
           light       ? "" :
           exact       ? "multipliers in double precision" :
                         "multipliers by MUMPS";
  }
} // namespace mortise
