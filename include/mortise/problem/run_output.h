// Output of a run: fields, checkpoints, summary, and errors of writing them.
#pragma once

#include <mortise/output/checkpoint_file.h>
#include <mortise/output/whole_file.h>
#include <mortise/problem/load_steps.h>
#include <mortise/problem/results/field_files.h>
#include <mortise/problem/state.h>

#include <vector>

namespace mortise
{
  class RunOutput
  {
  public:
    /// @p run must live on.
    explicit RunOutput(const RunContext &run)
      : files(run)
      , run(run)
    {}

    /// The fields of the last of @p steps, at @p time, see FieldFiles. Collective, as all functions
    /// below.
    void
    write_fields(const LoadSteps      &steps,
                 double                time,
                 const StepEvaluation &evaluation,
                 const NumbersByCell  &estimates);

    /// @p of_run: sections of the driver, beside the values of @p evaluation on
    /// @p bodies and the increment of @p path.
    void
    write_checkpoint(const Sections       &of_run,
                     const PathState      &path,
                     const StepEvaluation &evaluation,
                     const Bodies         &bodies);

    /// With timings and memory so far.
    void
    write_summary(Summary &summary);

    /// The same of a run that goes on, for those who watch it, and for what is
    /// left of it if it is killed: after its first step, then every five
    /// seconds at most.
    void
    write_running(Summary &summary);

    /// Print the completed fraction of @p steps and the estimated remaining
    /// time.
    void
    print_progress(const LoadSteps &steps);

    /// Progress counts from this fraction on.
    void
    begin_at(const double fraction)
    {
      clock.fraction = fraction;
    }

    const std::vector<OutputError> &
    unwritten() const
    {
      return errors;
    }

    FieldFiles files;

  private:
    /// Fraction that was completed at a time.
    struct Clock
    {
      double fraction = 0., seconds = 0.;
    };

    const RunContext        &run;
    Clock                    clock;
    double                   seconds_of_summary = -1.; ///< of the last one
    std::vector<OutputError> errors;
  };
} // namespace mortise
