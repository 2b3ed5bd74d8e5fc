// Checkpoints of adaptive cycles: meshes are made again, cell by cell, with the
// histories of their cells.
#include <deal.II/base/mpi.h>

#include <mortise/adapt/cell_changes.h>
#include <mortise/base/error.h>
#include <mortise/base/of_all_ranks.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/adaptive/adaptivity.h>

#include <algorithm>
#include <map>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using NumberedStates = std::vector<std::pair<CellNumber, CellState>>;

    /// Of all ranks, in an order that does not depend on them. Coefficients of
    /// the solution are in the checkpoint already. Collective.
    std::vector<CellCheckpoint>
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
      std::vector<CellCheckpoint> cells;
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
            change_cells(body, split, std::vector<bool>(split.size()), states);
        }
    }
  } // namespace

  void
  Adaptivity::keep(const Bodies &bodies)
  {
    kept = {goal ? goal->name : "", n_meshes, of_cycle.memory, {}, {}};
    kept.sizes.resize(bodies.size());
    for (const auto &body : bodies)
      {
        kept.cells.push_back(gather(*body, of_cycle.cells[body->index]));
        if (sizes.empty() || sizes[body->index] == nullptr)
          continue;
        for (const SizeField::Cell &cell : sizes[body->index]->all())
          {
            auto &numbers = kept.sizes[body->index].emplace_back();
            for (unsigned int v = 0; v < 4; ++v)
              {
                std::copy_n(cell.vertices[v].begin_raw(), 3, &numbers[3 * v]);
                numbers[12 + v] = cell.sizes[v];
              }
          }
      }
  }

  void
  Adaptivity::resume(CycleCheckpoint given)
  {
    check(given, run.parameters.bodies);
    const std::string name = goal ? goal->name : "";
    if (given.quantity != name)
      run.parameters.fail("Adaptivity/Quantity",
                          in_quotes(name) +
                            " with the checkpoint of a run with " +
                            in_quotes(given.quantity),
                          "the same, or a run from the beginning");
    n_meshes        = given.n_meshes;
    of_cycle.memory = given.memory;
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
    kept = std::move(given);
  }

  void
  Adaptivity::restore_meshes(Bodies &bodies)
  {
    std::string other;
    CellStates  states(bodies.size());
    for (const auto &body : bodies)
      {
        NumberedStates of_kept;
        for (const CellCheckpoint &cell : kept.cells[body->index])
          of_kept.emplace_back(number_of(cell), cell.state);
        if (sizes[body->index] != nullptr)
          create_mesh(run, sizes[body->index], *body);
        else if (!body->mesh.tetrahedra)
          cut_into(of_kept, *body);
        const std::map<CellNumber, CellState> by_number(of_kept.begin(),
                                                        of_kept.end());
        const auto &triangulation = body->triangulation();
        auto       &of_body       = states[body->index];
        of_body.assign(triangulation.n_active_cells(), {});
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
    of_cycle.cells = std::move(states);
  }

  void
  Adaptivity::restore(const Bodies                    &bodies,
                      const std::vector<BodySolution> &solutions)
  {
    set_coefficients(bodies, solutions, of_cycle.cells);
    std::string other;
    for_each_cell(bodies,
                  of_cycle.cells,
                  [&](const Body &body, const auto &, CellState &state) {
                    const auto same = [](const auto &a, const auto &b) {
                      return a.size() == b.size();
                    };
                    if (!state.dual.empty() &&
                        !std::equal(state.dual.begin(),
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
    plan(bodies);
  }
} // namespace mortise
