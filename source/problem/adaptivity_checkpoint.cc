// What cycles leave in a checkpoint, and how they go on from it: meshes are
// made again, cell by cell, and have the histories of their cells.
#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/gmsh_model.h>
#include <mortise/output/bytes.h>
#include <mortise/problem/adaptivity.h>
#include <mortise/problem/formulation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using NumberedStates = std::vector<std::pair<CellNumber, CellState>>;

    struct KeptCell
    {
      std::uint64_t coarse = 0;
      std::string   children; ///< which child from level to level, as bytes
      CellState     state;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &coarse &children &state;
      }
    };

    /// Coordinates of the vertices of a cell of SizeField, then sizes there.
    using SizesOfCell = std::array<double, 16>;

    /// As text of Adaptivity::checkpoint().
    struct Kept
    {
      std::string                           quantity; ///< empty: the energy norm
      unsigned int                          cycle = 0, n_meshes = 0;
      std::map<std::string, double>         numbers; ///< those that there are
      std::vector<std::vector<KeptCell>>    cells;   ///< by body
      std::vector<std::vector<SizesOfCell>> sizes;   ///< likewise

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &quantity &cycle &n_meshes &numbers &cells &sizes;
      }
    };

    std::string
    to_text(Kept &kept)
    {
      ByteWriter writer;
      writer &kept;
      return Utilities::encode_base64(
        {writer.bytes.begin(), writer.bytes.end()});
    }

    [[noreturn]] void
    refuse(const std::string &what)
    {
      throw std::out_of_range("its cycles have " + what);
    }

    void
    check(const double number)
    {
      if (!std::isfinite(number))
        refuse("a number that is not finite");
    }

    void
    check(const CellHistory &history, const unsigned int least_degree)
    {
      for (const double number : {history.change,
                                  history.error,
                                  history.ratio,
                                  history.by_residual,
                                  history.violation,
                                  history.share,
                                  history.fall,
                                  history.least_ratio})
        check(number);
      if (history.degree < least_degree || history.degree > max_degree)
        refuse("a cell of degree " + std::to_string(history.degree) +
               ", degrees are " + std::to_string(least_degree) + " to " +
               std::to_string(max_degree));
      if (history.n_rises > max_degree)
        refuse("a cell whose degree has risen " +
               std::to_string(history.n_rises) + " times, the largest is " +
               std::to_string(max_degree));
    }

    CellNumber
    number_of(const KeptCell &cell)
    {
      constexpr unsigned int max_level = 18; // of p4est
      if (cell.coarse > std::numeric_limits<unsigned int>::max() ||
          cell.children.size() > max_level ||
          std::any_of(cell.children.begin(), cell.children.end(), [](char c) {
            return static_cast<unsigned char>(c) >= 8;
          }))
        refuse("a cell that no mesh can have");
      return CellId(cell.coarse,
                    std::vector<std::uint8_t>(cell.children.begin(),
                                              cell.children.end()))
        .to_binary<dim>();
    }

    /// Throws std::out_of_range if it is none of tetrahedra that gmsh can be
    /// asked for.
    SizeField::Cell
    size_cell(const SizesOfCell &numbers)
    {
      // meshes halve theirs a few times
      constexpr double largest_ratio = 1e3;
      SizeField::Cell  cell;
      for (unsigned int v = 0; v < 4; ++v)
        {
          std::copy_n(&numbers[3 * v], 3, cell.vertices[v].begin_raw());
          cell.sizes[v] = numbers[12 + v];
        }
      for (const double number : numbers)
        check(number);
      Tensor<2, 3> edges;
      double       longest = 0.;
      for (unsigned int d = 0; d < 3; ++d)
        {
          edges[d] = cell.vertices[d + 1] - cell.vertices[0];
          longest  = std::max(longest, edges[d].norm());
        }
      if (!(determinant(edges) > 0.))
        refuse("a tetrahedron without volume");
      for (const double size : cell.sizes)
        if (!(size > longest / largest_ratio && size < longest * largest_ratio))
          refuse("edges of " + std::to_string(size) +
                 " in place of a tetrahedron of " + std::to_string(longest));
      return cell;
    }

    /// Throws std::out_of_range if @p sizes ask for far more tetrahedra than
    /// the @p n_cells of the mesh that was made by them.
    void
    check_number(const std::vector<SizeField::Cell> &sizes,
                 const std::size_t                   n_cells)
    {
      double wanted = 0.;
      for (const SizeField::Cell &cell : sizes)
        {
          Tensor<2, 3> edges;
          for (unsigned int d = 0; d < 3; ++d)
            edges[d] = cell.vertices[d + 1] - cell.vertices[0];
          // a regular one has six times its volume of edge^3 / sqrt(2)
          wanted += determinant(edges) * std::sqrt(2.) /
                    std::pow(std::accumulate(cell.sizes.begin(),
                                             cell.sizes.end(),
                                             0.) /
                               4.,
                             3);
        }
      if (wanted > 100. * n_cells + 1e4)
        refuse("sizes for " + std::to_string(std::lround(wanted)) +
               " tetrahedra in place of " + std::to_string(n_cells));
    }

    /// Throws std::out_of_range if @p text is not what to_text() gives, for
    /// @p bodies.
    Kept
    kept_from(const std::string &text, const std::vector<BodyParameters> &bodies)
    {
      const std::size_t end = std::min(text.find('='), text.size());
      if (text.size() % 4 != 0 || end + 2 < text.size() ||
          text.find_first_not_of('=', end) != std::string::npos ||
          text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrst"
                                 "uvwxyz0123456789+/=") != std::string::npos)
        refuse("characters that are none of base64");
      const auto        decoded = Utilities::decode_base64(text);
      const std::string bytes(decoded.begin(), decoded.end());
      ByteArchive       archive(bytes);
      Kept              kept;
      archive          &kept;
      if (archive.left() > 0)
        refuse(std::to_string(archive.left()) + " bytes too many");
      if (kept.cells.size() != bodies.size() ||
          kept.sizes.size() != bodies.size())
        refuse(std::to_string(kept.cells.size()) + " and " +
               std::to_string(kept.sizes.size()) + " bodies, the scene has " +
               std::to_string(bodies.size()));
      for (const char *name :
           {"value", "change of rest", "error of rest", "allowed", "residual"})
        if (kept.numbers.count(name) == 0)
          refuse("no number for '" + std::string(name) + "'");
      if (kept.numbers.count("estimate") != kept.numbers.count("at most"))
        refuse("half of an estimate");
      for (const auto &[name, number] : kept.numbers)
        check(number);
      for (unsigned int b = 0; b < bodies.size(); ++b)
        for (const KeptCell &cell : kept.cells[b])
          {
            check(cell.state.history,
                  is_mixed(bodies[b]) ? least_mixed_degree : 1);
            for (const auto &component : cell.state.dual)
              for (const double coefficient : component)
                check(coefficient);
          }
      for (unsigned int b = 0; b < bodies.size(); ++b)
        if (!kept.sizes[b].empty() &&
            (bodies[b].mesh.source != "file" ||
             !is_geometry_file(bodies[b].mesh.file)))
          refuse("a new mesh of body " + in_quotes(bodies[b].name) +
                 ", which is not made by gmsh");
      return kept;
    }

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
      NumberedStates result;
      for (const auto &of_rank :
           Utilities::MPI::all_gather(body.triangulation().get_communicator(),
                                      own))
        result.insert(result.end(), of_rank.begin(), of_rank.end());
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
    kept = to_text(result);
  }

  void
  Adaptivity::resume(const std::string &text)
  {
    const Kept given = kept_from(text, run.parameters.bodies);
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
