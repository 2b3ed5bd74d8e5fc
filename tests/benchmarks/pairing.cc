// Cost of another pairing of interfaces compared with a new discretisation:
// pairing SCENE.prm [SECTION/NAME=VALUE]... solves the scene, then moves the
// surfaces ten times by a tenth of the solution, pairs them there and solves
// again. Prints seconds and iterations; it never fails.
#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <fstream>
#include <iostream>
#include <sstream>

#include "scenes/active_sets.h"

using namespace dealii;
using namespace mortise;
using namespace mortise::testing;

namespace
{
  struct Seconds
  {
    double       pairing = 0., clipping = 0., interfaces = 0., solve = 0.;
    unsigned int iterations = 0;
  };

  void
  print(const std::string &name, const Seconds &of)
  {
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::printf("%-12s %9.4f %9.4f %9.4f %9.4f %6u\n",
                  name.c_str(),
                  of.pairing,
                  of.clipping,
                  of.interfaces,
                  of.solve,
                  of.iterations);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc < 2)
    {
      std::cerr << "pairing SCENE.prm [SECTION/NAME=VALUE]...\n";
      return 2;
    }
  std::ostringstream text;
  text << std::ifstream(argv[1]).rdbuf();
  const Timer      start;
  EquationsOfScene scene(text.str(),
                         Settings(argv + 2, argv + argc),
                         MPI_COMM_WORLD);
  const double     made           = start.wall_time();
  Discretisation  &discretisation = scene.discretisation;
  Timers          &timers         = scene.context().timers;
  SolverOptions    options;
  options.method    = discretisation.choice().method;
  options.tolerance = 1e-8;
  const auto solver =
    make_linear_solver(discretisation.linear_system(), options);
  SystemVector x;
  SolveReport  report = solver->solve(scene.load.rhs, x);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::printf(
      "%llu unknowns, %llu of them multipliers; discretisation %.3f s\n"
      "             pairing  clipping solver set-up  solve  iterations\n",
      static_cast<unsigned long long>(discretisation.summary().dofs.total),
      static_cast<unsigned long long>(
        discretisation.linear_system().owned_multiplier.size()),
      made);
  print("first",
        {timers.seconds("interface_search") + timers.seconds("coupling") +
           timers.seconds("interface_clipping"),
         timers.seconds("interface_clipping"),
         report.setup_seconds,
         report.solve_seconds,
         report.iterations});
  for (unsigned int k = 1; k <= 10; ++k)
    {
      std::vector<BodySolution> moved = discretisation.solutions(scene.load, x);
      for (BodySolution &of_body : moved)
        {
          of_body.displacement.zero_out_ghost_values();
          of_body.displacement *= 0.1 * k;
          of_body.displacement.update_ghost_values();
        }
      const double clipped = timers.seconds("interface_clipping");
      const Timer  timer;
      discretisation.pair(moved);
      const double seconds = timer.wall_time();
      solver->update_interfaces();
      SystemVector again = discretisation.linear_system().zero_vector();
      again.displacement = x.displacement;
      report =
        solver->solve_from(discretisation.load(scene.fields()).rhs, again);
      print("pairing " + std::to_string(k),
            {seconds,
             timers.seconds("interface_clipping") - clipped,
             report.setup_seconds,
             report.solve_seconds,
             report.iterations});
    }
}
