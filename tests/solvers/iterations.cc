// Proves that the saddle-point solver needs at most 30 iterations to 1e-10 on
// the tied thick sphere and hardly more on a finer mesh, for several degrees,
// that the condensed solver gives the same errors, that it needs at most 20 to
// 1e-8 on tetrahedra, whatever the contrast of moduli and the ranks, and at
// most 10 on hexahedra with a stiff, fine slave, where single precision is too
// little for the multipliers.
#include <scenes/scene.h>

#include "scenes/scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  StepSummary
  run(const unsigned int degree,
      const unsigned int n,
      const std::string &method)
  {
    const std::string p = std::to_string(degree);
    return run_scene(two_layers(true),
                     {"Body inner/Degree=" + p,
                      "Body outer/Degree=" + p,
                      "Body inner/Mesh/Subdivisions=" + std::to_string(n) +
                        ", " + std::to_string(n),
                      "Body outer/Mesh/Subdivisions=" + std::to_string(n + 1) +
                        ", " + std::to_string(n),
                      "Solver/Method=" + method})
      .steps.back();
  }

  double
  iterations(const StepSummary &step)
  {
    return static_cast<double>(*step.solver->iterations);
  }

  void
  check(const unsigned int degree,
        const unsigned int coarse,
        const unsigned int fine)
  {
    const std::string name = "degree " + std::to_string(degree) + ": ";
    const StepSummary a    = run(degree, coarse, "saddle point"),
                      b    = run(degree, fine, "saddle point");
    verdict(name + "30 iterations", std::max(iterations(a), iterations(b)), 30);
    verdict(name + "growth 1.25", iterations(b) / iterations(a), 1.25);
    const StepSummary c = run(degree, fine, "condensed");
    verdict(name + "condensed, 30 iterations", iterations(c), 30);
    verdict(name + "condensed, same energy error 1e-6",
            std::fabs(*c.errors->energy / *b.errors->energy - 1.),
            1e-6);
  }

  void
  check_tetrahedra(const unsigned int degree, const double modulus)
  {
    const std::string p = std::to_string(degree);
    const StepSummary step =
      run_scene(two_layers(true),
                {"Body inner/Degree=" + p,
                 "Body outer/Degree=" + p,
                 "Body inner/Mesh/Cells=tetrahedra",
                 "Body outer/Mesh/Cells=tetrahedra",
                 "Body inner/Mesh/Subdivisions=4, 2",
                 "Body outer/Mesh/Subdivisions=3, 2",
                 "Body inner/Material/Young modulus=" + std::to_string(modulus),
                 "Solver/Method=condensed",
                 "Solver/Tolerance=1e-8"})
        .steps.back();
    verdict("tetrahedra, degree " + p + ", modulus " + std::to_string(modulus) +
              ": 20 iterations",
            iterations(step),
            20);
    verdict("residual", step.solver->relative_residual, 1e-8);
  }
  /// A slave finer than its master makes C worse the stiffer it is.
  void
  check_stiff_slave(const std::string &modulus, const bool in_double)
  {
    const std::string name = "slave of modulus " + modulus + ": ";
    const StepSummary step =
      run_scene(two_layers(true),
                {"Body inner/Degree=4",
                 "Body outer/Degree=4",
                 "Body inner/Mesh/Subdivisions=6, 3",
                 "Body outer/Mesh/Subdivisions=4, 2",
                 "Body inner/Material/Young modulus=" + modulus,
                 "Solver/Method=condensed",
                 "Solver/Tolerance=1e-8"})
        .steps.back();
    const bool is_double =
      step.solver->preconditioner->find("double") != std::string::npos;
    verdict(name + "10 iterations", iterations(step), 10);
    verdict(name + (in_double ? "double" : "single") + " precision",
            is_double == in_double ? 0 : 1,
            0);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check(1, 4, 8);
  check(2, 2, 4);
  check(3, 2, 4);
  for (const double modulus : {10., 1e7, 1e-5})
    for (const unsigned int p : {2, 3})
      check_tetrahedra(p, modulus);
  check_stiff_slave("10", false);
  check_stiff_slave("1e6", true);
}
