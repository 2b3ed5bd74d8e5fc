// Proves the rates of convergence of the tied thick sphere and cylinder, and of
// a manufactured solution with a clamped rim, on curved interfaces whose
// meshes do not match: energy h^p, L2 h^(p+1), multiplier at least h^p; and
// small errors.
#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  ErrorSummary
  errors(const bool         sphere,
         const unsigned int p,
         const std::string &inner,
         const std::string &outer)
  {
    const std::string degree = std::to_string(p);
    return *run_scene(two_layers(sphere),
                      {"Body inner/Degree=" + degree,
                       "Body outer/Degree=" + degree,
                       "Body inner/Mesh/Subdivisions=" + inner,
                       "Body outer/Mesh/Subdivisions=" + outer,
                       "Solver/Tolerance=1e-11"})
              .steps.back()
              .errors;
  }

  /// Energy error of the tied sphere over that of one conforming mesh with
  /// cells of the coarser side.
  double
  over_conforming(const unsigned int  p,
                  const ErrorSummary &tied,
                  const std::string  &subdivisions)
  {
    const Summary whole = run_scene(
      "set Bodies = shell\n" + layer("shell", "1, 2", true, true) +
        "subsection Exact solution\n  set Displacement = thick sphere\nend\n"
        "subsection Output\n  set Directory = unused\n  set Fields =\nend\n",
      {"Body shell/Degree=" + std::to_string(p),
       "Body shell/Mesh/Subdivisions=" + subdivisions});
    return *tied.energy / *whole.steps.back().errors->energy;
  }

  /// Body of n x n x n/2 cells tied to one of 3n/2 x 3n/2 x n/2.
  ErrorSummary
  manufactured_errors(const unsigned int p, const unsigned int n)
  {
    const std::string degree = std::to_string(p),
                      height = std::to_string(n / 2);
    const auto cells         = [&](const unsigned int across) {
      return std::to_string(across) + ", " + std::to_string(across) + ", " +
             height;
    };
    return *run_scene(manufactured(),
                      {"Body lower/Degree=" + degree,
                       "Body upper/Degree=" + degree,
                       "Body lower/Mesh/Subdivisions=" + cells(n),
                       "Body upper/Mesh/Subdivisions=" + cells(3 * n / 2),
                       "Solver/Tolerance=1e-11"})
              .steps.back()
              .errors;
  }

  void
  check(const std::string  &scene,
        const unsigned int  p,
        const ErrorSummary &coarse,
        const ErrorSummary &fine)
  {
    // coarse meshes halved once are still before the limit (conforming ones
    // have the same rates)
    rate_verdicts(
      scene + ", degree " + std::to_string(p), p, coarse, fine, {0.3, 0.2});
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check("sphere",
        1,
        errors(true, 1, "4, 2", "6, 3"),
        errors(true, 1, "8, 4", "12, 6"));
  check("sphere",
        2,
        errors(true, 2, "2, 1", "3, 2"),
        errors(true, 2, "4, 2", "6, 4"));
  check("sphere",
        3,
        errors(true, 3, "2, 1", "3, 1"),
        errors(true, 3, "4, 2", "6, 2"));
  verdict("sphere, degree 1: energy error within 1.1 of conforming",
          over_conforming(1, errors(true, 1, "4, 2", "6, 3"), "4, 4"),
          1.1);
  verdict("sphere, degree 2: energy error within 1.1 of conforming",
          over_conforming(2, errors(true, 2, "2, 1", "3, 2"), "2, 2"),
          1.1);
  check("cylinder",
        1,
        errors(false, 1, "4, 2, 1", "6, 3, 2"),
        errors(false, 1, "8, 4, 2", "12, 6, 4"));
  check("cylinder",
        2,
        errors(false, 2, "2, 1, 1", "3, 2, 2"),
        errors(false, 2, "4, 2, 2", "6, 4, 4"));
  check("cylinder",
        3,
        errors(false, 3, "2, 1, 1", "3, 1, 1"),
        errors(false, 3, "4, 2, 2", "6, 2, 2"));
  check("cylinder",
        4,
        errors(false, 4, "1, 1, 1", "2, 1, 1"),
        errors(false, 4, "2, 2, 2", "4, 2, 2"));
  verdict("cylinder, degree 6 on 1 and 2 cells: energy error 1e-4",
          *errors(false, 6, "2, 1, 1", "3, 1, 1").energy,
          1e-4);
  verdict("cylinder, degree 7 on 1 and 2 cells: energy error 1e-6",
          *errors(false, 7, "2, 1, 1", "3, 1, 1").energy,
          1e-6);
  for (const unsigned int p : {1, 2, 3, 4})
    check("clamped rim",
          p,
          manufactured_errors(p, p < 3 ? 4 : 2),
          manufactured_errors(p, p < 3 ? 8 : 4));
}
