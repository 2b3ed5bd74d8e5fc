#include <deal.II/base/mpi.h>

#include <mortise/adapt/cycle_errors.h>
#include <mortise/adapt/error_tail.h>

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
    total(const std::vector<double> &numbers)
    {
      return std::accumulate(numbers.begin(), numbers.end(), 0.);
    }

    double
    total(const NumbersByCell &numbers, const MPI_Comm comm)
    {
      return total(sums_by_body(numbers, comm));
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
                                 square_by_residual(total(changes),
                                                    total(before),
                                                    total(now)));
      for (unsigned int b = 0; b < result.size(); ++b)
        if (falls(before[b], now[b]))
          result[b] = std::max(
            result[b],
            std::min(square_by_residual_unseen,
                     square_by_residual(changes[b], before[b], now[b])));
      return result;
    }

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

  const std::vector<BodySolution> &
  CycleErrors::start(const Bodies &bodies, const bool goes_on)
  {
    if (goes_on)
      earlier = embedded(bodies, states);
    return earlier;
  }

  const std::vector<BodySolution> &
  CycleErrors::dual_start(const Bodies &bodies, const bool goes_on)
  {
    if (goes_on)
      earlier_dual = embedded(bodies, states, &CellState::dual);
    return earlier_dual;
  }

  void
  CycleErrors::add(const Bodies                      &bodies,
                   const std::vector<BodySolution>   &solutions,
                   const std::optional<DualSolution> &dual,
                   std::vector<InterfaceViolation>    broken,
                   const Residuals                   &residuals)
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
      dual ? std::fabs(dual->value) : std::sqrt(total(size, comm));
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    CellHistory &history = state.history;
                    history.degree       = state.degree;
                    if (history.is_new && !history.is_refined)
                      history.change = history.error =
                        size[body.index][cell->active_cell_index()];
                  });
    violations = std::move(broken);
    set_violations(norm);
    is_zero = dual && numbers.n_cycles > 0 &&
              std::fabs(dual->value) <= accuracy * dual->size;
    if (is_zero || has_unknown_errors(bodies, states))
      forget_estimate();
    else
      estimate(bodies, solutions, dual, residuals, norm);
    numbers.residual = sums_by_body(residuals.equations, comm);
    if (dual)
      numbers.value = dual->value;
    ++numbers.n_cycles;
    // of cells as of all
    const double at_most = numbers.at_most.value_or(0.);
    numbers.allowed =
      at_most > 0. ? sum.largest / (dual ? at_most : at_most * at_most) : 0.;
  }

  void
  CycleErrors::forget_estimate()
  {
    sum                    = {};
    numbers.change_of_rest = numbers.error_of_rest = 0.;
    numbers.estimate.reset();
    numbers.at_most.reset();
    signed_error.reset();
    numbers.n_estimates = 0;
  }

  void
  CycleErrors::set_violations(const double norm)
  {
    for (auto &of_body : states)
      for (CellState &state : of_body)
        {
          state.history.violation       = 0.;
          state.history.at_contact_edge = false;
        }
    for (InterfaceViolation &of : violations)
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
  CycleErrors::estimate(const Bodies                      &bodies,
                        const std::vector<BodySolution>   &solutions,
                        const std::optional<DualSolution> &dual,
                        const Residuals                   &residuals,
                        const double                       norm)
  {
    const std::vector<double> changes = learn(bodies, solutions, dual);
    const double              unit    = norm > 0. ? norm : 1.;
    ++numbers.n_estimates;
    if (dual)
      {
        sum              = error_sums(bodies, states);
        numbers.estimate = numbers.at_most =
          std::hypot(sum.of_quantity(), numbers.error_of_rest) / unit;
        signed_error = sum.with_sign + numbers.error_of_rest;
        return;
      }
    set_errors(bodies,
               residuals,
               squares_by_residual(changes,
                                   numbers.residual,
                                   sums_by_body(residuals.equations, comm)),
               states);
    sum                     = error_sums(bodies, states);
    const double conditions = total(residuals.conditions, comm),
                 for_sure   = conditions + std::pow(unit * of_interfaces(), 2),
                 by_equations = sum.all - conditions;
    numbers.estimate          = std::sqrt(for_sure + by_equations) / unit;
    // where displacements are prescribed the exact solution has less energy
    // than this one, by the square of the error
    constexpr double least_part = 0.01;
    const double     most =
      for_sure +
      std::pow(doubt_of_residuals(numbers.n_estimates), 2) * by_equations;
    numbers.at_most =
      std::sqrt(most / std::max(unit * unit - most, least_part * unit * unit));
  }

  std::vector<double>
  CycleErrors::learn(const Bodies                      &bodies,
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
        const double before =
          numbers.change_of_rest == 0. ? numbers.value : numbers.change_of_rest;
        numbers.change_of_rest =
          dual->value - numbers.value - total(products, comm);
        numbers.error_of_rest =
          numbers.change_of_rest *
          geometric_tail(std::fabs(numbers.change_of_rest),
                         std::fabs(before),
                         1,
                         least_ratio_of_rest)
            .left;
      }
    earlier.clear();
    earlier_dual.clear();
    return sums_by_body(changes, comm);
  }

  double
  CycleErrors::of_interfaces() const
  {
    double square = 0.;
    for (const InterfaceViolation &of : violations)
      square += of.size * of.size;
    return std::sqrt(square);
  }

  double
  CycleErrors::of_bulk() const
  {
    return std::sqrt(
      std::max(0.,
               std::pow(*numbers.estimate, 2) - std::pow(of_interfaces(), 2)));
  }

  NumbersByCell
  CycleErrors::by_cell(const bool of_quantity) const
  {
    NumbersByCell result;
    if (!numbers.estimate)
      return result;
    const auto part = [&](const double error) {
      return of_quantity ? error : std::sqrt(error);
    };
    const double factor = sum.all > 0. ? *numbers.estimate / part(sum.all) : 0.;
    for (const auto &of_body : states)
      {
        result.emplace_back();
        for (const CellState &state : of_body)
          result.back().push_back(factor * part(state.history.error));
      }
    return result;
  }
} // namespace mortise
