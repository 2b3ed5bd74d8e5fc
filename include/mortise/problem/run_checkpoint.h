// What the driver keeps in a checkpoint beside the solution, as text.
#pragma once

#include <mortise/output/summary.h>
#include <mortise/problem/input/parameters.h>

#include <string>
#include <utility>
#include <vector>

namespace mortise
{
  struct RunCheckpoint
  {
    std::string             file;        ///< the parameter file, absolute
    std::vector<Assignment> assignments; ///< its lines and those of --set

    double       time         = 0.; ///< that was reached
    double       longest_step = 0.; ///< see LoadSteps; may be infinite
    unsigned int n_steps      = 0;  ///< accepted
    std::string  adaptivity;        ///< Adaptivity::checkpoint()
    std::vector<StepSummary>                     steps;
    std::vector<std::pair<unsigned int, double>> files; ///< see FieldFiles
  };

  std::string
  to_text(const RunCheckpoint &checkpoint);

  /// Of the checkpoint in @p directory. Collective; throws InputError if there is
  /// none or its text is not what to_text() gives.
  RunCheckpoint
  read_run_checkpoint(const std::string &directory, MPI_Comm comm);

  /// The parameters of the run that wrote @p checkpoint, with @p settings after them; results go to
  /// @p directory unless these say otherwise. Throws InputError.
  Parameters
  restart_parameters(const RunCheckpoint &checkpoint,
                     const Settings      &settings,
                     const std::string   &directory);
} // namespace mortise
