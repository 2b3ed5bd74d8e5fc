// How Simulation goes on from a checkpoint.
#include <mortise/base/error.h>
#include <mortise/output/checkpoint.h>
#include <mortise/output/checkpoint_file.h>
#include <mortise/problem/simulation.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mortise
{
  namespace
  {
    bool
    all_finite(const Checkpoint &checkpoint)
    {
      const auto finite = [](const double x) { return std::isfinite(x); };
      for (const BodySolution &solution : checkpoint.solutions)
        for (const BodyVector *values :
             {&solution.displacement, &solution.pressure})
          if (!std::all_of(values->begin(), values->end(), finite))
            return false;
      for (const auto &of_interface : checkpoint.multipliers)
        for (const auto &coefficients : of_interface)
          if (!std::all_of(coefficients.begin(), coefficients.end(), finite))
            return false;
      return true;
    }
  } // namespace

  void
  Simulation::resume(const RunCheckpoint &checkpoint,
                     const std::string   &directory)
  {
    restart       = directory;
    summary.steps = checkpoint.steps;
    files.resume(checkpoint.files);
    state.time = checkpoint.time;
    if (!checkpoint.adaptivity.empty() && parameters.adaptivity.target_error)
      {
        adaptivity.emplace(context);
        try
          {
            adaptivity->resume(checkpoint.adaptivity);
          }
        catch (const std::out_of_range &error)
          {
            throw damaged_checkpoint(checkpoint_file_name(directory),
                                     error.what());
          }
      }
    else if (parameters.adaptivity.target_error && !parameters.steps.given())
      parameters.fail("Adaptivity/Target error",
                      RunLog::number(*parameters.adaptivity.target_error) +
                        " with the checkpoint of a run without one",
                      "nothing, or a run from the beginning");
    // without steps the end was that of the last cycle
    if (!adaptivity || parameters.steps.given())
      steps.resume(checkpoint.time,
                   checkpoint.n_steps,
                   checkpoint.longest_step);
    if (adaptivity && !steps.finished())
      state.time = steps.next();
    clock.share = steps.share();
  }

  void
  Simulation::restore(const std::string &directory)
  {
    const Checkpoint checkpoint = read_checkpoint(
      directory, bodies, discretisation->interfaces().all(), context.comm);
    throw_if_any(all_finite(checkpoint) ?
                   "" :
                   damaged_checkpoint(checkpoint_file_name(directory),
                                      "it has values that are not finite")
                     .what(),
                 context.comm);
    const SceneData data(context.parameters, state.time, field_checks);
    SceneLoad       load = discretisation->load(data);
    state.solution       = discretisation->system_vector(checkpoint, load);
    preloads->resume(state.solution, load);
    if (contact)
      contact->resume(load, state.solution);
    else
      solver->remember(load.rhs, state.solution);
    if (adaptivity)
      adaptivity->restore(bodies, checkpoint.solutions);
    context.log.line(adaptivity ?
                       "continued after cycle " +
                         std::to_string(adaptivity->n_cycles() - 1) :
                       "continued from t = " + RunLog::number(state.time));
  }
} // namespace mortise
