#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <mortise/body/elements/simplex_mapping.h>
#include <mortise/body/mesh/vertex_order.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// By point and node.
    std::vector<std::vector<Tensor<1, 3>>>
    gradients_at(const ScalarPolynomialsBase<3> &nodal,
                 const std::vector<Point<3>>    &unit_points)
    {
      std::vector<std::vector<Tensor<1, 3>>> result;
      std::vector<double>                    no_0;
      std::vector<Tensor<2, 3>>              no_2;
      std::vector<Tensor<3, 3>>              no_3;
      std::vector<Tensor<4, 3>>              no_4;
      for (const Point<3> &point : unit_points)
        {
          result.emplace_back(nodal.n());
          nodal.evaluate(point, no_0, result.back(), no_2, no_3, no_4);
        }
      return result;
    }

    bool
    is_tangled(const std::vector<Point<3>>                  &nodes,
               const std::vector<std::vector<Tensor<1, 3>>> &gradients)
    {
      return std::any_of(gradients.begin(),
                         gradients.end(),
                         [&](const auto &at_point) {
                           Tensor<2, 3> jacobian;
                           for (unsigned int k = 0; k < nodes.size(); ++k)
                             jacobian += outer_product(nodes[k], at_point[k]);
                           return !(determinant(jacobian) > 0.);
                         });
    }

    constexpr unsigned int all_lines = 63; ///< of a tetrahedron, by bit

    /// Which lines of @p cell are @p straight.
    unsigned int
    lines_of(const Triangulation<3>::active_cell_iterator &cell,
             const std::vector<bool>                      &straight)
    {
      unsigned int result = 0;
      for (const unsigned int l : cell->line_indices())
        result |= straight[cell->line_index(l)] ? 1u << l : 0u;
      return result;
    }

    /// Add the lines of cells that are @p tangled, which cells of other ranks may share, to @p straight. Collective.
    void
    add_lines(const std::vector<bool> &tangled,
              const Triangulation<3>  &triangulation,
              std::vector<bool>       &straight)
    {
      using Cell     = Triangulation<3>::active_cell_iterator;
      const auto add = [&](const Cell &cell, const unsigned int lines) {
        for (const unsigned int l : cell->line_indices())
          if (lines >> l & 1)
            straight[cell->line_index(l)] = true;
      };
      const auto own = [&](const Cell &cell) -> unsigned int {
        return tangled[cell->active_cell_index()] ? all_lines : 0;
      };
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          add(cell, own(cell));
      // to the neighbours of tangled cells, then from them to theirs
      GridTools::exchange_cell_data_to_ghosts<unsigned int, Triangulation<3>>(
        triangulation, own, add);
      GridTools::exchange_cell_data_to_ghosts<unsigned int, Triangulation<3>>(
        triangulation,
        [&](const Cell &cell) { return lines_of(cell, straight); },
        add);
    }

    /// Put nodes on @p straight lines, and on faces and in cells that have one, on the cell with straight faces.
    void
    straighten(const Triangulation<3>::active_cell_iterator &cell,
               const std::vector<bool>                      &straight,
               const std::vector<Point<3>>                  &reference_nodes,
               std::vector<Point<3>>                        &nodes)
    {
      const unsigned int lines = lines_of(cell, straight);
      if (lines == 0)
        return;
      for (unsigned int k = 0; k < nodes.size(); ++k)
        {
          const auto lambda = barycentric_coordinates(reference_nodes[k]);
          Point<3>   place;
          for (const unsigned int v : cell->vertex_indices())
            place += lambda[v] * cell->vertex(v);
          for (const unsigned int l : cell->line_indices())
            if ((lines >> l & 1) && lambda[tetrahedron_lines[l][0]] > 1e-10 &&
                lambda[tetrahedron_lines[l][1]] > 1e-10)
              nodes[k] = place;
        }
    }
  } // namespace

  unsigned int
  SimplexMapping::straighten_tangled_cells(
    const Triangulation<3>      &triangulation,
    const std::vector<Point<3>> &unit_points)
  {
    const auto        gradients       = gradients_at(*nodal, unit_points);
    const auto        reference_nodes = this->reference_nodes();
    auto              all             = std::make_shared<Points>(*points);
    std::vector<bool> straight(triangulation.n_raw_lines(), false);
    unsigned int      n_all = 0;
    // neighbours, which become half straight, may be tangled then
    while (true)
      {
        std::vector<bool> tangled(triangulation.n_active_cells(), false);
        unsigned int      n = 0;
        for (const auto &cell : triangulation.active_cell_iterators())
          if (const unsigned int k = cell->active_cell_index();
              cell->is_locally_owned() &&
              lines_of(cell, straight) != all_lines &&
              is_tangled((*all)[k], gradients))
            {
              tangled[k] = true;
              ++n;
            }
        n = Utilities::MPI::sum(n, triangulation.get_communicator());
        if (n == 0)
          break;
        n_all += n;
        add_lines(tangled, triangulation, straight);
        for (const auto &cell : triangulation.active_cell_iterators())
          if (!cell->is_artificial())
            straighten(cell,
                       straight,
                       reference_nodes,
                       (*all)[cell->active_cell_index()]);
      }
    points = all;
    return n_all;
  }
} // namespace mortise
