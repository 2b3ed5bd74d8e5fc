// See condensed.h.
#include <mortise/solvers/krylov/condensed.h>
#include <mortise/solvers/krylov/saddle_point.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Conjugate gradients for (u, lambda) in the subspace of the projector, or
    /// in the whole space without one.
    class ProjectedConjugateGradients
    {
    public:
      ProjectedConjugateGradients(const BlockSystem     &system,
                                  const ScaledResidual  &residual,
                                  const DegreeMultigrid &preconditioner,
                                  const SystemVector    &rhs,
                                  const SolverOptions   &options)
        : system(system)
        , residual(residual)
        , preconditioner(preconditioner)
        , projector(preconditioner.projector())
        , options(options)
        , rhs(rhs)
        , rhs_norm(residual.norm(rhs))
        , all_r(system.zero_vector())
        , r(all_r.displacement)
        , z(r)
        , d(r)
        , kd(r)
        , has_springs(system.has_springs())
        , z_lambda(all_r.multiplier)
        , d_lambda(z_lambda)
        , no_offset(z_lambda)
      {}

      /// Start from what @p x holds, whose energy this takes into account.
      void
      start(const SystemVector &x)
      {
        energy_of_x = system.energy_product(x);
      }

      /// Go on from what @p x holds until the residual is small enough.
      void
      run(SystemVector &x, SolveReport &report)
      {
        Vector      &u = x.displacement, &lambda = x.multiplier;
        const double target = 0.9 * options.tolerance * rhs_norm;
        if (projector != nullptr)
          projector->satisfy(u, lambda, rhs.multiplier);
        residual.compute(rhs, x, all_r);
        double rho_old = 0.;
        for (bool first = true; report.iterations < options.max_iterations;
             first      = false)
          {
            if (projector != nullptr)
              projector->remove_multipliers(r, lambda);
            const double reached = residual.norm(all_r);
            if (!first && options.monitor)
              options.monitor(report.iterations, reached / rhs_norm);
            if (!std::isfinite(reached))
              break;
            precondition();
            const double rho = r * z; // estimates the energy of the error
            if (reached <= target &&
                rho <= std::pow(options.energy_tolerance(), 2) *
                         std::max(energy_of_x, residual.least_energy(rhs_norm)))
              break;
            if (first)
              d = z;
            else
              d.sadd(rho / rho_old, 1., z);
            if (has_springs)
              d_lambda.sadd(first ? 0. : rho / rho_old, 1., z_lambda);
            rho_old = rho;
            if (!step(x, rho))
              break;
            ++report.iterations;
          }
        if (projector != nullptr)
          projector->satisfy(u, lambda, rhs.multiplier);
        residual.compute(rhs, x, all_r);
      }

      /// After run(): is that what was asked for?
      bool
      reached() const
      {
        return residual.norm(all_r) <= options.tolerance * rhs_norm;
      }

      /// Note what run() reached.
      void
      assess(const SystemVector &x, SolveReport &report)
      {
        const auto relative_error = [&] {
          Vector unused(all_r.multiplier);
          if (projector != nullptr)
            projector->remove_multipliers(r, unused);
          precondition();
          return std::sqrt((z * r) / system.energy_product(x));
        };
        residual.assess({rhs, x, all_r},
                        options.tolerance,
                        relative_error,
                        report);
      }

    private:
      /// z, z_lambda from r without what multipliers carry.
      void
      precondition()
      {
        preconditioner.vmult(z, r);
        if (has_springs)
          {
            z_lambda = preconditioner.spring_multipliers();
            projector->satisfy(z, z_lambda, no_offset);
          }
        else if (projector != nullptr)
          projector->project(z);
      }

      /// Move along d; false when the matrix is not positive definite there, or
      /// not a number.
      bool
      step(SystemVector &x, const double rho)
      {
        system.bulk->apply_stiffness(kd, d);
        if (has_springs)
          system.add_multiplier_force(kd, d_lambda);
        const double energy = d * kd;
        if (!(rho > 0. && energy > 0.))
          return false;
        const double alpha = rho / energy;
        x.displacement.add(alpha, d);
        if (has_springs)
          x.multiplier.add(alpha, d_lambda);
        r.add(-alpha, kd);
        energy_of_x += alpha * rho;
        return true;
      }

      const BlockSystem         &system;
      const ScaledResidual      &residual;
      const DegreeMultigrid     &preconditioner;
      const ConstraintProjector *projector;
      const SolverOptions       &options;
      const SystemVector        &rhs;
      const double               rhs_norm;
      SystemVector               all_r;
      Vector                    &r;
      Vector                     z, d, kd;
      const bool                 has_springs;
      Vector                     z_lambda, d_lambda; ///< multipliers
      const Vector               no_offset;          ///< likewise
      double                     energy_of_x = 0.;   ///< gained so far
    };
  } // namespace

  CondensedSolver::CondensedSolver(const BlockSystem   &system,
                                   const SolverOptions &options)
    : LinearSolver(system, options, "condensed")
  {}

  bool
  CondensedSolver::set_up()
  {
    preconditioner =
      std::make_unique<DegreeMultigrid>(system, options.max_gathered);
    description = preconditioner->description();
    return preconditioner->is_valid();
  }

  bool
  CondensedSolver::set_up_active()
  {
    return preconditioner->update_active();
  }

  bool
  CondensedSolver::set_up_interfaces()
  {
    return preconditioner->update_interfaces();
  }

  bool
  CondensedSolver::set_up_directions()
  {
    return preconditioner->update_directions();
  }

  void
  CondensedSolver::run(const SystemVector &rhs,
                       SystemVector       &x,
                       const bool          is_zero,
                       SolveReport        &report)
  {
    if (!system.suits_conjugate_gradients())
      return solve_saddle_point(
        system, *residual, *preconditioner, nullptr, options, rhs, x, report);
    ProjectedConjugateGradients solver(
      system, *residual, *preconditioner, rhs, options);
    if (!is_zero)
      solver.start(x);
    // Rounding makes the carried residual drift from the true one: start again
    // from what was reached.
    unsigned int start = 0;
    do
      solver.run(x, report);
    while (!solver.reached() && ++start < 3 &&
           report.iterations < options.max_iterations);
    solver.assess(x, report);
  }
} // namespace mortise
