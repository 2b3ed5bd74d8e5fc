// What Simulation writes: progress, fields, checkpoints, the summary.
#include <mortise/output/checkpoint.h>
#include <mortise/problem/simulation.h>

#include <filesystem>

namespace mortise
{
  void
  Simulation::write_results(const StepEvaluation &evaluation)
  {
    // a later cycle may not come to its end, and has the same file
    const bool each_cycle = adaptivity && !context.parameters.steps.given();
    if (!report.converged || each_cycle ||
        (is_last_cycle() && steps.output_due()))
      for (const OutputError &error :
           files.write(steps.n_done(),
                       steps.time(),
                       evaluation,
                       adaptivity ? adaptivity->errors().by_cell() :
                                    NumbersByCell()))
        unwritten.push_back(error);
    const unsigned int every = context.parameters.output.checkpoint_every;
    if (every > 0 && report.converged &&
        ((adaptivity ? adaptivity->n_cycles() : steps.n_done()) % every == 0 ||
         steps.finished() || !unwritten.empty())) // it goes no further
      write_checkpoint(evaluation);
  }

  void
  Simulation::write_checkpoint(const StepEvaluation &evaluation)
  {
    const auto          stage = context.log.stage(context.timers, "checkpoint");
    const Parameters   &parameters = context.parameters;
    const RunCheckpoint checkpoint{
      std::filesystem::absolute(parameters.file).string(),
      parameters.assignments,
      steps.longest(),
      steps.n_done(),
      {steps.time(), {}, state.pressing, state.shortenings},
      adaptivity && (!parameters.steps.given() || !is_last_cycle()) ?
        to_bytes(adaptivity->checkpoint()) :
        std::string(),
      summary.steps,
      files.written()};
    try
      {
        mortise::write_checkpoint(parameters.output.directory,
                                  to_sections(checkpoint),
                                  {evaluation.solutions(),
                                   evaluation.multipliers()},
                                  bodies,
                                  discretisation->interfaces().all(),
                                  context.comm);
      }
    catch (const OutputError &error)
      {
        unwritten.push_back(error);
      }
    summary.status = "running";
    write_summary();
  }

  void
  Simulation::print_progress()
  {
    const double share = steps.share(), seconds = context.timers.total();
    const double left =
      (seconds - clock.seconds) / (share - clock.share) * (1. - share);
    if (clock.seconds == 0.)
      clock = {share, seconds}; // the first step made the preconditioner, too
    context.log.line(
      "  " + RunLog::number(100. * share) + " % done in " +
      RunLog::number(seconds) + " s" +
      (steps.finished() ? "" : ", about " + RunLog::number(left) + " s left"));
  }

  void
  Simulation::write_summary()
  {
    summary.timings = context.timers.walls(context.comm);
    summary.memory  = peak_memory_mib(context.comm);
    try
      {
        mortise::write_summary(summary,
                               context.parameters.output.directory,
                               context.comm);
      }
    catch (const OutputError &error)
      {
        unwritten.push_back(error);
      }
  }
} // namespace mortise
