#include <deal.II/base/mpi.h>

#include <mortise/adapt/error_estimate.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/gmsh_model.h>
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

    /// Edges of a new mesh are at least 2^-3 of what they were: errors are not
    /// known well.
    constexpr unsigned int most_halvings = 3;

    /// Edges are then 2^-9 of what they were, and degrees rise from there: else
    /// meshes could go on without end.
    constexpr unsigned int most_meshes = 3;

    constexpr double least_growth = 1.02; ///< of unknowns, of a new mesh

    /// By which an estimate is multiplied if the square of the one before was too small by @p ratio, as
    /// the change that followed has shown, to which the error that is left is
    /// orthogonal: half the way, since estimates go up and down.
    double
    calibration_by(const double ratio)
    {
      return std::min(most_calibration,
                      std::max(least_calibration, std::pow(ratio, 0.25)));
    }

    /// Can gmsh make another mesh of these tetrahedra?
    bool
    can_be_remeshed(const BodyParameters &given, const Body &body)
    {
      return body.mesh.tetrahedra && given.mesh.source == "file" &&
             is_geometry_file(given.mesh.file);
    }

    /// Is there a cell on which nothing is known of the error? Collective.
    bool
    has_unknown_errors(const Bodies &bodies, const CellStates &states)
    {
      unsigned int result = 0;
      for_each_cell(bodies,
                    states,
                    [&](const Body &, const auto &, const CellState &state) {
                      result |=
                        state.history.is_new && !state.history.is_refined;
                    });
      return Utilities::MPI::max(
               result, bodies.front()->triangulation().get_communicator()) == 1;
    }

    /// Collective.
    bool
    splits_tetrahedra(const Body                    &body,
                      const std::vector<Refinement> &refinements)
    {
      const bool any =
        body.mesh.tetrahedra &&
        std::find(refinements.begin(), refinements.end(), Refinement::split) !=
          refinements.end();
      return Utilities::MPI::max(any ? 1 : 0,
                                 body.triangulation().get_communicator()) == 1;
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
        if (meshes.empty() || meshes[body->index].sizes == nullptr)
          continue;
        auto       stage = run.log.stage(run.timers, "mesh");
        const auto n     = body->triangulation().n_global_active_cells();
        body->pressure.reset();
        body->dof_handler.clear();
        create_mesh(run, meshes[body->index].sizes, *body);
        states[body->index] =
          states_after(*body,
                       meshes[body->index],
                       rigid_motion(run.parameters.bodies[body->index].mesh));
        stage.details(
          "body " + body->name + ", " + std::to_string(n) + " cells become " +
          std::to_string(body->triangulation().n_global_active_cells()));
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
    if (cycle > 0 && meshes.empty())
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
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    CellHistory &history = state.history;
                    history.degree       = state.degree;
                    if (history.is_new && !history.is_refined)
                      history.change = history.error =
                        energy[body.index][cell->active_cell_index()];
                  });
    double calibration = 1.;
    if (has_unknown_errors(bodies, states))
      {
        squared_error = 0.;
        estimated.reset();
      }
    else
      {
        const double before = squared_error, change = learn(bodies, solutions);
        squared_error = 0.;
        for_each_cell(bodies,
                      states,
                      [&](const Body &, const auto &, const CellState &state) {
                        squared_error += state.history.error;
                      });
        squared_error = Utilities::MPI::sum(squared_error, run.comm);
        if (before > 0.)
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
    estimate_errors(bodies, changes, states);
    return sum(changes, run.comm);
  }

  double
  Adaptivity::next_unknowns(const Bodies      &bodies,
                            const Refinements &choices) const
  {
    double now = 0., more = 0.;
    for (const auto &body : bodies)
      {
        const double n = body->dof_handler.n_dofs();
        now += n;
        if (!meshes.empty())
          more += n * (meshes[body->index].growth - 1.);
      }
    return now * growth(bodies, states, choices) + more;
  }

  bool
  Adaptivity::plan_meshes(const Bodies      &bodies,
                          const Refinements &choices,
                          const double       allowed)
  {
    Refinements none;
    double      n_cells = 0., now = 0.;
    for (const auto &body : bodies)
      {
        none.emplace_back(choices[body->index].size(), Refinement::keep);
        n_cells += body->triangulation().n_global_active_cells();
        now += body->dof_handler.n_dofs();
      }
    for (unsigned int most = most_halvings; most > 0; --most)
      {
        meshes.assign(bodies.size(), {});
        for (const auto &body : bodies)
          if (splits_tetrahedra(*body, choices[body->index]))
            {
              const BodyParameters &given = run.parameters.bodies[body->index];
              meshes[body->index] =
                plan_remeshing(*body,
                               choices[body->index],
                               states[body->index],
                               {share_of_cell * allowed / n_cells,
                                most,
                                *given_degrees(given).begin(),
                                rigid_motion(given.mesh),
                                given.mesh.refinements});
            }
        // one that is hardly finer is not worth what it costs
        const double next = next_unknowns(bodies, none);
        if (next < least_growth * now)
          break;
        if (next <= run.parameters.adaptivity.most_unknowns)
          return true;
      }
    meshes.clear();
    return false;
  }

  void
  Adaptivity::choose(const Bodies &bodies, const double allowed)
  {
    const AdaptivityParameters &given = run.parameters.adaptivity;
    RefinementOptions           options{given.splits(),
                              given.strategy == "h",
                              given.largest_degree,
                              {}};
    for (const auto &body : bodies)
      options.may_remesh.push_back(
        given.splits() && n_meshes < most_meshes &&
        can_be_remeshed(run.parameters.bodies[body->index], *body));
    if (cycle == 1 && given.splits())
      for (const auto &body : bodies)
        if (body->mesh.tetrahedra && !options.may_remesh[body->index])
          run.log.line("  body " + body->name +
                       ": tetrahedra without a geometry keep their size, "
                       "degrees alone rise");
    meshes.clear();
    const auto choose = [&] {
      // the first changes are those of all cells
      return estimated ? choose_refinements(bodies, states, options, allowed) :
                         refine_new(bodies, states, options);
    };
    auto       choices = choose();
    const bool wants_meshes =
      std::any_of(bodies.begin(), bodies.end(), [&](const auto &body) {
        return splits_tetrahedra(*body, choices[body->index]);
      });
    if (wants_meshes && !plan_meshes(bodies, choices, allowed))
      {
        options.may_remesh.assign(bodies.size(), false);
        choices = choose();
      }
    if (!meshes.empty())
      ++n_meshes;
    if (!meshes.empty()) // what else is refined would have no change
      for (auto &of_body : choices)
        std::fill(of_body.begin(), of_body.end(), Refinement::keep);
    const double next = next_unknowns(bodies, choices);
    if (meshes.empty() && growth(bodies, states, choices) == 1.)
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
                        std::string("not known after one cycle on a mesh")) +
           "; Adaptivity/Target error is " +
           RunLog::number(*run.parameters.adaptivity.target_error) +
           ", and Adaptivity/" + stopped_by +
           " allows no more. The last result is written";
  }

} // namespace mortise
