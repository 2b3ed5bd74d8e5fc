// Proves that the three methods give the same solution and multipliers, in any
// units, with prescribed jumps, floating bodies, contrast, without an interface
// and on ranks without dofs; that later solves start from earlier ones; and that
// failure is reported.
#include <mortise/base/error.h>
#include <mortise/solvers/solve.h>

#include <cmath>
#include <iostream>
#include <limits>

#include "spring_system.h"

using namespace mortise;
using namespace dealii;

namespace
{
  void
  verdict(const std::string &what, const double got, const double allowed)
  {
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        if (got <= allowed)
          std::cout << "OK  " << what << std::endl;
        else
          std::cout << "FAILED  " << what << ": got " << got << ", allowed "
                    << allowed << std::endl;
      }
  }

  struct Result
  {
    SolveReport     report;
    mortise::Vector u, lambda;
  };

  struct Scene
  {
    explicit Scene(const springs::Options &options)
      : builder(options, MPI_COMM_WORLD)
      , system(builder.build())
      , rhs(builder.load(system))
    {}

    springs::Builder builder;
    BlockSystem      system;
    SystemVector     rhs;
  };

  Result
  run(const Scene       &scene,
      const std::string &method,
      const unsigned int max_iterations = 500)
  {
    const BlockSystem &system = scene.system;
    SolverOptions options;
    options.method =
      choose_solver(
        solver_method_from_name(method),
        {system.owned_displacement.size(), false, 1.})
        .method;
    options.tolerance      = 1e-11;
    options.max_iterations = max_iterations;
    Result       result;
    SystemVector solution;
    result.report =
      make_linear_solver(system, options)->solve(scene.rhs, solution);
    result.u      = solution.displacement;
    result.lambda = solution.multiplier;
    return result;
  }

  double
  difference(const mortise::Vector &a, const mortise::Vector &b)
  {
    mortise::Vector d(a);
    d -= b;
    return d.l2_norm() / std::max(b.l2_norm(), 1e-300);
  }

  void
  check_agreement(const std::string &name, const springs::Options &options)
  {
    const Scene        scene(options);
    const BlockSystem &system = scene.system;
    const Result       direct = run(scene, "direct");
    verdict(name + ": direct, residual 1e-12",
            direct.report.relative_residual,
            1e-12);
    for (const std::string method : {"condensed", "saddle point", "auto"})
      {
        const Result result = run(scene, method);
        verdict(name + ": " + method + ", converged",
                result.report.converged ? 0. : 1.,
                0.);
        verdict(name + ": " + method + ", residual 1e-11",
                result.report.relative_residual,
                1e-11);
        verdict(name + ": " + method + ", displacements 1e-8",
                difference(result.u, direct.u),
                1e-8);
        if (system.owned_multiplier.size() > 0)
          {
            verdict(name + ": " + method + ", multipliers 1e-8",
                    difference(result.lambda, direct.lambda),
                    1e-8);
            mortise::Vector jump(result.lambda);
            system.coupling.vmult(jump, result.u);
            jump -= scene.rhs.multiplier;
            if (method == std::string("condensed"))
              verdict(name + ": constraint to rounding",
                      jump.linfty_norm() / result.u.linfty_norm(),
                      1e-13);
          }
      }
  }

  /// Iterations must not depend on units.
  void
  check_units()
  {
    springs::Options scene;
    scene.gap               = 0.3;
    const Scene plain(scene);
    scene.stiffness         = 1e9;
    scene.length            = 1e-3;
    const Scene other(scene);
    for (const std::string method : {"condensed", "saddle point"})
      {
        const double a = run(plain, method).report.iterations;
        const double b = run(other, method).report.iterations;
        verdict("units: " + method + ", iterations differ by at most 1",
                std::fabs(a - b),
                1.);
      }
  }

  /// A later load that is a combination of earlier ones is solved at the start; one that is not
  /// is solved as by a new solver; other numbers are taken after update().
  void
  check_later_solves(const std::string &method)
  {
    springs::Options options;
    options.gap = 0.3;
    Scene scene(options);
    options.load = 0.;
    const Scene   jump(options);
    SolverOptions solver_options;
    solver_options.method     = solver_method_from_name(method);
    solver_options.tolerance  = 1e-11;
    solver_options.successive = 3;
    const auto   solver = make_linear_solver(scene.system, solver_options);
    SystemVector x, other;
    solver->solve(scene.rhs, x);
    solver->solve(jump.rhs, other);
    SystemVector rhs = scene.rhs;
    scale(rhs, -2.5);
    add_scaled(rhs, 7., jump.rhs);
    const auto   report = solver->solve(rhs, x);
    SystemVector y;
    make_linear_solver(scene.system, solver_options)->solve(rhs, y);
    verdict(method + ": a combination of loads is solved at once",
            method == "direct" ? 0. : report.iterations,
            0.);
    verdict(method + ": it is that of a new solver, 1e-8",
            difference(x.displacement, y.displacement) +
              difference(x.multiplier, y.multiplier),
            1e-8);
    verdict(method + ": no setup for later loads", report.setup_seconds, 0.);

    rhs.displacement = 0.;
    rhs.multiplier   = 0.;
    solver->solve(rhs, x);
    verdict(method + ": no load after loads, no displacement",
            x.displacement.l2_norm() + x.multiplier.l2_norm(),
            0.);

    scene.system.stiffness *= 2.;
    scene.system.jump_penalty *= 2.;
    solver->update();
    const auto again = solver->solve(scene.rhs, x);
    make_linear_solver(scene.system, solver_options)->solve(scene.rhs, y);
    verdict(method + ": after update() that of the new numbers, 1e-8",
            difference(x.displacement, y.displacement) +
              (again.converged ? 0. : 1.),
            1e-8);
  }

  void
  check_failures()
  {
    springs::Options  scene;
    const Scene      system(scene);
    for (const std::string method : {"condensed", "saddle point"})
      {
        const Result result = run(system, method, 3);
        verdict(method + ": three iterations do not converge",
                result.report.converged ? 1. : 0.,
                0.);
        verdict(method + ": three iterations are reported",
                std::fabs(result.report.iterations - 3.) +
                  (result.report.relative_residual < 1. ? 0. : 1.),
                0.);
      }
    scene.load             = 0.;
    const Scene zero(scene);
    scene.load             = std::numeric_limits<double>::quiet_NaN();
    const Scene nan(scene);
    for (const std::string method : {"direct", "condensed", "saddle point"})
      {
        const Result result = run(zero, method);
        verdict(method + ": no load, no displacement",
                result.u.l2_norm() + result.lambda.l2_norm() +
                  (result.report.converged ? 0. : 1.),
                0.);
        verdict(method + ": not a number stops",
                run(nan, method).report.converged ? 1. : 0.,
                0.);
      }
    bool thrown = false;
    try
      {
        solver_method_from_name("dirct");
      }
    catch (const InputError &)
      {
        thrown = true;
      }
    verdict("unknown method is refused", thrown ? 0. : 1., 0.);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  springs::Options                 scene;
  check_agreement("tied", scene);
  scene.gap = 0.5;
  check_agreement("jump", scene);
  scene          = springs::Options();
  scene.floating = true;
  check_agreement("floating", scene);
  scene.contrast = 1e4;
  check_agreement("floating, contrast 1e4", scene);
  scene          = springs::Options();
  scene.contrast = 1e-4;
  check_agreement("contrast 1e-4", scene);
  scene      = springs::Options();
  scene.tied = false;
  check_agreement("no interface", scene);
  scene             = springs::Options();
  scene.first_ranks = 1;
  check_agreement("one rank owns all", scene);
  check_units();
  for (const std::string method : {"direct", "condensed", "saddle point"})
    check_later_solves(method);
  check_failures();
}
