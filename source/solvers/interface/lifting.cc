// See lifting.h.
#include <mortise/solvers/interface/lifting.h>
#include <mortise/solvers/interface/weighted_square.h>

#include <utility>

namespace mortise
{
  namespace
  {
    /// The number of rows that a last attempt may have on all ranks.
    constexpr std::size_t always_gathered = 100000;
  } // namespace

  Lifting::Lifting(const BlockSystem            &system,
                   const CouplingRows           &rows,
                   const CouplingProduct<float> &product,
                   const std::size_t             max_gathered)
    : system(system)
    , product(product)
    , max_gathered(max_gathered)
    , weights(system.nodal->node_diagonal())
  {
    for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
      weights.local_element(i) = 1. / weights.local_element(i);
    for (const auto &leading : system.nodal->leading_displacements())
      weights.local_element(leading.index) = 0.;
    schur = weighted_square(rows, weights);
    if (system.coupling.has_frames())
      schur = in_frames(schur, system.coupling.frames());
    if (system.has_springs())
      add(schur, system.spring_compliance.trilinos_matrix());
    if (!system.active)
      factorise(std::move(schur));
    else
      update_active();
  }

  bool
  Lifting::update_active()
  {
    factorise(select(schur, *system.active, system.coupling.row_map().Comm()));
    return is_valid();
  }

  SchwarzInverse::Product
  Lifting::product_with_schur() const
  {
    LevelVector<float> trace;
    product.initialize(trace);
    const Epetra_CrsMatrix *const springs =
      system.has_springs() ? &system.spring_compliance.trilinos_matrix() :
                             nullptr;
    return [trace, springs, this](Epetra_Vector       &to,
                                  const Epetra_Vector &from) mutable {
      product.multiply_transposed(trace, from);
      const auto &indices = product.indices();
      for (unsigned int k = 0; k < indices.size(); ++k)
        trace.local_element(k) *= weights.local_element(indices[k]);
      product.multiply(to, trace);
      if (springs)
        {
          Epetra_Vector opening(to);
          springs->Multiply(false, from, opening);
          to.Update(1., opening, 1.);
        }
      system.clear_inactive(to.Values());
    };
  }

  void
  Lifting::factorise(NodalMatrix active)
  {
    const Epetra_Map &map = system.coupling.row_map();
    schwarz.reset();
    cholesky.reset();
    mumps_x.reset();
    lone.clear();
    std::vector<std::pair<int, double>> uncoupled;
    NodalMatrix coupled = take_coupled(active, map.Comm(), uncoupled);
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
          std::make_shared<DistributedNodalMatrix>(std::move(active), map),
          product_with_schur());
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
    valid         = mumps.initialize(*matrix, MatrixKind::positive_definite);
    mumps_entries = C.rows().entries;
    mumps_x       = std::make_unique<Epetra_Vector>(matrix->RowMap());
    mumps_b       = std::make_unique<Epetra_Vector>(matrix->RowMap());
  }

  void
  Lifting::vmult(Vector &dst, const Vector &src) const
  {
    const double *from = src.begin();
    double       *to   = dst.begin();
    for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
      to[i] = weights.local_element(i) * from[i];
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
    else if (mumps_x)
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
    if (mumps_x)
      return "multipliers by MUMPS";
    return !cholesky || cholesky->is_single() ?
             "" :
             "multipliers in double precision";
  }
} // namespace mortise
