// State of the driver in a checkpoint, beside the values of the scene.
#pragma once

#include <mortise/output/checkpoint_file.h>
#include <mortise/output/summary.h>
#include <mortise/problem/input/parameters.h>
#include <mortise/problem/state.h>

#include <string>
#include <utility>
#include <vector>

namespace mortise
{
  struct RunCheckpoint
  {
    std::string             file;        ///< the parameter file, absolute
    std::vector<Assignment> assignments; ///< its lines and those of --set

    double       longest_step = 0.; ///< see LoadSteps; may be infinite
    unsigned int n_steps      = 0;  ///< accepted
    double       reached      = 0.; ///< time or length, see LoadSteps
    State        state;             ///< without its solution
    std::string  adaptivity;        ///< bytes of CycleCheckpoint
    std::vector<StepSummary>                     steps;
    std::vector<std::pair<unsigned int, double>> files; ///< see FieldFiles
  };

  Sections
  to_sections(const RunCheckpoint &checkpoint);

  /// Read it from the checkpoint in @p directory. Collective; throws InputError
  /// if there is none or its sections are not those of to_sections().
  RunCheckpoint
  read_run_checkpoint(const std::string &directory, MPI_Comm comm);

  /// The parameters of the run that wrote @p checkpoint, with @p settings after them; results go to
  /// @p directory unless these say otherwise. Throws InputError.
  Parameters
  restart_parameters(const RunCheckpoint &checkpoint,
                     const Settings      &settings,
                     const std::string   &directory);
} // namespace mortise
