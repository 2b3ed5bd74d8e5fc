// Runs scenes inside test programs and prints verdicts. It never blesses
// numbers.
#pragma once

#include <mortise/problem/simulation.h>

#include <cmath>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace mortise::testing
{
  /// Prints "OK  what" or "FAILED what: got, allowed"; rank 0 of the world
  /// only.
  inline void
  verdict(const std::string &what, const double got, const double allowed)
  {
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    if (got <= allowed)
      std::cout << "OK  " << what << std::endl;
    else
      std::cout << "FAILED  " << what << ": got " << got << ", allowed "
                << allowed << std::endl;
  }

  /// Run the scene of a parameter text, silently; nothing is written. @p warnings, if given, holds
  /// those of the run.
  inline Summary
  run_scene(const std::string        &text,
            const Settings           &settings,
            const MPI_Comm            comm     = MPI_COMM_WORLD,
            std::vector<std::string> *warnings = nullptr)
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

  /// Verdicts on the errors of a scene whose exact solution the elements hold.
  inline void
  exact_verdicts(const std::string &what, const ErrorSummary &errors)
  {
    verdict(what + ": displacement 1e-10", *errors.displacement_l2, 1e-10);
    verdict(what + ": stress 1e-10", *errors.energy, 1e-10);
    verdict(what + ": traction 1e-10", *errors.multiplier_l2, 1e-10);
  }

  inline Settings
  operator+(Settings a, const Settings &b)
  {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  /// log_2 of the ratio of two errors, over log_2 of the ratio of mesh sizes.
  inline double
  rate(const double coarse, const double fine, const double refinement = 2.)
  {
    return std::log(coarse / fine) / std::log(refinement);
  }
} // namespace mortise::testing
