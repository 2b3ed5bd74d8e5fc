#include <deal.II/base/mpi.h>

#include <mortise/adapt/error_tail.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/adaptive/adaptivity.h>
#include <mortise/problem/input/formulation.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The least part that a refinement leaves of what does not come from
    /// cells.
    constexpr double least_ratio_of_rest = 0.1;

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

    std::vector<double>
    sums_by_body(const NumbersByCell &numbers, const MPI_Comm comm)
    {
      std::vector<double> result;
      for (const auto &of_body : numbers)
        result.push_back(std::accumulate(of_body.begin(), of_body.end(), 0.));
      Utilities::MPI::sum(result, comm, result);
      return result;
    }

    double
    sum(const std::vector<double> &numbers)
    {
      return std::accumulate(numbers.begin(), numbers.end(), 0.);
    }

    double
    sum(const NumbersByCell &numbers, const MPI_Comm comm)
    {
      return sum(sums_by_body(numbers, comm));
    }

    /// By body: what all bodies together have shown, or what its own residual
    /// has, where that fell, if it is more: where one body has most of the
    /// residual, what belongs to that of another is not seen. What a body alone
    /// shows is no more than what nothing shows, since it also changes by what
    /// others do.
    std::vector<double>
    squares_by_residual(const std::vector<double> &changes,
                        const std::vector<double> &before,
                        const std::vector<double> &now)
    {
      std::vector<double> result(changes.size(),
                                 square_by_residual(sum(changes),
                                                    sum(before),
                                                    sum(now)));
      for (unsigned int b = 0; b < result.size(); ++b)
        if (falls(before[b], now[b]))
          result[b] = std::max(
            result[b],
            std::min(square_by_residual_unseen,
                     square_by_residual(changes[b], before[b], now[b])));
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
    const auto &fields = parameters.output.fields;
    Quantity::given(parameters);
    if (!parameters.adaptivity.target_error)
      {
        if (!parameters.adaptivity.quantity.empty())
          parameters.fail("Adaptivity/Quantity",
                          in_quotes(parameters.adaptivity.quantity) +
                            " without Adaptivity/Target error",
                          "nothing, or give a target");
        if (std::find(fields.begin(), fields.end(), "estimate") != fields.end())
          parameters.fail("Output/Fields",
                          "estimate without Adaptivity/Target error",
                          "estimate in a run with a target");
        return;
      }
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
    , goal(Quantity::given(run.parameters))
  {}

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

  const std::vector<BodySolution> &
  Adaptivity::dual_start(const Bodies &bodies)
  {
    if (cycle > 0 && meshes.empty())
      earlier_dual = embedded(bodies, states, &CellState::dual);
    return earlier_dual;
  }

  namespace
  {
    /// a -= b.
    void
    subtract(std::vector<BodySolution> &a, const std::vector<BodySolution> &b)
    {
      for (unsigned int i = 0; i < a.size(); ++i)
        for (const auto part :
             {&BodySolution::displacement, &BodySolution::pressure})
          if ((b[i].*part).size() > 0)
            {
              a[i].*part -= b[i].*part;
              (a[i].*part).update_ghost_values();
            }
    }

    /// The roots of the products of both.
    NumbersByCell
    geometric_mean(NumbersByCell a, const NumbersByCell &b)
    {
      for (unsigned int i = 0; i < a.size(); ++i)
        for (unsigned int k = 0; k < a[i].size(); ++k)
          a[i][k] = std::sqrt(a[i][k] * b[i][k]);
      return a;
    }
  } // namespace

  void
  Adaptivity::add(const Bodies                          &bodies,
                  const std::vector<BodySolution>       &solutions,
                  const std::optional<DualSolution>     &dual,
                  const std::vector<InterfaceViolation> &violations,
                  const Residuals                       &residuals)
  {
    NumbersByCell size = energy_by_cell(bodies, solutions);
    set_coefficients(bodies, solutions, states);
    if (dual)
      {
        size = geometric_mean(std::move(size),
                              energy_by_cell(bodies, dual->solutions));
        set_coefficients(bodies, dual->solutions, states, &CellState::dual);
      }
    const double norm =
      dual ? std::fabs(dual->value) : std::sqrt(sum(size, run.comm));
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    CellHistory &history = state.history;
                    history.degree       = state.degree;
                    if (history.is_new && !history.is_refined)
                      history.change = history.error =
                        size[body.index][cell->active_cell_index()];
                  });
    set_violations(violations, norm);
    if (dual && cycle > 0 &&
        std::fabs(dual->value) <= run.parameters.solver.tolerance * dual->size)
      stopped_by = "Quantity = " + goal->name() +
                   " is zero beside the other components, which has no "
                   "relative error";
    if (!stopped_by.empty() || has_unknown_errors(bodies, states))
      {
        sums = {};
        rest = {};
        estimated.reset();
        at_most.reset();
        signed_error.reset();
        n_estimates = 0;
      }
    else
      estimate(bodies, solutions, dual, residuals, norm);
    residual = sums_by_body(residuals.equations, run.comm);
    if (dual)
      last_value = dual->value;
    ++cycle;
    // of cells as of all
    allowed = 0.;
    if (at_most && *at_most > 0.)
      allowed = sums.largest / (dual ? *at_most : *at_most * *at_most);
    if (run.parameters.output.checkpoint_every > 0)
      keep(bodies);
    choose(bodies);
  }

  void
  Adaptivity::set_violations(const std::vector<InterfaceViolation> &violations,
                             const double                           norm)
  {
    interfaces = violations;
    for (auto &of_body : states)
      for (CellState &state : of_body)
        {
          state.history.violation       = 0.;
          state.history.at_contact_edge = false;
        }
    for (InterfaceViolation &of : interfaces)
      {
        of.size       = norm > 0. ? of.size / norm : 0.;
        auto &of_body = states[of.body];
        for (unsigned int k = 0; k < of_body.size(); ++k)
          of_body[k].history.violation += of.of_cells[k];
        for (const auto &[body, cell] : of.at_contact_edge)
          states[body][cell].history.at_contact_edge = true;
      }
  }

  void
  Adaptivity::estimate(const Bodies                      &bodies,
                       const std::vector<BodySolution>   &solutions,
                       const std::optional<DualSolution> &dual,
                       const Residuals                   &residuals,
                       const double                       norm)
  {
    const std::vector<double> changes = learn(bodies, solutions, dual);
    const double              unit    = norm > 0. ? norm : 1.;
    ++n_estimates;
    if (dual)
      {
        sums      = error_sums(bodies, states);
        estimated = at_most = std::hypot(sums.of_quantity(), rest.error) / unit;
        signed_error        = sums.with_sign + rest.error;
        return;
      }
    set_errors(bodies,
               residuals,
               squares_by_residual(changes,
                                   residual,
                                   sums_by_body(residuals.equations, run.comm)),
               states);
    sums                    = error_sums(bodies, states);
    const double conditions = sum(residuals.conditions, run.comm),
                 for_sure = conditions + std::pow(unit * interface_error(), 2),
                 by_equations = sums.all - conditions;
    estimated                 = std::sqrt(for_sure + by_equations) / unit;
    // where displacements are prescribed the exact solution has less energy
    // than this one, by the square of the error
    constexpr double least_part = 0.01;
    const double     most =
      for_sure + std::pow(doubt_of_residuals(n_estimates), 2) * by_equations;
    at_most =
      std::sqrt(most / std::max(unit * unit - most, least_part * unit * unit));
  }

  std::vector<double>
  Adaptivity::learn(const Bodies                      &bodies,
                    const std::vector<BodySolution>   &solutions,
                    const std::optional<DualSolution> &dual)
  {
    subtract(earlier, solutions);
    NumbersByCell changes = energy_by_cell(bodies, earlier), own;
    if (dual)
      {
        subtract(earlier_dual, dual->solutions);
        changes = geometric_mean(std::move(changes),
                                 energy_by_cell(bodies, earlier_dual));
      }
    else
      own = own_parts(bodies, changes, states);
    estimate_errors(bodies, changes, own, states);
    if (dual)
      {
        const auto products = products_by_cell(bodies, earlier, earlier_dual);
        set_shares(bodies, products, states);
        // the first change is that from nothing
        const double before = rest.change == 0. ? last_value : rest.change;
        rest.change = dual->value - last_value - sum(products, run.comm);
        rest.error  = rest.change * geometric_tail(std::fabs(rest.change),
                                                  std::fabs(before),
                                                  1,
                                                  least_ratio_of_rest)
                                     .left;
      }
    earlier.clear();
    earlier_dual.clear();
    return sums_by_body(changes, run.comm);
  }

  double
  Adaptivity::interface_error() const
  {
    double square = 0.;
    for (const InterfaceViolation &of : interfaces)
      square += of.size * of.size;
    return std::sqrt(square);
  }
} // namespace mortise
