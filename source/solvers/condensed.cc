// See condensed.h.
#include <mortise/solvers/condensed.h>
#include <mortise/solvers/constraint_projector.h>
#include <mortise/solvers/hierarchical_preconditioner.h>
#include <mortise/solvers/scaled_residual.h>

#include <deal.II/base/timer.h>

#include <cmath>
#include <memory>

namespace mortise
{
  using namespace dealii;

  SolveReport
  solve_condensed(const BlockSystem   &system,
                  const SolverOptions &options,
                  Vector              &u,
                  Vector              &lambda)
  {
    SolveReport report;
    report.method = "condensed";
    Timer                      timer;
    HierarchicalPreconditioner preconditioner;
    const bool                 bulk_is_valid = preconditioner.initialize(system);
    std::unique_ptr<InterfaceLifting>    lifting;
    std::unique_ptr<ConstraintProjector> projector;
    if (bulk_is_valid && system.owned_multiplier.size() > 0)
      {
        lifting   = std::make_unique<InterfaceLifting>(system, preconditioner.smoother());
        projector = std::make_unique<ConstraintProjector>(system, *lifting);
      }
    const ScaledResidual      residual(system);
    report.preconditioner = preconditioner.description();
    report.setup_seconds  = timer.wall_time();
    timer.restart();

    u.reinit(system.owned_displacement, system.communicator);
    lambda.reinit(system.owned_multiplier, system.communicator);
    const double rhs_norm = residual.right_hand_side_norm();
    const double target   = options.tolerance * rhs_norm;
    Vector       r(u), r_lambda(lambda), z(u), d(u), kd(u);
    const bool   valid = bulk_is_valid && (!projector || projector->is_valid());
    double       reached = rhs_norm, energy_of_solution = 0.;
    for (unsigned int start = 0; start < 3 && valid && reached > target &&
                                 report.iterations < options.max_iterations;
         ++start)
      {
        if (projector)
          projector->project(u, &system.coupling_rhs);
        residual.compute(u, lambda, r, r_lambda);
        double rho_old = 0.;
        for (bool first = true; report.iterations < options.max_iterations; first = false)
          {
            if (projector)
              projector->project_residual(r, lambda);
            reached = residual.norm(r, r_lambda);
            if (!first)
              {
                report.history.push_back(reached / rhs_norm);
                if (options.monitor)
                  options.monitor(report.iterations, reached / rhs_norm);
              }
            preconditioner.vmult(z, r);
            if (projector)
              projector->project(z);
            const double rho = r * z; // estimates the energy of the error
            if (reached <= 0.9 * target &&
                rho <= std::pow(options.energy_tolerance(), 2) * energy_of_solution)
              break;
            if (first)
              d = z;
            else
              d.sadd(rho / rho_old, 1., z);
            rho_old = rho;
            system.stiffness.vmult(kd, d);
            const double energy = d * kd;
            if (!(rho > 0. && energy > 0.)) // not positive definite, or not a number
              break;
            const double alpha = rho / energy;
            u.add(alpha, d);
            r.add(-alpha, kd);
            energy_of_solution += alpha * rho;
            ++report.iterations;
          }
        residual.compute(u, lambda, r, r_lambda);
        reached = residual.norm(r, r_lambda);
      }
    report.relative_residual = reached == 0. ? 0. : reached / rhs_norm;
    report.converged         = reached <= target;
    report.solve_seconds     = timer.wall_time();
    return report;
  }
} // namespace mortise
