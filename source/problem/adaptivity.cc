#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <mortise/adapt/error_tail.h>
#include <mortise/adapt/smoothness.h>
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
    /// Of what a cell may have of the error if all have the same.
    constexpr double share = 0.25;

    /// Of the square of the error that is allowed, what the next cycle is to
    /// have: what it will have is not known well.
    constexpr double aim = 0.5;

    /// What a split is taken to leave of the square of an error beside corners
    /// and edges, and a rise at least.
    constexpr double after_split = 0.5, after_rise = 0.02;

    /// Of the squares of changes from degree to degree; corners have more, at
    /// degree three 0.2 (Fichera's).
    constexpr double fall_of_smooth = 0.1;

    /// A calibration makes estimates smaller by less than larger.
    constexpr double least_calibration = 0.77, most_calibration = 1.5;

    /// Call @p visit(cell, its state) for the owned cells of all @p bodies.
    template <typename States, typename Visit>
    void
    for_each_cell(const Bodies &bodies, States &states, const Visit &visit)
    {
      for (const auto &body : bodies)
        for (const auto &cell : body->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            visit(*body, cell, states[body->index][cell->active_cell_index()]);
    }

    /// By which an estimate is multiplied after the square of the one before
    /// was
    /// @p ratio times too small, as a change, being orthogonal to the error that it leaves, has shown: half
    /// the way, since both go up and down.
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

  namespace
  {
    /// The sum over the family of @p cell, which is on one rank; as much as has not been
    /// cut further stands for it all.
    double
    of_family(const Body::CellIterator  &cell,
              const std::vector<double> &of_cells)
    {
      const auto   parent = cell->parent();
      double       sum    = 0.;
      unsigned int n      = 0;
      for (unsigned int c = 0; c < parent->n_children(); ++c)
        if (parent->child(c)->is_active())
          {
            sum += of_cells[parent->child(c)->active_cell_index()];
            ++n;
          }
      return sum * parent->n_children() / n;
    }

    /// Nothing of tetrahedra and of low degrees.
    std::optional<double>
    decay(const Body &body, const CellState &state)
    {
      if (body.mesh.tetrahedra || state.degree < least_degree_of_decay)
        return {};
      return legendre_decay(state.degree, state.coefficients);
    }

    /// Is the solution smooth, as changes or coefficients say? Nothing where
    /// neither is known.
    std::optional<bool>
    smooth(const Body &body, const CellState &state)
    {
      if (state.history.fall < fall_of_smooth)
        return true;
      const auto falls = decay(body, state);
      return falls ? std::optional<bool>(is_smooth(*falls)) : std::nullopt;
    }

    /// After the refinement that made the square @p change on a cell, and @p of_family in all on
    /// its siblings and it.
    ErrorTail
    tail(const Body      &body,
         const CellState &state,
         const double     change,
         const double     of_family)
    {
      const CellHistory &history        = state.history;
      const bool         is_smooth_here = smooth(body, state).value_or(false);
      if (history.is_split && is_smooth_here)
        return smooth_split_tail(history.degree);
      if (history.is_split)
        return geometric_tail(of_family,
                              history.change,
                              1,
                              std::pow(0.25, history.degree));
      if (is_smooth_here)
        return smooth_tail(change,
                           history.change,
                           decay(body, state).value_or(0.));
      if (history.n_rises == 1)
        return geometric_tail(change, history.change, 1, 0.);
      return power_tail(history.degree, change, history.change);
    }
  } // namespace

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
    for_each_cell(
      bodies,
      states,
      [&](const Body &body, const auto &cell, CellState &state) {
        CellHistory &history = state.history;
        if (!history.is_refined)
          return;
        const auto  &of_body = changes[body.index];
        const double change  = of_body[cell->active_cell_index()];
        ErrorTail    left;
        if (cycle == 1 && !history.is_split)
          {
            // from degree zero, which has no energy
            left =
              geometric_tail(change, history.change, history.degree - 1, 0.);
            history.fall = left.ratio;
          }
        else
          {
            if (history.n_rises > 1)
              history.fall = change / history.change;
            left = tail(body,
                        state,
                        change,
                        history.is_split ? of_family(cell, of_body) : 0.);
          }
        history.error  = change * left.left;
        history.ratio  = left.ratio;
        history.change = change;
      });
    return sum(changes, run.comm);
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

  Adaptivity::Choice
  Adaptivity::best_choice(const Body &body, const CellState &state) const
  {
    const AdaptivityParameters &given = run.parameters.adaptivity;
    const bool can_split              = !body.mesh.tetrahedra && given.splits();
    const bool can_rise               = state.degree < given.largest_degree;
    if (can_split && (given.strategy == "h" || !can_rise ||
                      !smooth(body, state).value_or(true)))
      return Choice::split;
    return can_rise ? Choice::rise : Choice::keep;
  }

  void
  Adaptivity::choose(const Bodies &bodies, const double allowed)
  {
    Choices choices;
    for (const auto &of_body : states)
      choices.emplace_back(of_body.size(), Choice::keep);
    for_each_cell(
      bodies, choices, [&](const Body &body, const auto &cell, Choice &choice) {
        choice =
          best_choice(body, states[body.index][cell->active_cell_index()]);
      });
    // the first changes are those of all cells
    const double least = cycle == 1 ? -1. : threshold(bodies, choices, allowed);
    unsigned int n[2]  = {0, 0};
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    Choice &choice =
                      choices[body.index][cell->active_cell_index()];
                    if (!(state.history.error > least))
                      choice = Choice::keep;
                    n[0] += choice == Choice::rise ? 1 : 0;
                    n[1] += choice == Choice::split ? 1 : 0;
                  });
    Utilities::MPI::sum(n, run.comm, n);
    const AdaptivityParameters &given = run.parameters.adaptivity;
    if (n[0] + n[1] == 0)
      {
        stopped_by = "Largest degree = " + std::to_string(given.largest_degree);
        return;
      }
    raise_around(bodies, choices);
    if (const double next = n_unknowns(bodies, choices);
        next > given.most_unknowns)
      stopped_by =
        "Largest number of unknowns = " + RunLog::number(given.most_unknowns) +
        ", the next cycle needs about " + RunLog::number(next);
    splits.clear();
    for (const auto &of_body : choices)
      {
        splits.emplace_back();
        for (const Choice choice : of_body)
          splits.back().push_back(choice == Choice::split);
      }
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    const bool rises =
                      choices[body.index][cell->active_cell_index()] ==
                      Choice::rise;
                    state.history.is_refined = rises;
                    state.history.is_split   = false;
                    state.history.degree += rises ? 1 : 0;
                    state.history.n_rises += rises ? 1 : 0;
                  });
  }

  double
  Adaptivity::threshold(const Bodies  &bodies,
                        const Choices &best,
                        const double   allowed) const
  {
    double n_cells = 0., largest = 0.;
    for (const auto &body : bodies)
      n_cells += body->triangulation().n_global_active_cells();
    for_each_cell(bodies,
                  states,
                  [&](const Body &, const auto &, const CellState &state) {
                    largest = std::max(largest, state.history.error);
                  });
    largest                 = Utilities::MPI::max(largest, run.comm);
    const auto left_by_next = [&](const double least) {
      double left = 0.;
      for_each_cell(
        bodies,
        states,
        [&](const Body &body, const auto &cell, const CellState &state) {
          const Choice choice = best[body.index][cell->active_cell_index()];
          const CellHistory &history = state.history;
          const double       ratio   = choice == Choice::rise ?
                                         std::max(after_rise, history.ratio) :
                                         after_split;
          left +=
            history.error *
            (choice != Choice::keep && history.error > least ? ratio : 1.);
        });
      return Utilities::MPI::sum(left, run.comm);
    };
    // what is small beside others waits: they show through in it
    double least = share * std::max(allowed, left_by_next(largest)) / n_cells,
           most  = largest;
    if (!(left_by_next(least) < aim * allowed))
      return least;
    while (most > 1.1 * least)
      {
        const double middle = std::sqrt(least * most);
        (left_by_next(middle) < aim * allowed ? least : most) = middle;
      }
    return least;
  }

  void
  Adaptivity::raise_around(const Bodies &bodies, Choices &choices) const
  {
    for (const auto &body : bodies)
      {
        const auto &triangulation = body->triangulation();
        const auto &of_body       = states[body->index];
        auto       &chosen        = choices[body->index];
        // what a cell has alone on a face it cannot use: its neighbours rise
        // to it
        std::vector<unsigned int> wanted(triangulation.n_vertices(), 0);
        const auto want = [&](const auto &cell, const unsigned int degree) {
          for (const unsigned int v : cell->vertex_indices())
            wanted[cell->vertex_index(v)] =
              std::max(wanted[cell->vertex_index(v)], degree);
        };
        const auto rises_to = [&](const auto &cell) -> unsigned int {
          const unsigned int k = cell->active_cell_index();
          return chosen[k] == Choice::rise ? of_body[k].history.degree + 1 : 0;
        };
        for (const auto &cell : triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            want(cell, rises_to(cell));
        GridTools::exchange_cell_data_to_ghosts<unsigned int,
                                                Triangulation<dim>>(
          triangulation,
          [&](const auto &cell) { return rises_to(cell); },
          [&](const auto &cell, const unsigned int degree) {
            want(cell, degree);
          });
        for (const auto &cell : triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              const unsigned int k = cell->active_cell_index();
              for (const unsigned int v : cell->vertex_indices())
                if (chosen[k] == Choice::keep &&
                    wanted[cell->vertex_index(v)] > of_body[k].history.degree)
                  chosen[k] = Choice::rise;
            }
      }
  }

  double
  Adaptivity::n_unknowns(const Bodies &bodies, const Choices &choices) const
  {
    double size[2] = {0., 0.}; // about, without the sharing of nodes
    for_each_cell(
      bodies,
      states,
      [&](const Body &body, const auto &cell, const CellState &state) {
        const unsigned int p = state.history.degree;
        const Choice choice  = choices[body.index][cell->active_cell_index()];
        size[0] += std::pow(p, 3);
        size[1] += choice == Choice::split ? 8. * std::pow(p, 3) :
                   choice == Choice::rise  ? std::pow(p + 1., 3) :
                                             std::pow(p, 3);
      });
    Utilities::MPI::sum(size, run.comm, size);
    double now = 0.;
    for (const auto &body : bodies)
      now += body->dof_handler.n_dofs();
    return now * size[1] / size[0];
  }
} // namespace mortise
