#include <deal.II/base/mpi.h>

#include <mortise/adapt/error_estimate.h>
#include <mortise/adapt/largest_around.h>
#include <mortise/adapt/refinement.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of the square of the error that is allowed, what the next cycle is to
    /// have: what it will have is not known well.
    constexpr double aim = 0.5;

    /// Assumed factor of the square of an error after a split beside corners
    /// and edges, and its lower bound after a rise.
    constexpr double after_split = 0.5, after_rise = 0.02;

    MPI_Comm
    communicator(const Bodies &bodies)
    {
      return bodies.front()->triangulation().get_communicator();
    }

    Refinement
    best(const Body               &body,
         const Body::CellIterator &cell,
         const CellState          &state,
         const RefinementOptions  &options)
    {
      const bool hexahedron = !body.mesh.tetrahedra;
      const bool can_split =
        hexahedron ? options.may_split : options.may_remesh[body.index];
      const bool can_rise = state.degree < options.largest_degree;
      if (can_split && ((hexahedron && options.only_splits) || !can_rise ||
                        !is_smooth(body, cell, state).value_or(true)))
        return Refinement::split;
      return can_rise ? Refinement::rise : Refinement::keep;
    }

    /// The square above which errors of cells call for @p best to be done.
    double
    threshold(const Bodies      &bodies,
              const CellStates  &states,
              const Refinements &best,
              const double       allowed)
    {
      const MPI_Comm comm    = communicator(bodies);
      double         n_cells = 0., largest = 0.;
      for (const auto &body : bodies)
        n_cells += body->triangulation().n_global_active_cells();
      for_each_cell(bodies,
                    states,
                    [&](const Body &, const auto &, const CellState &state) {
                      largest = std::max(largest, largest_error(state.history));
                    });
      largest                 = Utilities::MPI::max(largest, comm);
      const auto left_by_next = [&](const double least) {
        double left = 0.;
        for_each_cell(
          bodies,
          states,
          [&](const Body &body, const auto &cell, const CellState &state) {
            const Refinement choice =
              best[body.index][cell->active_cell_index()];
            const CellHistory &history = state.history;
            const double       ratio   = choice == Refinement::rise ?
                                           std::max(after_rise, history.ratio) :
                                           after_split;
            left +=
              largest_error(history) *
              (choice != Refinement::keep && largest_error(history) > least ?
                 ratio :
                 1.);
          });
        return Utilities::MPI::sum(left, comm);
      };
      // what is small beside others waits: they show through in it
      double least = fraction_of_cell *
                     std::max(allowed, left_by_next(largest)) / n_cells,
             most = largest;
      if (!(left_by_next(least) < aim * allowed))
        return least;
      while (most > 1.1 * least)
        {
          const double middle = std::sqrt(least * most);
          (left_by_next(middle) < aim * allowed ? least : most) = middle;
        }
      return least;
    }

    /// Where cells rise, those around with less rise by one: what a cell has
    /// alone on a face it cannot use.
    void
    raise_around(const Bodies     &bodies,
                 const CellStates &states,
                 Refinements      &refinements)
    {
      for (const auto &body : bodies)
        {
          const auto &of_body = states[body->index];
          auto       &chosen  = refinements[body->index];
          const auto  wanted =
            largest_around(body->triangulation(), [&](const auto &cell) {
              const unsigned int k = cell->active_cell_index();
              return chosen[k] == Refinement::rise ?
                       of_body[k].history.degree + 1 :
                       0;
            });
          for (unsigned int k = 0; k < chosen.size(); ++k)
            if (chosen[k] == Refinement::keep &&
                wanted[k] > of_body[k].history.degree)
              chosen[k] = Refinement::rise;
        }
    }
  } // namespace

  namespace
  {
    /// The best on cells of which @p which holds; others are kept.
    template <typename Which>
    Refinements
    refine_where(const Bodies            &bodies,
                 const CellStates        &states,
                 const RefinementOptions &options,
                 const Which             &which)
    {
      Refinements result;
      for (const auto &of_body : states)
        result.emplace_back(of_body.size(), Refinement::keep);
      for_each_cell(bodies,
                    states,
                    [&](const Body      &body,
                        const auto      &cell,
                        const CellState &state) {
                      if (which(state.history))
                        result[body.index][cell->active_cell_index()] =
                          best(body, cell, state, options);
                    });
      return result;
    }

    /// A new mesh costs what is known of the old one: let tetrahedra rise
    /// unless those that were to be split have most of the error of all.
    /// Collective.
    void
    split_few_tetrahedra(const Bodies     &bodies,
                         const CellStates &states,
                         RefinementOptions options,
                         Refinements      &refinements)
    {
      double error[2] = {0., 0.}; // of those, of all tetrahedra
      for_each_cell(
        bodies,
        states,
        [&](const Body &body, const auto &cell, const CellState &state) {
          if (!body.mesh.tetrahedra)
            return;
          const double certain = certain_error(state.history);
          error[0] += refinements[body.index][cell->active_cell_index()] ==
                          Refinement::split ?
                        certain :
                        0.;
          error[1] += certain;
        });
      Utilities::MPI::sum(error, communicator(bodies), error);
      if (error[0] > 0.5 * error[1])
        return;
      options.may_remesh.assign(bodies.size(), false);
      for_each_cell(bodies,
                    states,
                    [&](const Body      &body,
                        const auto      &cell,
                        const CellState &state) {
                      Refinement &choice =
                        refinements[body.index][cell->active_cell_index()];
                      if (body.mesh.tetrahedra && choice == Refinement::split)
                        choice = best(body, cell, state, options);
                    });
    }
  } // namespace

  Refinements
  refine_new(const Bodies            &bodies,
             const CellStates        &states,
             const RefinementOptions &options)
  {
    return refine_where(bodies, states, options, [](const auto &history) {
      return history.is_new;
    });
  }

  Refinements
  choose_refinements(const Bodies            &bodies,
                     const CellStates        &states,
                     const RefinementOptions &options,
                     const double             allowed)
  {
    const auto   all   = [](const CellHistory &) { return true; };
    const double least = threshold(bodies,
                                   states,
                                   refine_where(bodies, states, options, all),
                                   allowed);
    Refinements  result =
      refine_where(bodies, states, options, [&](const auto &history) {
        return largest_error(history) > least;
      });
    split_few_tetrahedra(bodies, states, options, result);
    raise_around(bodies, states, result);
    return result;
  }

  Refinements
  with_closure(const Bodies &bodies, Refinements refinements)
  {
    for (const auto &body : bodies)
      if (!body->mesh.tetrahedra)
        {
          const auto  &triangulation = body->triangulation();
          auto        &chosen        = refinements[body->index];
          unsigned int more;
          do
            {
              const auto halvings =
                largest_around(triangulation, [&](const auto &cell) {
                  return cell->level() + (chosen[cell->active_cell_index()] ==
                                          Refinement::split);
                });
              more = 0;
              for (const auto &cell : triangulation.active_cell_iterators())
                if (const unsigned int k = cell->active_cell_index();
                    cell->is_locally_owned() &&
                    chosen[k] != Refinement::split &&
                    int(halvings[k]) > cell->level() + 1)
                  {
                    chosen[k] = Refinement::split;
                    more      = 1;
                  }
            }
          while (Utilities::MPI::max(more, communicator(bodies)) > 0);
        }
    return refinements;
  }

  double
  growth(const Bodies      &bodies,
         const CellStates  &states,
         const Refinements &refinements)
  {
    double size[2] = {0., 0.}; // about, without the sharing of nodes
    for_each_cell(
      bodies,
      states,
      [&](const Body &body, const auto &cell, const CellState &state) {
        const unsigned int p = state.history.degree;
        const Refinement   choice =
          refinements[body.index][cell->active_cell_index()];
        size[0] += std::pow(p, 3);
        size[1] += choice == Refinement::split ? 8. * std::pow(p, 3) :
                   choice == Refinement::rise  ? std::pow(p + 1., 3) :
                                                 std::pow(p, 3);
      });
    Utilities::MPI::sum(size, communicator(bodies), size);
    return size[1] / size[0];
  }

  std::vector<std::vector<bool>>
  prepare_refinement(const Bodies      &bodies,
                     const Refinements &refinements,
                     CellStates        &states)
  {
    std::vector<std::vector<bool>> splits;
    for (const auto &of_body : refinements)
      {
        splits.emplace_back();
        for (const Refinement refinement : of_body)
          splits.back().push_back(refinement == Refinement::split);
      }
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    const bool rises =
                      refinements[body.index][cell->active_cell_index()] ==
                      Refinement::rise;
                    state.history.is_refined = rises;
                    state.history.is_split   = false;
                    state.history.degree += rises ? 1 : 0;
                    state.history.n_rises += rises ? 1 : 0;
                  });
    return splits;
  }
} // namespace mortise
