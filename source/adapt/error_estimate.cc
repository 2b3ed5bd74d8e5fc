#include <deal.II/base/mpi.h>

#include <mortise/adapt/error_estimate.h>
#include <mortise/adapt/error_tail.h>
#include <mortise/adapt/smoothness.h>

#include <array>
#include <cmath>

namespace mortise
{
  namespace
  {
    /// Of the squares of changes from degree to degree; corners have more, at
    /// degree three 0.2 (Fichera's).
    constexpr double fall_of_smooth = 0.1;

    /// Of those that tell that a tetrahedron, of which nothing else is known,
    /// is at a corner: there a quarter, an eighth beside it.
    constexpr double fall_at_corner = 0.2;

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

  void
  estimate_errors(const Bodies        &bodies,
                  const NumbersByCell &changes,
                  CellStates          &states)
  {
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    CellHistory &history = state.history;
                    if (!history.is_refined)
                      return;
                    const auto  &of_body = changes[body.index];
                    const double change  = of_body[cell->active_cell_index()];
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
                        left =
                          tail(history,
                               decay(body, state),
                               change,
                               history.is_split ? of_family(cell, of_body) :
                                                  0.);
                      }
                    history.error  = change * left.left;
                    history.ratio  = left.ratio;
                    history.change = change;
                    history.is_new = false;
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
    std::array<double, 3> sums{{0., 0., 0.}};
    for_each_cell(bodies,
                  states,
                  [&](const Body &, const auto &, const CellState &state) {
                    const CellHistory &history = state.history;
                    const double       part    = history.share * history.error;
                    sums[0] += history.error;
                    sums[1] += history.n_rises == 0 ? part : 0.;
                    sums[2] += part * part;
                  });
    dealii::Utilities::MPI::sum(
      dealii::ArrayView<const double>(sums.data(), sums.size()),
      bodies.front()->triangulation().get_communicator(),
      dealii::ArrayView<double>(sums.data(), sums.size()));
    return {sums[0], sums[1], std::sqrt(sums[2])};
  }
} // namespace mortise
