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
    weighted_product(const Vector        &a,
                     const Vector        &b,
                     const Epetra_Vector &weight)
    {
      double        sum  = 0.;
      const double *of_a = a.trilinos_vector()[0],
                   *of_b = b.trilinos_vector()[0];
      for (int i = 0; i < weight.MyLength(); ++i)
        sum += of_a[i] * of_b[i] * weight[i];
      return sum;
    }
  } // namespace

  ScaledResidual::ScaledResidual(const BlockSystem &system)
    : system(system)
    , interface_present(system.owned_multiplier.size() > 0)
  {
    const SystemVector zero = system.zero_vector();
    weight_u =
      std::make_unique<Epetra_Vector>(zero.displacement.trilinos_partitioner());
    for (int i = 0; i < weight_u->MyLength(); ++i)
      (*weight_u)[i] = inverse(system.nodal->diagonal().local_element(i));
    if (system.mixed())
      {
        weight_p =
          std::make_unique<Epetra_Vector>(zero.pressure.trilinos_partitioner());
        const auto &diagonal = system.nodal->pressure_norm_diagonal();
        for (int i = 0; i < weight_p->MyLength(); ++i)
          (*weight_p)[i] = inverse(diagonal.local_element(i));
      }
    if (interface_present)
      {
        weight_lambda = std::make_unique<Epetra_Vector>(
          system.coupling.diagonal_of_square(*weight_u));
        Epetra_Vector opening(weight_lambda->Map());
        if (system.has_springs())
          system.spring_compliance.trilinos_matrix().ExtractDiagonalCopy(
            opening);
        for (int i = 0; i < weight_lambda->MyLength(); ++i)
          (*weight_lambda)[i] = inverse((*weight_lambda)[i] + opening[i]);
      }
  }

  void
  ScaledResidual::compute(const SystemVector &rhs,
                          const SystemVector &x,
                          SystemVector       &r) const
  {
    if (system.mixed())
      {
        system.apply_mixed(r.displacement,
                           r.pressure,
                           x.displacement,
                           x.pressure);
        r.pressure.sadd(-1., 1., rhs.pressure);
      }
    else
      system.apply_stiffness(r.displacement, x.displacement);
    if (interface_present)
      {
        system.add_multiplier_force(r.displacement, x.multiplier);
        system.apply_constraint(r.multiplier, x.displacement);
        system.subtract_spring_opening(r.multiplier, x.multiplier);
        r.multiplier.sadd(-1., 1., rhs.multiplier);
      }
    r.displacement.sadd(-1., 1., rhs.displacement);
  }

  double
  ScaledResidual::norm(const SystemVector &r) const
  {
    return std::sqrt(product(r, r));
  }

  double
  ScaledResidual::product(const SystemVector &a, const SystemVector &b) const
  {
    double sum = weighted_product(a.displacement, b.displacement, *weight_u);
    if (system.mixed())
      sum += weighted_product(a.pressure, b.pressure, *weight_p);
    if (interface_present)
      sum += weighted_product(a.multiplier, b.multiplier, *weight_lambda);
    return Utilities::MPI::sum(sum, system.communicator);
  }

  double
  ScaledResidual::magnitude(const SystemVector &rhs,
                            const SystemVector &x) const
  {
    SystemVector sizes = system.zero_vector();
    const auto   abs   = [](Vector &to, const Vector &from) {
      for (unsigned int i = 0; i < to.locally_owned_size(); ++i)
        to.begin()[i] = std::fabs(from.begin()[i]);
    };
    if (interface_present)
      {
        Epetra_CrsMatrix B = system.coupling.expanded();
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
        if (system.has_springs())
          {
            Vector opening(lambda); // entries of one sign are most of it
            system.spring_compliance.vmult(opening, lambda);
            abs(opening, opening);
            sizes.multiplier += opening;
          }
      }
    for (unsigned int i = 0; i < x.displacement.locally_owned_size(); ++i)
      sizes.displacement.begin()[i] +=
        std::fabs(rhs.displacement.begin()[i]) +
        std::fabs(x.displacement.begin()[i]) / (*weight_u)[i];
    return norm(sizes);
  }

  void
  ScaledResidual::judge(const Solved                  &solved,
                        const double                   tolerance,
                        const std::function<double()> &relative_error,
                        SolveReport                   &report) const
  {
    // a step of rounding for each of the terms of a row
    constexpr double rounding = 1e-14, largest_error = 1e-6;
    const double     rhs_norm = norm(solved.rhs), reached = norm(solved.r);
    report.relative_residual = reached == 0. ? 0. : reached / rhs_norm;
    report.converged         = reached <= tolerance * rhs_norm;
    if (report.converged || !std::isfinite(reached))
      return;
    const double least = rounding * magnitude(solved.rhs, solved.x);
    report.attainable  = least / rhs_norm;
    report.converged   = reached <= least && relative_error() <= largest_error;
  }
} // namespace mortise
