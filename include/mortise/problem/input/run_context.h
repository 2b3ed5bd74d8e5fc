// Parameters, log, timers and communicator of a run, for all its stages.
#pragma once

#include <mortise/base/run_log.h>
#include <mortise/base/timers.h>
#include <mortise/problem/input/parameters.h>
#include <mpi.h>

namespace mortise
{
  struct RunContext
  {
    const Parameters &parameters;
    RunLog           &log;
    Timers           &timers;
    MPI_Comm          comm;
  };
} // namespace mortise
