// How Simulation goes on from a checkpoint.
#include <mortise/base/error.h>
#include <mortise/output/checkpoint.h>
#include <mortise/problem/simulation.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mortise
{
  namespace
  {
    bool
    all_finite(const SceneValues &values)
    {
      const auto finite = [](const double x) { return std::isfinite(x); };
      for (const auto *solutions : {&values.solutions, &values.increments})
        for (const BodySolution &solution : *solutions)
          for (const BodyVector *field :
               {&solution.displacement, &solution.pressure})
            if (!std::all_of(field->begin(), field->end(), finite))
              return false;
      for (const auto &of_interface : values.multipliers)
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
    output.files.resume(checkpoint.files);
    state = checkpoint.state;
    if (!checkpoint.adaptivity.empty() && parameters.adaptivity.target_error)
      {
        adaptivity.emplace(context);
        try
          {
            adaptivity->resume(
              from_bytes<CycleCheckpoint>(checkpoint.adaptivity));
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
    const bool leaves_path =
      !parameters.steps.by_arc_length && state.path.tangent > 0.;
    // without steps the end was that of the last cycle
    if (!adaptivity || parameters.steps.given())
      steps.resume(leaves_path ? state.time : checkpoint.reached,
                   checkpoint.n_steps,
                   checkpoint.longest_step);
    if (ends_path())
      steps.finish();
    if (adaptivity && !steps.finished() && state.time > checkpoint.reached)
      state.time = steps.next();
    output.begin_at(steps.fraction());
  }

  void
  Simulation::restore(const std::string &directory)
  {
    const CheckpointFile file(checkpoint_file_name(directory), context.comm);
    const SceneValues    values = read_scene(
      file, bodies, equations->discretisation.interfaces().all(), context.comm);
    throw_if_any(all_finite(values) ?
                   "" :
                   file.damaged("it has values that are not finite").what(),
                 context.comm);
    const SceneData data(context.parameters, state.time, field_checks);
    equations->resume(data, values, state);
    if (adaptivity)
      adaptivity->restore(bodies, values.solutions);
    context.log.line(adaptivity ?
                       "continued after cycle " +
                         std::to_string(adaptivity->n_cycles() - 1) :
                       "continued from t = " + RunLog::number(state.time));
  }
} // namespace mortise
