// The table at the end of a run.
#pragma once

#include <mortise/base/run_log.h>
#include <mortise/output/summary.h>

namespace mortise
{
  /// Bodies, interfaces, errors and quantities of @p step.
  void
  print_table(RunLog &log, const StepSummary &step);
} // namespace mortise
