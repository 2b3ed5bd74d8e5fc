// See scaled_residual.h.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/scaled_residual.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    double
    inverse(const double d)
    {
      return d > 0. ? 1. / d : 1.;
    }

    double
    weighted_square(const Vector &r, const Epetra_Vector &weight)
    {
      double        sum    = 0.;
      const double *values = r.trilinos_vector()[0];
      for (int i = 0; i < weight.MyLength(); ++i)
        sum += values[i] * values[i] * weight[i];
      return sum;
    }
  } // namespace

  ScaledResidual::ScaledResidual(const BlockSystem &system)
    : system(system)
    , interface_present(system.owned_multiplier.size() > 0)
  {
    weight_u =
      std::make_unique<Epetra_Vector>(system.load.trilinos_partitioner());
    if (system.nodal)
      std::copy_n(system.nodal->diagonal().begin(),
                  weight_u->MyLength(),
                  weight_u->Values());
    else
      system.stiffness.trilinos_matrix().ExtractDiagonalCopy(*weight_u);
    for (int i = 0; i < weight_u->MyLength(); ++i)
      (*weight_u)[i] = inverse((*weight_u)[i]);
    if (system.mixed())
      {
        weight_p = std::make_unique<Epetra_Vector>(
          system.pressure_load.trilinos_partitioner());
        system.copy_pressure_norm_diagonal(*weight_p);
        for (int i = 0; i < weight_p->MyLength(); ++i)
          (*weight_p)[i] = inverse((*weight_p)[i]);
      }
    if (interface_present)
      {
        const auto   &coupling = system.coupling.trilinos_matrix();
        Epetra_Vector on_columns(coupling.ColMap());
        if (coupling.Importer() != nullptr)
          on_columns.Import(*weight_u, *coupling.Importer(), Insert);
        else
          std::copy(weight_u->Values(),
                    weight_u->Values() + weight_u->MyLength(),
                    on_columns.Values());
        weight_lambda = std::make_unique<Epetra_Vector>(coupling.RowMap());
        for (int i = 0; i < weight_lambda->MyLength(); ++i)
          {
            const EpetraRow row(coupling, i);
            double          sum = 0.;
            for (int k = 0; k < row.length; ++k)
              sum += row.values[k] * row.values[k] * on_columns[row.columns[k]];
            (*weight_lambda)[i] = inverse(sum);
          }
      }
    SystemSolution right_hand_side = system.zero_solution();
    right_hand_side.displacement   = system.load;
    if (system.mixed())
      right_hand_side.pressure = system.pressure_load;
    if (interface_present)
      right_hand_side.multiplier = system.coupling_rhs;
    rhs_norm = norm(right_hand_side);
  }

  void
  ScaledResidual::compute(const SystemSolution &x, SystemSolution &r) const
  {
    if (system.mixed())
      {
        system.apply_mixed(r.displacement,
                           r.pressure,
                           x.displacement,
                           x.pressure);
        r.pressure.sadd(-1., 1., system.pressure_load);
      }
    else
      system.apply_stiffness(r.displacement, x.displacement);
    if (interface_present)
      {
        system.coupling.Tvmult_add(r.displacement, x.multiplier);
        system.coupling.vmult(r.multiplier, x.displacement);
        r.multiplier.sadd(-1., 1., system.coupling_rhs);
      }
    r.displacement.sadd(-1., 1., system.load);
  }

  double
  ScaledResidual::norm(const SystemSolution &r) const
  {
    double square = weighted_square(r.displacement, *weight_u);
    if (system.mixed())
      square += weighted_square(r.pressure, *weight_p);
    if (interface_present)
      square += weighted_square(r.multiplier, *weight_lambda);
    return std::sqrt(Utilities::MPI::sum(square, system.communicator));
  }

  double
  ScaledResidual::magnitude(const SystemSolution &x) const
  {
    SystemSolution sizes = system.zero_solution();
    const auto     abs   = [](Vector &to, const Vector &from) {
      for (unsigned int i = 0; i < to.locally_owned_size(); ++i)
        to.begin()[i] = std::fabs(from.begin()[i]);
    };
    if (interface_present)
      {
        Epetra_CrsMatrix B(system.coupling.trilinos_matrix());
        for (int i = 0; i < B.NumMyRows(); ++i)
          {
            const EpetraRow row(B, i);
            for (int k = 0; k < row.length; ++k)
              row.values[k] = std::fabs(row.values[k]);
          }
        Vector u(x.displacement), lambda(x.multiplier);
        abs(u, x.displacement);
        abs(lambda, x.multiplier);
        Epetra_Vector to_u      = epetra_view(sizes.displacement),
                      to_lambda = epetra_view(sizes.multiplier);
        B.Multiply(true, epetra_view(lambda), to_u);
        B.Multiply(false, epetra_view(u), to_lambda);
      }
    for (unsigned int i = 0; i < x.displacement.locally_owned_size(); ++i)
      sizes.displacement.begin()[i] +=
        std::fabs(system.load.begin()[i]) +
        std::fabs(x.displacement.begin()[i]) / (*weight_u)[i];
    return norm(sizes);
  }

  void
  ScaledResidual::judge(const SystemSolution          &x,
                        const SystemSolution          &r,
                        const double                   tolerance,
                        const std::function<double()> &relative_error,
                        SolveReport                   &report) const
  {
    // a step of rounding for each of the terms of a row
    constexpr double rounding = 1e-14, largest_error = 1e-6;
    const double     reached = norm(r);
    report.relative_residual = reached == 0. ? 0. : reached / rhs_norm;
    report.converged         = reached <= tolerance * rhs_norm;
    if (report.converged || !std::isfinite(reached))
      return;
    const double least = rounding * magnitude(x);
    report.attainable  = least / rhs_norm;
    report.converged   = reached <= least && relative_error() <= largest_error;
  }
} // namespace mortise
