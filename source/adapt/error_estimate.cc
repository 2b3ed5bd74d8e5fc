#include <deal.II/base/mpi.h>

#include <mortise/adapt/error_estimate.h>
#include <mortise/adapt/error_tail.h>
#include <mortise/adapt/smoothness.h>

#include <algorithm>
#include <cmath>
#include <map>
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

    /// Nothing of tetrahedra and of low degrees.
    std::optional<double>
    decay(const Body               &body,
          const Body::CellIterator &cell,
          const CellState          &state)
    {
      if (body.mesh.tetrahedra || state.degree < least_degree_of_decay)
        return {};
      const auto &given = state.coefficients;
      return legendre_decay(state.degree,
                            {given.begin(), given.begin() + dim},
                            body.pressure ? given[dim] : std::vector<double>(),
                            std::cbrt(cell->measure()) /
                              body.material.modulus());
    }

    std::optional<bool>
    is_smooth(const CellHistory &history, const std::optional<double> &falls)
    {
      if (history.fall < fall_of_smooth)
        return true;
      return falls ? std::optional<bool>(mortise::is_smooth(*falls)) :
                     std::nullopt;
    }
  } // namespace

  std::optional<bool>
  is_smooth(const Body               &body,
            const Body::CellIterator &cell,
            const CellState          &state)
  {
    if (state.history.at_free_boundary && !state.history.is_new &&
        state.degree >= least_degree_of_decay)
      return false;
    if (body.mesh.tetrahedra && state.history.n_rises > 1 &&
        state.history.fall > fall_at_corner)
      return false;
    return is_smooth(state.history, decay(body, cell, state));
  }

  namespace
  {
    void
    update_history(const double     change,
                   const ErrorTail &left,
                   CellHistory     &history)
    {
      history.error  = change * left.left;
      history.ratio  = left.ratio;
      history.change = change;
      history.is_new = false;
    }

    /// Of a cell that was cut.
    struct FamilyChange
    {
      double own  = 0.;
      double all  = 0.; ///< of its siblings and it
      double part = 0.; ///< of that, what goes on in it
    };

    /// @p cell is on one rank with its siblings; as much as has not been cut further stands for them all. What is
    /// at an edge or a corner makes changes around it, too, which do not go on
    /// there: all goes on in those siblings whose coefficients fall about as
    /// slowly as the slowest do.
    FamilyChange
    of_family(const Body                   &body,
              const Body::CellIterator     &cell,
              const std::vector<CellState> &states,
              const std::vector<double>    &changes)
    {
      constexpr double               about  = 0.7;
      const auto                     parent = cell->parent();
      std::map<unsigned int, double> falls; // by active cell
      double                         slowest = 0., all = 0., rough = 0.;
      for (unsigned int c = 0; c < parent->n_children(); ++c)
        if (parent->child(c)->is_active())
          {
            const Body::CellIterator child = parent->child(c);
            const unsigned int       k     = child->active_cell_index();
            falls[k] = decay(body, child, states[k]).value_or(1.);
            slowest  = std::max(slowest, falls[k]);
          }
      for (const auto &[k, fall] : falls)
        {
          all += changes[k];
          rough += fall >= about * slowest ? changes[k] : 0.;
        }
      const unsigned int k = cell->active_cell_index();
      return {changes[k],
              all * parent->n_children() / falls.size(),
              falls[k] >= about * slowest && rough > 0. ?
                changes[k] * all / rough :
                changes[k]};
    }

    /// After the last of several rises in degree, by which the square of the solution changed by @p change.
    ErrorTail
    tail_of_rises(const CellHistory           &history,
                  const std::optional<double> &falls,
                  const double                 change)
    {
      if (is_smooth(history, falls).value_or(false))
        return smooth_tail(change, history.change, falls.value_or(0.));
      if (history.n_rises == 1)
        return geometric_tail(change, history.change, 1, 0.);
      return power_tail(history.degree, change, history.change);
    }

    /// The new history of a cell with @p state after its degree has risen, which changed the solution by @p change.
    void
    learn_rise(const Body               &body,
               const Body::CellIterator &cell,
               const double              change,
               CellState                &state)
    {
      CellHistory &history = state.history;
      if (!history.is_new)
        {
          if (history.n_rises > 1)
            history.fall = change / history.change;
          update_history(change,
                         tail_of_rises(history,
                                       decay(body, cell, state),
                                       change),
                         history);
          return;
        }
      // from degree zero, which has no energy
      const ErrorTail left = geometric_tail(change,
                                            history.change,
                                            history.degree - 1,
                                            history.least_ratio);
      history.fall         = left.ratio;
      update_history(change, left, history);
    }

    /// The same after it was cut.
    void
    learn_split(const Body               &body,
                const Body::CellIterator &cell,
                const FamilyChange       &change,
                CellState                &state)
    {
      CellHistory       &history = state.history;
      const unsigned int p       = history.degree;
      if (is_smooth(body, cell, state).value_or(false))
        update_history(change.own, smooth_split_tail(p), history);
      else
        update_history(
          change.part,
          geometric_tail(change.all, history.change, 1, std::pow(0.25, p)),
          history);
    }
  } // namespace

  NumbersByCell
  own_parts(const Bodies        &bodies,
            const NumbersByCell &changes,
            const CellStates    &states)
  {
    NumbersByCell result = energy_of_new_modes(bodies, states);
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
    for_each_cell(
      bodies,
      states,
      [&](const Body &body, const auto &cell, CellState &state) {
        CellHistory &history = state.history;
        if (!history.is_refined)
          return;
        const unsigned int k       = cell->active_cell_index();
        const auto        &of_body = changes[body.index];
        if (history.is_split)
          learn_split(body,
                      cell,
                      of_family(body, cell, states[body.index], of_body),
                      state);
        else
          learn_rise(body,
                     cell,
                     (own_parts.empty() ? 1. : own_parts[body.index][k]) *
                       of_body[k],
                     state);
      });
  }

  void
  learn_residuals(const Bodies              &bodies,
                  const std::vector<double> &seen,
                  CellStates                &states)
  {
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &, CellState &state) {
                    CellHistory &history = state.history;
                    // what one cycle has shown may be chance
                    if (history.is_refined)
                      history.by_residual =
                        std::max(seen[body.index],
                                 kept_of_earlier_cycles * history.by_residual);
                  });
  }

  namespace
  {
    double
    error_by_residual(const CellHistory &history,
                      const Residuals   &residuals,
                      const unsigned int body,
                      const unsigned int cell)
    {
      return history.by_residual * residuals.equations[body][cell] +
             residuals.conditions[body][cell];
    }
  } // namespace

  void
  set_errors(const Bodies    &bodies,
             const Residuals &residuals,
             CellStates      &states)
  {
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    state.history.error =
                      error_by_residual(state.history,
                                        residuals,
                                        body.index,
                                        cell->active_cell_index());
                  });
  }

  void
  raise_errors(const Bodies        &bodies,
               const Residuals     &residuals,
               const NumbersByCell &changes,
               CellStates          &states)
  {
    std::vector<double> by_residual(bodies.size(), 0.),
      by_changes(bodies.size(), 0.);
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    const CellHistory &history = state.history;
                    const unsigned int k       = cell->active_cell_index();
                    if (!history.is_refined || !(history.change > 0.))
                      return;
                    by_residual[body.index] +=
                      error_by_residual(history, residuals, body.index, k);
                    by_changes[body.index] +=
                      changes[body.index][k] * history.error / history.change;
                  });
    const MPI_Comm comm = bodies.front()->triangulation().get_communicator();
    for (auto *sums : {&by_residual, &by_changes})
      Utilities::MPI::sum(*sums, comm, *sums);
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &, CellState &state) {
                    const unsigned int b = body.index;
                    if (state.history.is_refined)
                      state.history.raised =
                        by_changes[b] > 0. ?
                          std::max(1., by_residual[b] / by_changes[b]) :
                          1.;
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
    double contributions[3] = {0., 0., 0.}; // with sign, without, left
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &, const CellState &state) {
                    const CellHistory &history = state.history;
                    const double       error   = history.raised * history.error;
                    const double       part    = history.share * error;
                    sums.by_body[body.index] += error;
                    if (history.n_rises == 0)
                      {
                        sums.with_sign += part;
                        sums.correction += history.share * history.error;
                      }
                    if (history.n_rises > 0)
                      {
                        const double change = history.share * history.change;
                        contributions[0] += change;
                        contributions[1] += std::fabs(change);
                        contributions[2] += std::fabs(part);
                      }
                    sums.by_lot += part * part;
                    sums.largest += largest_error(history);
                  });
    const MPI_Comm comm = bodies.front()->triangulation().get_communicator();
    Utilities::MPI::sum(sums.by_body, comm, sums.by_body);
    for (double *number :
         {&sums.with_sign, &sums.correction, &sums.by_lot, &sums.largest})
      *number = Utilities::MPI::sum(*number, comm);
    sums.all    = std::accumulate(sums.by_body.begin(), sums.by_body.end(), 0.);
    sums.by_lot = std::sqrt(sums.by_lot);
    Utilities::MPI::sum(contributions, comm, contributions);
    if (contributions[1] > 0.)
      sums.like_before =
        std::fabs(contributions[0]) / contributions[1] * contributions[2];
    return sums;
  }
} // namespace mortise
