#include "scene.h"

#include <mortise/problem/simulation.h>

#include <sstream>

namespace mortise::testing
{
  Summary
  run_scene(const std::string        &text,
            const Settings           &settings,
            const MPI_Comm            comm,
            std::vector<std::string> *warnings)
  {
    const Parameters parameters = parse_parameters(text, "test", settings);
    validate(parameters);
    std::ostringstream silence;
    RunLog             log(silence, comm);
    Simulation         simulation(parameters, log, comm);
    simulation.compute();
    if (warnings)
      *warnings = log.warnings();
    return simulation.result();
  }
} // namespace mortise::testing
