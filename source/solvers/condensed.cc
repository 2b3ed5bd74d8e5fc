// See condensed.h.
#include <deal.II/base/timer.h>

#include <mortise/base/timers.h>
#include <mortise/solvers/bulk_preconditioner.h>
#include <mortise/solvers/condensed.h>
#include <mortise/solvers/scaled_residual.h>

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
      ProjectedConjugateGradients(const BlockSystem         &system,
                                  const ScaledResidual      &residual,
                                  const BulkPreconditioner  &preconditioner,
                                  const ConstraintProjector *projector,
                                  const SolverOptions       &options)
        : system(system)
        , residual(residual)
        , preconditioner(preconditioner)
        , projector(projector)
        , options(options)
        , all_r(system.zero_solution())
        , r(all_r.displacement)
        , z(r)
        , d(r)
        , kd(r)
      {}

      /// Start from what @p x holds; the scaled residual at the end.
      double
      run(SystemSolution &x, SolveReport &report)
      {
        Vector      &u = x.displacement, &lambda = x.multiplier;
        const double rhs_norm = residual.right_hand_side_norm();
        const double target   = 0.9 * options.tolerance * rhs_norm;
        if (projector != nullptr)
          projector->satisfy(u, system.coupling_rhs);
        residual.compute(x, all_r);
        double rho_old = 0.;
        for (bool first = true; report.iterations < options.max_iterations;
             first      = false)
          {
            if (projector != nullptr)
              projector->project_residual(r, lambda);
            const double reached = residual.norm(all_r);
            if (!first)
              {
                report.history.push_back(reached / rhs_norm);
                if (options.monitor)
                  options.monitor(report.iterations, reached / rhs_norm);
              }
            preconditioner.vmult(z, r);
            if (projector != nullptr)
              projector->project(z);
            const double rho = r * z; // estimates the energy of the error
            if (reached <= target &&
                rho <= std::pow(options.energy_tolerance(), 2) *
                         std::max(energy_of_u, residual.least_energy()))
              break;
            if (first)
              d = z;
            else
              d.sadd(rho / rho_old, 1., z);
            rho_old = rho;
            if (!step(u, rho))
              break;
            ++report.iterations;
          }
        if (projector != nullptr)
          projector->satisfy(u, system.coupling_rhs);
        residual.compute(x, all_r);
        return residual.norm(all_r);
      }

      /// Note what run() reached.
      void
      judge(const SystemSolution &x, SolveReport &report)
      {
        const auto relative_error = [&] {
          SystemSolution rest = all_r;
          if (projector != nullptr)
            projector->project_residual(rest.displacement, rest.multiplier);
          preconditioner.vmult(z, rest.displacement);
          if (projector != nullptr)
            projector->project(z);
          system.apply_stiffness(kd, x.displacement);
          return std::sqrt((z * rest.displacement) / (kd * x.displacement));
        };
        residual.compute(x, all_r);
        residual.judge(x, all_r, options.tolerance, relative_error, report);
      }

    private:
      /// Move along d; false when the matrix is not positive definite there, or
      /// not a number.
      bool
      step(Vector &u, const double rho)
      {
        system.apply_stiffness(kd, d);
        const double energy = d * kd;
        if (!(rho > 0. && energy > 0.))
          return false;
        const double alpha = rho / energy;
        u.add(alpha, d);
        r.add(-alpha, kd);
        energy_of_u += alpha * rho;
        return true;
      }

      const BlockSystem         &system;
      const ScaledResidual      &residual;
      const BulkPreconditioner  &preconditioner;
      const ConstraintProjector *projector;
      const SolverOptions       &options;
      SystemSolution             all_r;
      Vector                    &r;
      Vector                     z, d, kd;
      double                     energy_of_u = 0.; ///< gained so far
    };
  } // namespace

  SolveReport
  solve_condensed(const BlockSystem   &system,
                  const SolverOptions &options,
                  SystemSolution      &x)
  {
    SolveReport report;
    report.method = "condensed";
    announce_stage("solver_setup");
    Timer       timer;
    const auto  preconditioner = make_bulk_preconditioner(system, options);
    const bool  valid          = preconditioner->initialize(system);
    const auto *projector      = valid ? preconditioner->projector() : nullptr;
    const ScaledResidual residual(system);
    report.preconditioner = preconditioner->description();
    report.setup_seconds  = timer.wall_time();
    announce_stage("solve");
    timer.restart();

    x                                    = system.zero_solution();
    const double                rhs_norm = residual.right_hand_side_norm();
    const double                target   = options.tolerance * rhs_norm;
    double                      reached  = rhs_norm;
    ProjectedConjugateGradients solver(
      system, residual, *preconditioner, projector, options);
    // Rounding makes the carried residual drift from the true one: start again
    // from what was reached.
    for (unsigned int start = 0; start < 3 && valid && reached > target &&
                                 report.iterations < options.max_iterations;
         ++start)
      reached = solver.run(x, report);
    solver.judge(x, report);
    report.converged &= valid;
    report.solve_seconds     = timer.wall_time();
    return report;
  }
} // namespace mortise
