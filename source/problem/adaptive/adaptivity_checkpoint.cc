// What cycles leave in a checkpoint, and how they go on from it: meshes are
// made again, cell by cell, and have the histories of their cells.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/of_all_ranks.h>
#include <mortise/base/quotes.h>
#include <mortise/output/bytes.h>

#include <algorithm>
#include <set>

#include "kept_cycles.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using NumberedStates = std::vector<std::pair<CellNumber, CellState>>;

    /// Of all ranks, in an order that does not depend on them. Coefficients of
    /// the solution are in the checkpoint already. Collective.
    std::vector<KeptCell>
    gather(const Body &body, const std::vector<CellState> &states)
    {
      NumberedStates own;
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            own.emplace_back(cell->id().template to_binary<dim>(),
                             states[cell->active_cell_index()]);
            own.back().second.coefficients.clear();
          }
      NumberedStates result =
        of_all_ranks(own, body.triangulation().get_communicator());
      std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) {
        return a.first < b.first;
      });
      std::vector<KeptCell> cells;
      for (const auto &[number, state] : result)
        {
          const CellId id(number);
          const auto   children = id.get_child_indices();
          cells.push_back({id.get_coarse_cell_id(),
                           std::string(children.begin(), children.end()),
                           state});
        }
      return cells;
    }

    /// Cut the cells of @p body, hexahedra, until it has those of @p cells. Collective.
    void
    cut_into(const NumberedStates &cells, Body &body)
    {
      std::set<CellId> cut;
      for (const auto &[number, state] : cells)
        {
          const CellId              id(number);
          const auto                children = id.get_child_indices();
          std::vector<std::uint8_t> of_parent(children.begin(), children.end());
          while (!of_parent.empty())
            {
              of_parent.pop_back();
              cut.emplace(id.get_coarse_cell_id(), of_parent);
            }
        }
      unsigned int any = 1;
      while (any == 1)
        {
          std::vector<bool>      split;
          std::vector<CellState> states(body.triangulation().n_active_cells());
          for (const auto &cell : body.triangulation().active_cell_iterators())
            split.push_back(cell->is_locally_owned() &&
                            cut.count(cell->id()) > 0);
          any = std::find(split.begin(), split.end(), true) != split.end();
          any =
            Utilities::MPI::max(any, body.triangulation().get_communicator());
          if (any == 1)
            split_cells(body, split, states);
        }
    }
  } // namespace

  void
  Adaptivity::keep(const Bodies &bodies)
  {
    Kept result;
    result.quantity = goal ? goal->name() : "";
    result.cycle    = cycle;
    result.n_meshes = n_meshes;
    result.numbers  = {{"value", last_value},
                       {"change of rest", rest.change},
                       {"error of rest", rest.error},
                       {"allowed", allowed},
                       {"estimates", double(n_estimates)}};
    if (estimated)
      result.numbers.insert({{"estimate", *estimated}, {"at most", *at_most}});
    result.residual = residual;
    result.sizes.resize(bodies.size());
    for (const auto &body : bodies)
      {
        result.cells.push_back(gather(*body, states[body->index]));
        if (sizes.empty() || sizes[body->index] == nullptr)
          continue;
        for (const SizeField::Cell &cell : sizes[body->index]->all())
          {
            auto &numbers = result.sizes[body->index].emplace_back();
            for (unsigned int v = 0; v < 4; ++v)
              {
                std::copy_n(cell.vertices[v].begin_raw(), 3, &numbers[3 * v]);
                numbers[12 + v] = cell.sizes[v];
              }
          }
      }
    kept = to_bytes(std::move(result));
  }

  void
  Adaptivity::resume(const std::string &bytes)
  {
    const Kept given = kept_from(bytes, run.parameters.bodies);
    if (given.quantity != (goal ? goal->name() : ""))
      run.parameters.fail("Adaptivity/Quantity",
                          in_quotes(goal ? goal->name() : "") +
                            " with the checkpoint of a run with " +
                            in_quotes(given.quantity),
                          "the same, or a run from the beginning");
    const auto &numbers = given.numbers;
    cycle               = given.cycle;
    n_meshes            = given.n_meshes;
    last_value          = numbers.at("value");
    rest.change         = numbers.at("change of rest");
    rest.error          = numbers.at("error of rest");
    allowed             = numbers.at("allowed");
    residual            = given.residual;
    n_estimates         = static_cast<unsigned int>(numbers.at("estimates"));
    if (numbers.count("estimate") > 0)
      {
        estimated = numbers.at("estimate");
        at_most   = numbers.at("at most");
      }
    for (const auto &of_body : given.cells)
      {
        restored.emplace_back();
        for (const KeptCell &cell : of_body)
          restored.back().emplace_back(number_of(cell), cell.state);
      }
    for (const auto &of_body : given.sizes)
      {
        std::vector<SizeField::Cell> cells;
        for (const SizesOfCell &numbers : of_body)
          cells.push_back(size_cell(numbers));
        check_number(cells, given.cells[sizes.size()].size());
        sizes.push_back(cells.empty() ?
                          nullptr :
                          std::make_shared<const SizeField>(std::move(cells)));
      }
  }

  void
  Adaptivity::restore_meshes(Bodies &bodies)
  {
    std::string other;
    states.resize(bodies.size());
    for (const auto &body : bodies)
      {
        if (sizes[body->index] != nullptr)
          create_mesh(run, sizes[body->index], *body);
        else if (!body->mesh.tetrahedra)
          cut_into(restored[body->index], *body);
        const std::map<CellNumber, CellState> by_number(
          restored[body->index].begin(), restored[body->index].end());
        const auto &triangulation = body->triangulation();
        auto       &of_body       = states[body->index];
        of_body.assign(triangulation.n_active_cells(), {});
        splits.emplace_back(of_body.size(), false);
        for (const auto &cell : triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              const auto found =
                by_number.find(cell->id().template to_binary<dim>());
              if (found == by_number.end())
                other = body->name;
              else
                of_body[cell->active_cell_index()] = found->second;
            }
      }
    throw_if_any(other.empty() ? "" :
                                 "The checkpoint is of another scene: body " +
                                   in_quotes(other) +
                                   " has other cells; allowed: the meshes with "
                                   "which it was written",
                 run.comm);
    restored.clear();
  }

  void
  Adaptivity::restore(const Bodies                    &bodies,
                      const std::vector<BodySolution> &solutions)
  {
    set_coefficients(bodies, solutions, states);
    std::string other;
    for_each_cell(
      bodies, states, [&](const Body &body, const auto &, CellState &state) {
        const auto same = [](const auto &a, const auto &b) {
          return a.size() == b.size();
        };
        if (!state.dual.empty() && !std::equal(state.dual.begin(),
                                               state.dual.end(),
                                               state.coefficients.begin(),
                                               state.coefficients.end(),
                                               same))
          other = body.name;
      });
    throw_if_any(other.empty() ? "" :
                                 "The checkpoint is of another scene: body " +
                                   in_quotes(other) +
                                   " has a dual solution of other degrees; "
                                   "allowed: the degrees with which it was "
                                   "written",
                 run.comm);
    choose(bodies);
  }
} // namespace mortise
