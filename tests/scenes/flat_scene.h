// Two layers or a film on a block, and what tests prove of them.
#pragma once

#include "linear_field.h"
#include "scene.h"
#include "scenes.h"

namespace mortise::testing
{
  inline const LinearField field = {
    {{0.1, 0.03, -0.01}, {0.01, 0.05, 0.04}, {0.02, 0.06, -0.07}}};

  /// From z = 0 to @p lower and on to @p lower + @p upper.
  inline Settings
  heights(const double lower, const double upper)
  {
    std::ostringstream first, second;
    first << "0, 0, 0, 1, 1, " << lower;
    second << "0, 0, " << lower << ", 1, 1, " << lower + upper;
    return {"Body lower/Mesh/Extent=" + first.str(),
            "Body upper/Mesh/Extent=" + second.str()};
  }

  inline void
  check(const std::string &what,
        const Settings    &settings,
        const unsigned int n_iterations)
  {
    const StepSummary step =
      run_scene(two_boxes(),
                field.displacement() + settings +
                  Settings{"Solver/Method=condensed", "Solver/Tolerance=1e-8"})
        .steps.back();
    verdict(what + ": iterations", *step.solver->iterations, n_iterations);
    verdict(what + ": displacement", *step.errors->displacement_l2, 1e-8);
    verdict(what + ": stress", *step.errors->energy, 1e-6);
  }

  inline const Settings tetrahedra = {"Body lower/Mesh/Cells=tetrahedra",
                                      "Body upper/Mesh/Cells=tetrahedra"};
} // namespace mortise::testing
