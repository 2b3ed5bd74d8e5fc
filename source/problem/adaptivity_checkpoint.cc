// What cycles leave in a checkpoint, and how they go on from it: meshes are
// made again, cell by cell, and have the histories of their cells.
#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/adaptivity.h>

#include <algorithm>
#include <map>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using NumberedStates = std::vector<std::pair<CellNumber, CellState>>;

    /// As text of Adaptivity::checkpoint().
    struct Kept
    {
      std::string                   quantity; ///< empty: the energy norm
      unsigned int                  cycle = 0, n_meshes = 0;
      std::map<std::string, double> numbers; ///< those that there are
      std::vector<NumberedStates>   cells;   ///< by body
      /// By body and cell of SizeField: coordinates of vertices, then sizes.
      std::vector<std::vector<std::array<double, 16>>> sizes;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &quantity &cycle &n_meshes &numbers &cells &sizes;
      }
    };

    /// Of all ranks, in an order that does not depend on them. Coefficients of
    /// the solution are in the checkpoint already. Collective.
    NumberedStates
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
      NumberedStates result;
      for (const auto &of_rank :
           Utilities::MPI::all_gather(body.triangulation().get_communicator(),
                                      own))
        result.insert(result.end(), of_rank.begin(), of_rank.end());
      std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) {
        return a.first < b.first;
      });
      return result;
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
                       {"residual", residual}};
    if (estimated)
      result.numbers.insert({{"estimate", *estimated}, {"at most", *at_most}});
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
    const auto bytes = Utilities::pack(result, true);
    kept             = Utilities::encode_base64({bytes.begin(), bytes.end()});
  }

  void
  Adaptivity::resume(const std::string &text)
  {
    const auto bytes = Utilities::decode_base64(text);
    const Kept given =
      Utilities::unpack<Kept>(std::vector<char>(bytes.begin(), bytes.end()),
                              true);
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
    residual            = numbers.at("residual");
    if (numbers.count("estimate") > 0)
      {
        estimated = numbers.at("estimate");
        at_most   = numbers.at("at most");
      }
    restored = given.cells;
    for (const auto &of_body : given.sizes)
      {
        std::vector<SizeField::Cell> cells;
        for (const auto &numbers : of_body)
          {
            auto &cell = cells.emplace_back();
            for (unsigned int v = 0; v < 4; ++v)
              {
                std::copy_n(&numbers[3 * v], 3, cell.vertices[v].begin_raw());
                cell.sizes[v] = numbers[12 + v];
              }
          }
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
    choose(bodies);
  }
} // namespace mortise
