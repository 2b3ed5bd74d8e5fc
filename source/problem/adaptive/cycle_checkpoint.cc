#include <mortise/base/quotes.h>
#include <mortise/body/mesh/gmsh_model.h>
#include <mortise/problem/adaptive/cycle_checkpoint.h>
#include <mortise/problem/input/formulation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace mortise
{
  using namespace dealii;

  namespace
  {
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
                                  history.raised,
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
  } // namespace

  CellNumber
  number_of(const CellCheckpoint &cell)
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
        wanted +=
          determinant(edges) * std::sqrt(2.) /
          std::pow(std::accumulate(cell.sizes.begin(), cell.sizes.end(), 0.) /
                     4.,
                   3);
      }
    if (wanted > 100. * n_cells + 1e4)
      refuse("sizes for " + std::to_string(std::lround(wanted)) +
             " tetrahedra in place of " + std::to_string(n_cells));
  }

  void
  check(const CycleCheckpoint &kept, const std::vector<BodyParameters> &bodies)
  {
    const EstimateMemory &memory = kept.memory;
    if (memory.residual.size() != bodies.size() ||
        kept.cells.size() != bodies.size() ||
        kept.sizes.size() != bodies.size())
      refuse(std::to_string(memory.residual.size()) + ", " +
             std::to_string(kept.cells.size()) + " and " +
             std::to_string(kept.sizes.size()) + " bodies, the scene has " +
             std::to_string(bodies.size()));
    if (memory.estimate.has_value() != memory.upper_estimate.has_value())
      refuse("half of an estimate");
    for (const double number : {memory.value,
                                memory.change_of_rest,
                                memory.error_of_rest,
                                memory.allowed_error,
                                memory.estimate.value_or(0.),
                                memory.upper_estimate.value_or(0.)})
      check(number);
    for (const double number : memory.residual)
      check(number);
    if (memory.n_estimates > memory.n_cycles)
      refuse(std::to_string(memory.n_estimates) + " estimates in " +
             std::to_string(memory.n_cycles) + " cycles");
    for (unsigned int b = 0; b < bodies.size(); ++b)
      for (const CellCheckpoint &cell : kept.cells[b])
        {
          number_of(cell);
          check(cell.state.history,
                is_mixed(bodies[b]) ? least_mixed_degree : 1);
          for (const auto &component : cell.state.dual)
            for (const double coefficient : component)
              check(coefficient);
        }
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (!kept.sizes[b].empty() && (bodies[b].mesh.source != "file" ||
                                     !is_geometry_file(bodies[b].mesh.file)))
        refuse("a new mesh of body " + in_quotes(bodies[b].name) +
               ", which is not made by gmsh");
  }
} // namespace mortise
