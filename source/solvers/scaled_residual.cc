// See scaled_residual.h.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/scaled_residual.h>

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

    void
    invert(Vector &diagonal)
    {
      for (unsigned int i = 0; i < diagonal.locally_owned_size(); ++i)
        diagonal.local_element(i) = inverse(diagonal.local_element(i));
    }

    /// Of the owned values.
    double
    weighted_product(const Vector &a, const Vector &b, const Vector &weight)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < weight.locally_owned_size(); ++i)
        sum +=
          a.local_element(i) * b.local_element(i) * weight.local_element(i);
      return sum;
    }
  } // namespace

  ScaledResidual::ScaledResidual(const BlockSystem &system)
    : system(system)
    , weight(system.zero_vector())
    , interface_present(system.owned_multiplier.size() > 0)
  {
    weight.displacement = system.bulk->diagonal();
    if (system.mixed())
      weight.pressure = system.bulk->pressure_norm_diagonal();
    invert(weight.displacement);
    invert(weight.pressure);
    if (!interface_present)
      return;
    weight.multiplier =
      system.directed_constraint().diagonal_of_square(weight.displacement);
    if (system.has_springs())
      {
        const auto opening = system.compliance().diagonal();
        for (unsigned int i = 0; i < opening.size(); ++i)
          weight.multiplier.local_element(i) += opening[i];
      }
    invert(weight.multiplier);
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
      system.bulk->apply_stiffness(r.displacement, x.displacement);
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
  ScaledResidual::product(const SystemVector &a, const SystemVector &b) const
  {
    double sum = 0.;
    for (const auto part : {&SystemVector::displacement,
                            &SystemVector::pressure,
                            &SystemVector::multiplier})
      sum += weighted_product(a.*part, b.*part, weight.*part);
    return Utilities::MPI::sum(sum, system.communicator);
  }

  double
  ScaledResidual::magnitude(const SystemVector &rhs,
                            const SystemVector &x) const
  {
    SystemVector sizes = system.zero_vector();
    const auto   abs   = [](Vector &to, const Vector &from) {
      for (unsigned int i = 0; i < to.locally_owned_size(); ++i)
        to.local_element(i) = std::fabs(from.local_element(i));
    };
    if (interface_present)
      {
        const auto magnitudes = [](const CouplingMatrix &of) {
          SparseMatrix result = of.expanded();
          result.for_each_entry([](const auto, const auto, double &value) {
            value = std::fabs(value);
          });
          return result;
        };
        Vector u(x.displacement), lambda(x.multiplier);
        abs(u, x.displacement);
        abs(lambda, x.multiplier);
        magnitudes(system.directed_forces())
          .Tvmult_add(sizes.displacement.begin(), lambda.begin());
        magnitudes(system.directed_constraint()).vmult(sizes.multiplier, u);
        if (system.has_springs())
          {
            Vector opening(lambda); // entries of one sign are most of it
            system.compliance().vmult(opening, lambda);
            abs(opening, opening);
            sizes.multiplier += opening;
          }
      }
    for (unsigned int i = 0; i < x.displacement.locally_owned_size(); ++i)
      sizes.displacement.local_element(i) +=
        std::fabs(rhs.displacement.local_element(i)) +
        std::fabs(x.displacement.local_element(i)) /
          weight.displacement.local_element(i);
    return norm(sizes);
  }

  void
  ScaledResidual::assess(const Solved                  &solved,
                         const double                   tolerance,
                         const std::function<double()> &relative_error,
                         SolveReport                   &report) const
  {
    constexpr double largest_error = 1e-6;
    const double     rhs_norm = norm(solved.rhs), reached = norm(solved.r);
    report.relative_residual = reached == 0. ? 0. : reached / rhs_norm;
    report.converged         = reached <= tolerance * rhs_norm;
    if (report.converged || !std::isfinite(reached))
      return;
    const double least = attainable(solved.rhs, solved.x);
    report.attainable  = least / rhs_norm;
    report.converged   = reached <= least && relative_error() <= largest_error;
  }
} // namespace mortise
