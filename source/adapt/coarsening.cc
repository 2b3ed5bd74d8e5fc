#include <deal.II/base/mpi.h>

#include <mortise/adapt/cell_changes.h>
#include <mortise/adapt/coarsening.h>
#include <mortise/adapt/error_by_residual.h>
#include <mortise/adapt/error_estimate.h>
#include <mortise/adapt/largest_around.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// What coarser cells may add, beside the square of the error that is
    /// allowed: where a solution moves, cells are refined again, and meshes
    /// that are kept finer than that grow from step to step.
    constexpr double part_added = 4.;

    /// By which squares of errors grow where a degree is lowered, where a
    /// solution is smooth.
    constexpr double growth_by_degree = 20.;

    /// The same where eight cells of degree @p p become one.
    double
    growth_by_merging(const unsigned int p)
    {
      return std::pow(4., p);
    }

    /// What becomes of a cell: it is merged with its siblings, or gets the
    /// degree; then its part of the error is expected to have this square.
    struct Coarser
    {
      bool         merged = false;
      unsigned int degree = 0;
      double       error  = 0.;
    };

    class Choice
    {
    public:
      /// References must live on. Collective.
      Choice(const Bodies            &bodies,
             const CoarseningOptions &options,
             const CellStates        &states)
        : bodies(bodies)
        , options(options)
        , states(states)
      {
        for (const auto &body : bodies)
          levels_around.push_back(
            largest_around(body->triangulation(), [](const auto &cell) {
              return static_cast<unsigned int>(cell->level());
            }));
      }

      /// The largest error of a cell that becomes coarser, so that all add what
      /// they may of the square @p allowed. Collective.
      double
      largest_error_for(double allowed) const;

      /// With errors of at most @p most.
      Coarser
      coarser(const Body               &body,
              const Body::CellIterator &cell,
              double                    most) const;

    private:
      bool
      is_allowed(unsigned int body,
                 unsigned int level,
                 unsigned int degree) const;
      bool
      merge(const Body               &body,
            const Body::CellIterator &cell,
            double                    most,
            Coarser                  &result) const;

      const Bodies                          &bodies;
      const CoarseningOptions               &options;
      const CellStates                      &states;
      std::vector<std::vector<unsigned int>> levels_around;
    };

    /// May a cell become this?
    bool
    Choice::is_allowed(const unsigned int body,
                       const unsigned int level,
                       const unsigned int degree) const
    {
      const unsigned int first_level  = options.first_level[body],
                         first_degree = options.first_degree[body];
      return level >= first_level && degree >= first_degree &&
             (level > first_level || degree > first_degree);
    }

    /// Merge @p cell, a hexahedron, and its siblings if these are owned, not cut and no larger than cells around them, and one cell is
    /// to have no larger error than eight with @p most. Smaller cells around them may be merged, too, but whether those of
    /// other ranks are is not known.
    bool
    Choice::merge(const Body               &body,
                  const Body::CellIterator &cell,
                  const double              most,
                  Coarser                  &result) const
    {
      if (cell->level() == 0)
        return false;
      double       error  = 0.;
      unsigned int degree = 0;
      const auto   parent = cell->parent();
      for (unsigned int c = 0; c < parent->n_children(); ++c)
        {
          const auto child = parent->child(c);
          if (!child->is_active() || !child->is_locally_owned())
            return false;
          const unsigned int k = child->active_cell_index();
          if (levels_around[body.index][k] >
              static_cast<unsigned int>(cell->level()))
            return false;
          const CellState &state = states[body.index][k];
          error += largest_error(state.history);
          degree = std::max(degree, state.degree);
        }
      const double growth = growth_by_merging(degree);
      if (!is_allowed(body.index, parent->level(), degree) ||
          !(error * growth < parent->n_children() * most))
        return false;
      result.merged = true;
      result.error *= growth;
      return true;
    }

    Coarser
    Choice::coarser(const Body               &body,
                    const Body::CellIterator &cell,
                    const double              most) const
    {
      const CellState &state = states[body.index][cell->active_cell_index()];
      Coarser result{false, state.degree, largest_error(state.history)};
      if (!body.mesh.tetrahedra && merge(body, cell, most, result))
        return result;
      const auto may_fall = [&] {
        return is_allowed(body.index, cell->level(), result.degree - 1);
      };
      if (options.forgets && may_fall())
        --result.degree;
      for (; may_fall() && growth_by_degree * result.error < most;
           result.error *= growth_by_degree)
        --result.degree;
      return result;
    }

    double
    Choice::largest_error_for(const double allowed) const
    {
      const auto added_by = [&](const double most) {
        double added = 0.;
        for_each_cell(
          bodies,
          states,
          [&](const Body &body, const auto &cell, const CellState &state) {
            added +=
              coarser(body, cell, most).error - largest_error(state.history);
          });
        return Utilities::MPI::sum(
          added, bodies.front()->triangulation().get_communicator());
      };
      constexpr double smallest = 1e-9; // beside it nothing is worth a change
      double           most     = part_added * allowed;
      while (most > smallest * allowed &&
             !(added_by(most) < part_added * allowed))
        most *= 0.5;
      return most;
    }
  } // namespace

  std::vector<std::vector<bool>>
  coarsen(const Bodies            &bodies,
          const CoarseningOptions &options,
          const double             allowed,
          CellStates              &states)
  {
    const Choice                      choice(bodies, options, states);
    const double                      most = choice.largest_error_for(allowed);
    std::vector<std::vector<Coarser>> chosen;
    std::vector<std::vector<bool>>    merges;
    for (const auto &of_body : states)
      {
        chosen.emplace_back(of_body.size());
        merges.emplace_back(of_body.size(), false);
      }
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &) {
                    const unsigned int k  = cell->active_cell_index();
                    chosen[body.index][k] = choice.coarser(body, cell, most);
                    merges[body.index][k] = chosen[body.index][k].merged;
                  });
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    lower(cell->reference_cell(),
                          chosen[body.index][cell->active_cell_index()].degree,
                          state);
                    CellHistory &history = state.history;
                    if (options.forgets)
                      {
                        history        = {};
                        history.degree = state.degree;
                      }
                    history.is_refined = history.is_split = false;
                    // what the last step has shown may be chance
                    history.by_residual = std::max(history.by_residual,
                                                   square_by_residual_at_first);
                  });
    return merges;
  }
} // namespace mortise
