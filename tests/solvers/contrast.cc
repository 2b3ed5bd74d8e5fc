// Proves that a stiff body which a soft one alone holds is solved at contrasts
// of moduli where rounding keeps the residual far above the tolerance: by every
// method at 1e5, by a factorisation, which is then chosen, at 1e8; and that
// what fails beyond says so.
//
// Two cubes on top of each other, Poisson's ratio zero, pulled by p: the
// displacement of the top is p / E_lower + p / E_upper.
#include <scenes/scene.h>

#include <cmath>
#include <iostream>

#include "scenes/scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  const std::string scene = tied("lower, upper", "upper: zmin", "lower: zmax") +
                            box("lower", "0, 0, 0, 1, 1, 1", "", "") +
                            box("upper", "0, 0, 1, 1, 1, 2", "", "");

  struct Case
  {
    double      ratio; ///< of moduli
    std::string degree;
    std::string method;
    bool        may_fail;
  };

  void
  check(const Case &given)
  {
    const double  lower = 3., upper = lower * given.ratio, pull = 100.;
    const Summary summary =
      run_scene(scene,
                {"Body lower/Mesh/Subdivisions=3, 3, 3",
                 "Body upper/Mesh/Subdivisions=4, 4, 4",
                 "Body lower/Degree=" + given.degree,
                 "Body upper/Degree=" + given.degree,
                 "Body lower/Material/Poisson ratio=0",
                 "Body upper/Material/Poisson ratio=0",
                 "Body lower/Material/Young modulus=" + number(lower),
                 "Body upper/Material/Young modulus=" + number(upper),
                 "Body lower/Boundary xmin/Displacement=0, -, -",
                 "Body lower/Boundary ymin/Displacement=-, 0, -",
                 "Body lower/Boundary zmin/Displacement=-, -, 0",
                 "Body upper/Boundary zmax/Traction=0; 0; " + number(pull),
                 "Output/Points=top: upper: 0.3, 0.6, 2",
                 "Solver/Method=" + given.method});
    const auto  &step  = summary.steps.back();
    const double exact = pull / lower + pull / upper;
    const auto  &top   = step.quantities[0].second;
    const double error = std::hypot(top[0], top[1], top[2] - exact) / exact;
    std::ostringstream text;
    text << "moduli 1 : " << given.ratio << ", degree " << given.degree << ", "
         << given.method;
    const bool done = summary.status == "done";
    if (given.may_fail)
      verdict(text.str() + ": right to 1e-5, or not done",
              done ? error : 0.,
              1e-5);
    else
      {
        verdict(text.str() + ": done", done ? 0 : 1, 0);
        verdict(text.str() + ": right to 1e-6", error, 1e-6);
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string degree : {"1", "3"})
    for (const double ratio : {1e-5, 1e5, 1e8, 1e12})
      for (const std::string method :
           {"auto", "direct", "condensed", "saddle point"})
        {
          const bool iterates =
            method == "condensed" || method == "saddle point";
          check({ratio, degree, method, ratio > (iterates ? 1e7 : 1e10)});
        }
}
