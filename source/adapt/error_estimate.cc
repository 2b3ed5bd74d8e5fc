#include <deal.II/base/mpi.h>

#include <mortise/adapt/error_estimate.h>
#include <mortise/adapt/error_tail.h>
#include <mortise/adapt/smoothness.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of the squares of changes from degree to degree; corners have more, at
    /// degree three 0.2 (Fichera's).
    constexpr double fall_of_smooth = 0.1;

    /// Of those that tell that a tetrahedron, of which nothing else is known,
    /// is at a corner: there a quarter, an eighth beside it.
    constexpr double fall_at_corner = 0.2;

    /// The change of a cell by its own rise is at most so many times what its
    /// new modes have, which would be all of it if they were orthogonal to the
    /// others. Cells with a corner have up to four times as much, those beside
    /// something that is too coarse a hundred times.
    constexpr double largest_by_modes = 4.;

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
      // the pressure has another degree
      return legendre_decay(state.degree,
                            {state.coefficients.begin(),
                             state.coefficients.begin() + dim});
    }

    std::optional<bool>
    is_smooth(const CellHistory &history, const std::optional<double> &falls)
    {
      if (history.fall < fall_of_smooth)
        return true;
      return falls ? std::optional<bool>(mortise::is_smooth(*falls)) :
                     std::nullopt;
    }

    /// After the refinement that made the square @p change on a cell, and @p of_family in all on
    /// its siblings and it; coefficients fall by @p falls.
    ErrorTail
    tail(const CellHistory           &history,
         const std::optional<double> &falls,
         const double                 change,
         const double                 of_family)
    {
      const bool smooth = is_smooth(history, falls).value_or(false);
      if (history.is_split && smooth)
        return smooth_split_tail(history.degree);
      if (history.is_split)
        return geometric_tail(of_family,
                              history.change,
                              1,
                              std::pow(0.25, history.degree));
      if (smooth)
        return smooth_tail(change, history.change, falls.value_or(0.));
      if (history.n_rises == 1)
        return geometric_tail(change, history.change, 1, 0.);
      return power_tail(history.degree, change, history.change);
    }
  } // namespace

  std::optional<bool>
  is_smooth(const Body &body, const CellState &state)
  {
    if (body.mesh.tetrahedra && state.history.n_rises > 1 &&
        state.history.fall > fall_at_corner)
      return false;
    return is_smooth(state.history, decay(body, state));
  }

  namespace
  {
    /// The new @p history of a cell after a refinement that made the square @p change on it by its own.
    void
    learn_own(const Body                &body,
              const Body::CellIterator  &cell,
              const std::vector<double> &changes,
              const double               change,
              CellState                 &state)
    {
      CellHistory &history = state.history;
      ErrorTail    left;
      if (history.is_new && !history.is_split)
        {
          // from degree zero, which has no energy
          left         = geometric_tail(change,
                                history.change,
                                history.degree - 1,
                                history.least_ratio);
          history.fall = left.ratio;
        }
      else
        {
          if (history.n_rises > 1)
            history.fall = change / history.change;
          left = tail(history,
                      decay(body, state),
                      change,
                      history.is_split ? of_family(cell, changes) : 0.);
        }
      history.own_error = change * left.left;
      history.ratio     = left.ratio;
      history.change    = change;
      history.is_new    = false;
    }
  } // namespace

  NumbersByCell
  own_parts(const Bodies        &bodies,
            const NumbersByCell &changes,
            const CellStates    &states)
  {
    NumbersByCell result = energy_of_highest_modes(bodies, states);
    for_each_cell(
      bodies,
      states,
      [&](const Body &body, const auto &cell, const CellState &state) {
        const unsigned int k      = cell->active_cell_index();
        double            &part   = result[body.index][k];
        const double       change = changes[body.index][k];
        const double       most   = largest_by_modes * part;
        // halves have no modes that their whole had not
        part = state.history.is_split || !(most < change) ? 1. : most / change;
      });
    return result;
  }

  void
  estimate_errors(const Bodies        &bodies,
                  const NumbersByCell &changes,
                  const NumbersByCell &own_parts,
                  CellStates          &states)
  {
    double own[2] = {0., 0.}; // changes and errors of refined cells
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    CellHistory &history = state.history;
                    if (!history.is_refined)
                      return;
                    const unsigned int k       = cell->active_cell_index();
                    const auto        &of_body = changes[body.index];
                    const double       change =
                      (own_parts.empty() ? 1. : own_parts[body.index][k]) *
                      of_body[k];
                    learn_own(body, cell, of_body, change, state);
                    history.error = history.own_error;
                    own[0] += change;
                    own[1] += history.own_error;
                  });
    if (own_parts.empty())
      return;
    Utilities::MPI::sum(own,
                        bodies.front()->triangulation().get_communicator(),
                        own);
    const double left = own[0] > 0. ? own[1] / own[0] : 0.;
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    CellHistory       &history = state.history;
                    const unsigned int k       = cell->active_cell_index();
                    const double       by_others =
                      changes[body.index][k] -
                      (history.is_refined ? history.change : 0.);
                    history.error = history.own_error + left * by_others;
                  });
  }

  void
  set_shares(const Bodies        &bodies,
             const NumbersByCell &products,
             CellStates          &states)
  {
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    CellHistory &history = state.history;
                    if (history.is_refined)
                      history.share =
                        history.change > 0. ?
                          products[body.index][cell->active_cell_index()] /
                            history.change :
                          0.;
                  });
  }

  ErrorSums
  error_sums(const Bodies &bodies, const CellStates &states)
  {
    ErrorSums sums;
    sums.by_body.resize(bodies.size(), 0.);
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &, const CellState &state) {
                    const CellHistory &history = state.history;
                    const double       part    = history.share * history.error;
                    sums.by_body[body.index] += history.error;
                    sums.with_sign += history.n_rises == 0 ? part : 0.;
                    sums.by_lot += part * part;
                    sums.own += history.own_error;
                  });
    const MPI_Comm comm = bodies.front()->triangulation().get_communicator();
    Utilities::MPI::sum(sums.by_body, comm, sums.by_body);
    for (double *number : {&sums.with_sign, &sums.by_lot, &sums.own})
      *number = Utilities::MPI::sum(*number, comm);
    sums.all    = std::accumulate(sums.by_body.begin(), sums.by_body.end(), 0.);
    sums.by_lot = std::sqrt(sums.by_lot);
    return sums;
  }
} // namespace mortise
