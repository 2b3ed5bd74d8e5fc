// See adaptivity.h.
#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <mortise/base/quotes.h>
#include <mortise/problem/adaptivity.h>
#include <mortise/problem/formulation.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Changes fall at least with the square of the degree: more slowly they do
    /// beside no corner, and what a cell does by chance is no rule.
    constexpr double least_decay = 2., largest_decay = 40.;

    constexpr double largest_ratio = 0.8; ///< where one change is known

    /// Of what a cell may have of the error if all have the same.
    constexpr double share = 0.25;

    double
    sum(const CellNumbers &numbers, const MPI_Comm comm)
    {
      double result = 0.;
      for (const auto &of_body : numbers)
        result = std::accumulate(of_body.begin(), of_body.end(), result);
      return Utilities::MPI::sum(result, comm);
    }

    CellDegrees
    degrees_of(const Bodies &bodies)
    {
      CellDegrees result;
      for (const auto &body : bodies)
        {
          auto &degrees =
            result.emplace_back(body->triangulation().n_active_cells(), 0);
          for (const auto &cell : body->dof_handler.active_cell_iterators())
            if (cell->is_locally_owned())
              degrees[cell->active_cell_index()] = body->degree(cell);
        }
      return result;
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
    if (!parameters.adaptivity.target_error)
      return;
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

  double
  tail_of_first_change(const unsigned int p,
                       const double       change,
                       const double       energy)
  {
    const double ratio =
      energy > 0. ?
        std::min(largest_ratio, std::pow(change / energy, 1. / (p - 1.))) :
        largest_ratio;
    return ratio / (1. - ratio);
  }

  double
  tail_of_changes(const unsigned int p, const double last, const double before)
  {
    const double decay =
      last > 0. ?
        std::min(largest_decay,
                 std::max(least_decay,
                          std::log(before / last) / std::log(p / (p - 1.)))) :
        largest_decay;
    // a few terms and the integral of the rest
    constexpr unsigned int n_terms = 10;
    double                 tail    = 0.;
    for (unsigned int q = p + 1; q <= p + n_terms; ++q)
      tail += std::pow(q / double(p), -decay);
    const double end = p + n_terms + 0.5;
    return tail + std::pow(end / p, -decay) * end / (decay - 1.);
  }

  Adaptivity::Adaptivity(const RunContext &run)
    : run(run)
  {}

  void
  Adaptivity::add(const Bodies                    &bodies,
                  const std::vector<BodySolution> &solutions)
  {
    const CellDegrees now    = degrees_of(bodies);
    const CellNumbers energy = energy_by_cell(bodies, solutions);
    const double      norm   = std::sqrt(sum(energy, run.comm));
    if (cycle == 0)
      errors = changes = energy;
    else
      {
        const CellNumbers change = sample->change(bodies, solutions);
        for (unsigned int b = 0; b < now.size(); ++b)
          for (unsigned int k = 0; k < now[b].size(); ++k)
            if (change[b][k] > 0.)
              {
                const auto tail =
                  cycle == 1 ? tail_of_first_change : tail_of_changes;
                errors[b][k] =
                  change[b][k] * tail(now[b][k], change[b][k], changes[b][k]);
                changes[b][k] = change[b][k];
              }
        estimated = std::sqrt(sum(errors, run.comm)) / (norm > 0. ? norm : 1.);
      }
    ++cycle;
    if (!reached())
      {
        choose(bodies, now, *run.parameters.adaptivity.target_error * norm);
        if (!stopped_by.empty())
          return;
        std::vector<std::vector<bool>> rises;
        for (unsigned int b = 0; b < now.size(); ++b)
          {
            rises.emplace_back();
            for (unsigned int k = 0; k < now[b].size(); ++k)
              rises[b].push_back(next[b][k] > now[b][k]);
          }
        sample.emplace(bodies, solutions, rises);
      }
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

  void
  Adaptivity::choose(const Bodies      &bodies,
                     const CellDegrees &now,
                     const double       allowed)
  {
    double n_cells = 0.;
    for (const auto &body : bodies)
      n_cells += body->triangulation().n_global_active_cells();
    // the first changes are those of all cells
    next           = risen(bodies,
                 now,
                 cycle == 1 ? -1. : share * allowed * allowed / n_cells);
    double size[2] = {0., 0.}; // about, without the sharing of nodes
    bool   rises   = false;
    for (unsigned int b = 0; b < now.size(); ++b)
      for (unsigned int k = 0; k < now[b].size(); ++k)
        {
          size[0] += std::pow(now[b][k], 3);
          size[1] += std::pow(next[b][k], 3);
          rises = rises || next[b][k] > now[b][k];
        }
    double n_unknowns = 0.;
    for (const auto &body : bodies)
      n_unknowns += body->dof_handler.n_dofs();
    n_unknowns *= Utilities::MPI::sum(size[1], run.comm) /
                  Utilities::MPI::sum(size[0], run.comm);
    const AdaptivityParameters &given = run.parameters.adaptivity;
    if (Utilities::MPI::max(rises ? 1 : 0, run.comm) == 0)
      stopped_by = "Largest degree = " + std::to_string(given.largest_degree);
    else if (n_unknowns > given.most_unknowns)
      stopped_by =
        "Largest number of unknowns = " + RunLog::number(given.most_unknowns) +
        ", the next cycle needs about " + RunLog::number(n_unknowns);
  }

  CellDegrees
  Adaptivity::risen(const Bodies      &bodies,
                    const CellDegrees &now,
                    const double       least) const
  {
    const unsigned int most   = run.parameters.adaptivity.largest_degree;
    CellDegrees        result = now;
    for (const auto &body : bodies)
      {
        const auto &triangulation = body->triangulation();
        const auto &degrees       = now[body->index];
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
          return errors[body->index][k] > least ?
                   std::min(most, degrees[k] + 1) :
                   0;
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
              unsigned int &degree =
                result[body->index][cell->active_cell_index()];
              const unsigned int own = degree;
              for (const unsigned int v : cell->vertex_indices())
                if (wanted[cell->vertex_index(v)] > own)
                  degree = own + 1;
            }
      }
    return result;
  }
} // namespace mortise
