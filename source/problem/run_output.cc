#include <deal.II/base/mpi.h>

#include <mortise/output/checkpoint.h>
#include <mortise/problem/run_output.h>

namespace mortise
{
  void
  RunOutput::write_fields(const LoadSteps      &steps,
                          const double          time,
                          const StepEvaluation &evaluation,
                          const NumbersByCell  &estimates)
  {
    for (const OutputError &error :
         files.write(steps.n_done(), time, evaluation, estimates))
      errors.push_back(error);
  }

  void
  RunOutput::write_checkpoint(const Sections       &of_run,
                              const PathState      &path,
                              const StepEvaluation &evaluation,
                              const Bodies         &bodies)
  {
    const auto  stage = run.log.stage(run.timers, "checkpoint");
    SceneValues values{evaluation.solutions(), evaluation.multipliers()};
    if (path.increment.size() > 0)
      {
        SystemVector increment =
          evaluation.discretisation.linear_system().zero_vector();
        increment.displacement = path.increment;
        values.increments =
          evaluation.discretisation.solutions(SceneLoad(), increment);
      }
    try
      {
        mortise::write_checkpoint(run.parameters.output.directory,
                                  of_run,
                                  values,
                                  bodies,
                                  evaluation.discretisation.interfaces().all(),
                                  run.comm);
      }
    catch (const OutputError &error)
      {
        errors.push_back(error);
      }
  }

  void
  RunOutput::write_summary(Summary &summary)
  {
    summary.file = run.parameters.file;
    summary.parameters.clear();
    for (const Assignment &a : run.parameters.assignments)
      if (!a.opens_section())
        summary.parameters.emplace_back(path_of(a.sections, a.name), a.value);
    summary.warnings = run.log.warnings();
    summary.timings  = run.timers.walls(run.comm);
    summary.memory   = peak_memory_mib(run.comm);
    try
      {
        mortise::write_summary(summary,
                               run.parameters.output.directory,
                               run.comm);
      }
    catch (const OutputError &error)
      {
        errors.push_back(error);
      }
  }

  void
  RunOutput::write_running(Summary &summary)
  {
    constexpr double seconds_between = 5.;
    const double     now =
      dealii::Utilities::MPI::broadcast(run.comm, run.timers.total());
    if (seconds_of_summary >= 0. && now < seconds_of_summary + seconds_between)
      return;
    seconds_of_summary = now;
    summary.status     = "running";
    write_summary(summary);
  }

  void
  RunOutput::print_progress(const LoadSteps &steps)
  {
    const double fraction = steps.fraction(), seconds = run.timers.total();
    const double left =
      (seconds - clock.seconds) / (fraction - clock.fraction) * (1. - fraction);
    if (clock.seconds == 0.)
      clock = {fraction,
               seconds}; // the first step made the preconditioner, too
    run.log.progress(fraction, seconds, left);
  }
} // namespace mortise
