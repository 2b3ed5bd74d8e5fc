#include <deal.II/base/mpi.h>

#include <mortise/adapt/error_estimate.h>
#include <mortise/adapt/refinement.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/adaptivity.h>
#include <mortise/problem/formulation.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// A calibration makes estimates smaller by less than larger.
    constexpr double least_calibration = 0.77, most_calibration = 1.5;

    /// By which an estimate is multiplied if the square of the one before was too small by @p ratio, as
    /// the change that followed has shown, to which the error that is left is
    /// orthogonal: half the way, since estimates go up and down.
    double
    calibration_by(const double ratio)
    {
      return std::min(most_calibration,
                      std::max(least_calibration, std::pow(ratio, 0.25)));
    }

    double
    sum(const std::vector<std::vector<double>> &numbers, const MPI_Comm comm)
    {
      double result = 0.;
      for (const auto &of_body : numbers)
        for (const double number : of_body)
          result += number;
      return Utilities::MPI::sum(result, comm);
    }
  } // namespace

  Parameters
  with_tolerance(Parameters parameters)
  {
    if (const auto &target = parameters.adaptivity.target_error)
      parameters.solver.tolerance =
        std::max(parameters.solver.tolerance, 1e-3 * *target);
    return parameters;
  }

  void
  check_adaptivity(const Parameters &parameters)
  {
    const auto &fields = parameters.output.fields;
    if (!parameters.adaptivity.target_error)
      {
        if (std::find(fields.begin(), fields.end(), "estimate") != fields.end())
          parameters.fail("Output/Fields",
                          "estimate without Adaptivity/Target error",
                          "estimate in a run with a target");
        return;
      }
    if (parameters.steps.given())
      parameters.fail("Adaptivity/Target error",
                      RunLog::number(*parameters.adaptivity.target_error) +
                        " together with Steps",
                      "a scene without steps");
    if (parameters.output.checkpoint_every > 0)
      parameters.fail("Output/Checkpoint every",
                      std::to_string(parameters.output.checkpoint_every) +
                        " together with Adaptivity/Target error",
                      "0");
    // the first rise tells the first error
    for (const BodyParameters &body : parameters.bodies)
      {
        const unsigned int most = *given_degrees(body).rbegin();
        if (most >= parameters.adaptivity.largest_degree)
          parameters.fail(
            "Adaptivity/Largest degree",
            std::to_string(parameters.adaptivity.largest_degree) +
              " with body " + in_quotes(body.name) + " of degree " +
              std::to_string(most),
            "above all degrees that are given, from which cycles begin");
      }
  }

  Adaptivity::Adaptivity(const RunContext &run)
    : run(run)
  {}

  void
  Adaptivity::refine(Bodies &bodies)
  {
    if (cycle == 0)
      return;
    for (const auto &body : bodies)
      {
        const auto &split = splits[body->index];
        const bool  any =
          std::find(split.begin(), split.end(), true) != split.end();
        if (Utilities::MPI::max(any ? 1 : 0, run.comm) == 1)
          split_cells(*body, split, states[body->index]);
      }
  }

  CellDegrees
  Adaptivity::degrees() const
  {
    CellDegrees result(states.size());
    for (unsigned int b = 0; b < states.size(); ++b)
      for (const CellState &state : states[b])
        result[b].push_back(state.history.degree);
    return result;
  }

  const std::vector<BodySolution> &
  Adaptivity::start(const Bodies &bodies)
  {
    if (cycle > 0)
      earlier = embedded(bodies, states);
    return earlier;
  }

  void
  Adaptivity::add(const Bodies                    &bodies,
                  const std::vector<BodySolution> &solutions)
  {
    const auto   energy = energy_by_cell(bodies, solutions);
    const double norm   = std::sqrt(sum(energy, run.comm));
    set_coefficients(bodies, solutions, states);
    if (cycle == 0)
      for_each_cell(bodies,
                    states,
                    [&](const Body &body, const auto &cell, CellState &state) {
                      state.history.degree = state.degree;
                      state.history.change = state.history.error =
                        energy[body.index][cell->active_cell_index()];
                    });
    double calibration = 1.;
    if (cycle > 0)
      {
        const double before = squared_error, change = learn(bodies, solutions);
        squared_error = 0.;
        for_each_cell(bodies,
                      states,
                      [&](const Body &, const auto &, const CellState &state) {
                        squared_error += state.history.error;
                      });
        squared_error = Utilities::MPI::sum(squared_error, run.comm);
        if (cycle > 1 && before > 0.)
          calibration = calibration_by((change + squared_error) / before);
        estimated =
          calibration * std::sqrt(squared_error) / (norm > 0. ? norm : 1.);
      }
    ++cycle;
    const double allowed =
      *run.parameters.adaptivity.target_error * norm / calibration;
    if (!reached())
      choose(bodies, allowed * allowed);
  }

  double
  Adaptivity::learn(const Bodies                    &bodies,
                    const std::vector<BodySolution> &solutions)
  {
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        earlier[b].displacement -= solutions[b].displacement;
        earlier[b].displacement.update_ghost_values();
        if (bodies[b]->pressure)
          {
            earlier[b].pressure -= solutions[b].pressure;
            earlier[b].pressure.update_ghost_values();
          }
      }
    const auto changes = energy_by_cell(bodies, earlier);
    earlier.clear();
    estimate_errors(bodies, changes, cycle == 1, states);
    return sum(changes, run.comm);
  }

  void
  Adaptivity::choose(const Bodies &bodies, const double allowed)
  {
    const AdaptivityParameters &given = run.parameters.adaptivity;
    const RefinementOptions     options{given.splits(),
                                    given.strategy == "h",
                                    given.largest_degree};
    // the first changes are those of all cells
    const auto choices = cycle == 1 ?
                           refine_all(bodies, states, options) :
                           choose_refinements(bodies, states, options, allowed);
    double     now     = 0.;
    for (const auto &body : bodies)
      now += body->dof_handler.n_dofs();
    const double next = now * growth(bodies, states, choices);
    if (next == now)
      stopped_by = "Largest degree = " + std::to_string(given.largest_degree);
    else if (next > given.most_unknowns)
      stopped_by =
        "Largest number of unknowns = " + RunLog::number(given.most_unknowns) +
        ", the next cycle needs about " + RunLog::number(next);
    splits = prepare_refinement(bodies, choices, states);
  }

  std::vector<std::vector<double>>
  Adaptivity::cell_estimates() const
  {
    std::vector<std::vector<double>> result;
    if (!estimated)
      return result;
    const double factor =
      squared_error > 0. ? *estimated / std::sqrt(squared_error) : 0.;
    for (const auto &of_body : states)
      {
        result.emplace_back();
        for (const CellState &state : of_body)
          result.back().push_back(factor * std::sqrt(state.history.error));
      }
    return result;
  }

  std::string
  Adaptivity::missed() const
  {
    return "The error is " +
           (estimated ? "estimated as " + RunLog::number(*estimated) :
                        std::string("not known after one cycle")) +
           "; Adaptivity/Target error is " +
           RunLog::number(*run.parameters.adaptivity.target_error) +
           ", and Adaptivity/" + stopped_by +
           " allows no more. The last result is written";
  }

} // namespace mortise
