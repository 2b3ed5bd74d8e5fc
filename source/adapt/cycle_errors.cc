#include <deal.II/base/mpi.h>

#include <mortise/adapt/cycle_errors.h>
#include <mortise/adapt/error_tail.h>
#include <mortise/operators/cells/cell_histories.h>

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

    /// Of a quantity: by which an estimate may be too small after one
    /// refinement, which does not show how changes fall.
    constexpr double uncertainty_of_one_change = 10.;

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
  CycleErrors::start(const Bodies &bodies, const bool go_on)
  {
    if (go_on)
      earlier = embedded(bodies, cells);
    return earlier;
  }

  const std::vector<BodySolution> &
  CycleErrors::dual_start(const Bodies &bodies, const bool go_on)
  {
    if (go_on)
      earlier_dual = embedded(bodies, cells, &CellState::dual);
    return earlier_dual;
  }

  void
  CycleErrors::add(const Bodies                      &bodies,
                   const std::vector<BodySolution>   &solutions,
                   const std::optional<DualSolution> &dual,
                   std::vector<InterfaceResidual>     broken,
                   const Residuals                   &residuals)
  {
    of_quantity        = dual.has_value();
    NumbersByCell size = energy_by_cell(bodies, solutions);
    set_coefficients(bodies, solutions, cells);
    if (dual)
      {
        size =
          geometric_mean(std::move(size),
                         energy_of_changes(bodies, solutions, dual->solutions));
        set_coefficients(bodies, dual->solutions, cells, &CellState::dual);
      }
    const double norm =
      dual ? std::fabs(dual->value) : std::sqrt(total(size, comm));
    for_each_cell(bodies,
                  cells,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    CellHistory &history = state.history;
                    history.degree       = state.degree;
                    if (history.is_new && !history.is_refined)
                      history.change = history.error =
                        size[body.index][cell->active_cell_index()];
                  });
    interface_residuals = std::move(broken);
    set_interface_residuals(norm);
    for (const auto &[body, cell] : residuals.at_plastic_front)
      cells[body][cell].history.at_free_boundary = true;
    quantity_is_zero = dual && memory.n_cycles > 0 &&
                       std::fabs(dual->value) <= accuracy * dual->size;
    if (quantity_is_zero || has_unknown_errors(bodies, cells))
      forget_estimate();
    else
      estimate(bodies, solutions, dual, residuals, norm);
    earlier.clear();
    earlier_dual.clear();
    memory.residual = sums_by_body(residuals.equations, comm);
    if (dual)
      memory.value = dual->value;
    ++memory.n_cycles;
    // of cells as of all
    const double of_all  = dual ?
                             memory.estimate.value_or(0.) :
                             std::pow(memory.upper_estimate.value_or(0.), 2);
    memory.allowed_error = of_all > 0. ? sums.largest / of_all : 0.;
  }

  void
  CycleErrors::begin_step()
  {
    memory = {};
    sums   = {};
    interface_residuals.clear();
    correction.reset();
    quantity_is_zero = false;
  }

  void
  CycleErrors::forget_estimate()
  {
    sums                  = {};
    memory.change_of_rest = memory.error_of_rest = 0.;
    memory.estimate.reset();
    memory.upper_estimate.reset();
    correction.reset();
    memory.n_estimates = 0;
  }

  void
  CycleErrors::set_interface_residuals(const double norm)
  {
    for (auto &of_body : cells)
      for (CellState &state : of_body)
        {
          state.history.violation        = 0.;
          state.history.at_free_boundary = false;
        }
    for (InterfaceResidual &of : interface_residuals)
      {
        of.size       = norm > 0. ? of.size / norm : 0.;
        auto &of_body = cells[of.body];
        for (unsigned int k = 0; k < of_body.size(); ++k)
          of_body[k].history.violation += of.of_cells[k];
        for (const auto &[body, cell] : of.at_contact_edge)
          cells[body][cell].history.at_free_boundary = true;
      }
  }

  void
  CycleErrors::estimate(const Bodies                      &bodies,
                        const std::vector<BodySolution>   &solutions,
                        const std::optional<DualSolution> &dual,
                        const Residuals                   &residuals,
                        const double                       norm)
  {
    // the first cycle of a step has no change of its own
    const NumbersByCell energy_changes =
      memory.n_cycles > 0 ? update_history(bodies, solutions, dual) :
                            NumbersByCell(bodies.size());
    const std::vector<double> changes = sums_by_body(energy_changes, comm);
    const double              unit    = norm > 0. ? norm : 1.;
    ++memory.n_estimates;
    const std::vector<double> now = sums_by_body(residuals.equations, comm);
    learn_residuals(bodies,
                    squares_by_residual(changes,
                                        memory.n_cycles > 0 ? memory.residual :
                                                              now,
                                        now),
                    cells);
    if (dual)
      {
        raise_errors(bodies, residuals, energy_changes, cells);
        sums = error_sums(bodies, cells);
        memory.estimate =
          std::hypot(sums.of_quantity(), memory.error_of_rest) / unit;
        memory.upper_estimate =
          *memory.estimate *
          (memory.n_estimates > 1 ? 1. : uncertainty_of_one_change);
        correction = sums.correction + memory.error_of_rest;
        return;
      }
    set_errors(bodies, residuals, cells);
    sums                    = error_sums(bodies, cells);
    const double conditions = total(residuals.conditions, comm),
                 for_sure   = conditions + std::pow(unit * of_interfaces(), 2),
                 by_equations = sums.all - conditions;
    memory.estimate           = std::sqrt(for_sure + by_equations) / unit;
    // where displacements are prescribed the exact solution has less energy
    // than this one, by the square of the error
    constexpr double least_part = 0.01;
    const double     most =
      for_sure + std::pow(upper_factor(memory.n_estimates), 2) * by_equations;
    memory.upper_estimate =
      std::sqrt(most / std::max(unit * unit - most, least_part * unit * unit));
    // near a collapse small forces make large plastic strains
    constexpr double part_of_change = 1.;
    double           of_plastic     = 0.;
    for (const auto &body : bodies)
      if (has_history(*body))
        of_plastic += changes[body->index];
    memory.upper_estimate =
      std::max(*memory.upper_estimate,
               part_of_change * std::sqrt(of_plastic) / unit);
  }

  NumbersByCell
  CycleErrors::update_history(const Bodies                      &bodies,
                              const std::vector<BodySolution>   &solutions,
                              const std::optional<DualSolution> &dual)
  {
    subtract(earlier, solutions);
    const NumbersByCell energies =
      energy_of_changes(bodies, solutions, earlier);
    NumbersByCell changes = energies, own;
    if (dual)
      {
        subtract(earlier_dual, dual->solutions);
        changes =
          geometric_mean(std::move(changes),
                         energy_of_changes(bodies, solutions, earlier_dual));
      }
    else
      own = own_parts(bodies, changes, cells);
    estimate_errors(bodies, changes, own, cells);
    if (dual)
      {
        const auto products =
          products_by_cell(bodies, solutions, earlier, earlier_dual);
        set_shares(bodies, products, cells);
        // the first change is that from nothing
        const double before =
          memory.change_of_rest == 0. ? memory.value : memory.change_of_rest;
        memory.change_of_rest =
          dual->value - memory.value - total(products, comm);
        memory.error_of_rest = memory.change_of_rest *
                               geometric_tail(std::fabs(memory.change_of_rest),
                                              std::fabs(before),
                                              1,
                                              least_ratio_of_rest)
                                 .left;
      }
    return energies;
  }

  NumbersByCell
  CycleErrors::by_cell() const
  {
    NumbersByCell result;
    if (!memory.estimate)
      return result;
    const auto part = [&](const double error) {
      return of_quantity ? error : std::sqrt(error);
    };
    const double factor =
      sums.all > 0. ? *memory.estimate / part(sums.all) : 0.;
    for (const auto &of_body : cells)
      {
        result.emplace_back();
        for (const CellState &state : of_body)
          result.back().push_back(
            factor * part(state.history.raised * state.history.error));
      }
    return result;
  }
} // namespace mortise
