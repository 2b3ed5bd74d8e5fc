#include <deal.II/base/geometry_info.h>

#include <mortise/body/mesh/coarse_geometry.h>
#include <mortise/body/mesh/vertex_order.h>

#include <algorithm>
#include <array>
#include <limits>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int hex_nodes = 27, tet_nodes = 10;

    /// Lagrange polynomials on 0, 1/2, 1 and their derivatives.
    std::array<std::array<double, 2>, 3>
    lagrange(const double x)
    {
      return {{{{(1. - x) * (1. - 2. * x), 4. * x - 3.}},
               {{4. * x * (1. - x), 4. - 8. * x}},
               {{x * (2. * x - 1.), 4. * x - 1.}}}};
    }

    /// Value (component 3) and gradient of each node's function.
    std::vector<std::array<double, 4>>
    hex_functions(const Point<3> &x)
    {
      const auto a = lagrange(x[0]), b = lagrange(x[1]), c = lagrange(x[2]);
      std::vector<std::array<double, 4>> result;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int i = 0; i < 3; ++i)
            result.push_back({{a[i][1] * b[j][0] * c[k][0],
                               a[i][0] * b[j][1] * c[k][0],
                               a[i][0] * b[j][0] * c[k][1],
                               a[i][0] * b[j][0] * c[k][0]}});
      return result;
    }

    std::vector<std::array<double, 4>>
    tet_functions(const Point<3> &x)
    {
      const auto lambda = barycentric_coordinates(x);
      const auto slope  = [](const unsigned int v, const unsigned int d) {
        return v == 0 ? -1. : (v == d + 1 ? 1. : 0.);
      };
      std::vector<std::array<double, 4>> result(tet_nodes);
      for (unsigned int v = 0; v < 4; ++v)
        {
          for (unsigned int d = 0; d < 3; ++d)
            result[v][d] = (4. * lambda[v] - 1.) * slope(v, d);
          result[v][3] = lambda[v] * (2. * lambda[v] - 1.);
        }
      for (unsigned int l = 0; l < 6; ++l)
        {
          const unsigned int v = tetrahedron_lines[l][0],
                             w = tetrahedron_lines[l][1];
          for (unsigned int d = 0; d < 3; ++d)
            result[4 + l][d] =
              4. * (lambda[v] * slope(w, d) + lambda[w] * slope(v, d));
          result[4 + l][3] = 4. * lambda[v] * lambda[w];
        }
      return result;
    }

    std::vector<std::array<double, 4>>
    functions(const unsigned int nodes_per_cell, const Point<3> &x)
    {
      return nodes_per_cell == hex_nodes ? hex_functions(x) : tet_functions(x);
    }

    /// Place of vertex @p v of deal.II's unit cell.
    Point<3>
    unit_vertex(const unsigned int nodes_per_cell, const unsigned int v)
    {
      if (nodes_per_cell == hex_nodes)
        return GeometryInfo<3>::unit_cell_vertex(v);
      return v == 0 ? Point<3>() : Point<3>::unit_vector(v - 1);
    }

    /// Node at vertex @p v.
    unsigned int
    vertex_node(const unsigned int nodes_per_cell, const unsigned int v)
    {
      return nodes_per_cell == hex_nodes ?
               2 * (v % 2) + 6 * (v / 2 % 2) + 18 * (v / 4) :
               v;
    }

    /// Vertices that span the unit cell with vertex 0.
    unsigned int
    spanning_vertex(const unsigned int nodes_per_cell, const unsigned int d)
    {
      return nodes_per_cell == hex_nodes ? 1 << d : d + 1;
    }
  } // namespace

  CoarseGeometry::CoarseGeometry(const unsigned int           nodes_per_cell,
                                 const std::vector<Point<3>> &nodes)
    : nodes_per_cell(nodes_per_cell)
    , nodes(nodes)
  {
    AssertThrow((nodes_per_cell == hex_nodes || nodes_per_cell == tet_nodes) &&
                  nodes.size() % nodes_per_cell == 0,
                ExcMessage("CoarseGeometry: " + std::to_string(nodes.size()) +
                           " nodes in cells of " +
                           std::to_string(nodes_per_cell)));
  }

  Point<3>
  CoarseGeometry::point(const std::size_t cell, const Point<3> &unit) const
  {
    const auto      shape = functions(nodes_per_cell, unit);
    const Point<3> *node  = &nodes[cell * nodes_per_cell];
    Point<3>        x;
    for (unsigned int i = 0; i < nodes_per_cell; ++i)
      x += shape[i][3] * Tensor<1, 3>(node[i]);
    return x;
  }

  Tensor<2, 3>
  CoarseGeometry::jacobian(const std::size_t cell, const Point<3> &unit) const
  {
    const auto      shape = functions(nodes_per_cell, unit);
    const Point<3> *node  = &nodes[cell * nodes_per_cell];
    Tensor<2, 3>    result;
    for (unsigned int i = 0; i < nodes_per_cell; ++i)
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
          result[c][d] += node[i][c] * shape[i][d];
    return result;
  }

  CoarseGeometry::Placement
  CoarseGeometry::root_placement(const CellIterator &cell) const
  {
    Placement result;
    // p4est permutes coarse cells, of which every rank has all, and ids tell
    // its order; what METIS distributes keeps its order in ids alone
    result.coarse_cell = nodes_per_cell == hex_nodes ?
                           cell->index() :
                           cell->id().get_coarse_cell_id();
    AssertThrow(result.coarse_cell < n_cells(),
                ExcMessage("CoarseGeometry: the triangulation has more coarse "
                           "cells than the geometry"));
    const Point<3>    *node = &nodes[result.coarse_cell * nodes_per_cell];
    const unsigned int n    = cell->n_vertices();
    const auto         unit = [&](const unsigned int v) {
      unsigned int nearest  = 0;
      double       distance = std::numeric_limits<double>::max();
      for (unsigned int w = 0; w < n; ++w)
        {
          const double d = cell->vertex(v).distance_square(
            node[vertex_node(nodes_per_cell, w)]);
          if (d < distance)
            {
              distance = d;
              nearest  = w;
            }
        }
      return unit_vertex(nodes_per_cell, nearest);
    };
    result.origin = unit(0);
    for (unsigned int d = 0; d < 3; ++d)
      {
        const Tensor<1, 3> direction =
          unit(spanning_vertex(nodes_per_cell, d)) - result.origin;
        for (unsigned int c = 0; c < 3; ++c)
          result.directions[c][d] = direction[c];
      }
    return result;
  }

  CoarseGeometry::Placement
  CoarseGeometry::placement(const CellIterator &cell) const
  {
    if (cell->level() == 0)
      return root_placement(cell);
    Assert(nodes_per_cell == hex_nodes, ExcNotImplemented());
    const Placement parent = placement(cell->parent());
    const auto      place  = [&](const unsigned int v) {
      unsigned int child = 0;
      while (cell->parent()->child_index(child) != cell->index())
        ++child;
      return GeometryInfo<3>::child_to_cell_coordinates(
        GeometryInfo<3>::unit_cell_vertex(v), child);
    };
    Placement      result = parent;
    const Point<3> first  = place(0);
    result.origin += parent.directions * first;
    for (unsigned int d = 0; d < 3; ++d)
      {
        const Tensor<1, 3> direction =
          parent.directions *
          (place(spanning_vertex(nodes_per_cell, d)) - first);
        for (unsigned int c = 0; c < 3; ++c)
          result.directions[c][d] = direction[c];
      }
    return result;
  }

  std::vector<Point<3>>
  CoarseGeometry::points(const CellIterator          &cell,
                         const std::vector<Point<3>> &unit) const
  {
    const Placement       at = placement(cell);
    std::vector<Point<3>> result;
    for (const Point<3> &x : unit)
      result.push_back(point(at.coarse_cell, at.origin + at.directions * x));
    return result;
  }

  void
  CoarseGeometry::place_vertices(Triangulation<3> &triangulation) const
  {
    std::vector<Point<3>> unit;
    for (unsigned int v = 0; v < (nodes_per_cell == hex_nodes ? 8 : 4); ++v)
      unit.push_back(unit_vertex(nodes_per_cell, v));
    // Coarse vertices stay: placements are found by them.
    for (unsigned int level = 1; level < triangulation.n_levels(); ++level)
      for (const auto &cell : triangulation.cell_iterators_on_level(level))
        {
          const std::vector<Point<3>> positions = points(cell, unit);
          for (const unsigned int v : cell->vertex_indices())
            cell->vertex(v) = positions[v];
        }
  }

  void
  CoarseGeometry::place_vertices(const std::vector<CellData<3>> &cells,
                                 std::vector<Point<3>>          &vertices) const
  {
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
      for (unsigned int v = 0; v < cells[cell].vertices.size(); ++v)
        vertices[cells[cell].vertices[v]] =
          nodes[cell * nodes_per_cell + vertex_node(nodes_per_cell, v)];
  }

  CoarseGeometry
  CoarseGeometry::refined() const
  {
    Assert(nodes_per_cell == hex_nodes, ExcNotImplemented());
    CoarseGeometry result;
    result.nodes_per_cell = hex_nodes;
    for (std::size_t cell = 0; cell < n_cells(); ++cell)
      for (unsigned int child = 0; child < 8; ++child)
        for (unsigned int i = 0; i < hex_nodes; ++i)
          result.nodes.push_back(
            point(cell,
                  GeometryInfo<3>::child_to_cell_coordinates(
                    Point<3>(0.5 * (i % 3), 0.5 * (i / 3 % 3), 0.5 * (i / 9)),
                    child)));
    return result;
  }

  CoarseGeometry
  CoarseGeometry::selected(const std::vector<std::size_t> &kept) const
  {
    CoarseGeometry result;
    result.nodes_per_cell = nodes_per_cell;
    for (const std::size_t cell : kept)
      result.nodes.insert(result.nodes.end(),
                          nodes.begin() + cell * nodes_per_cell,
                          nodes.begin() + (cell + 1) * nodes_per_cell);
    return result;
  }

  void
  complete_serendipity(std::vector<Point<3>> &nodes)
  {
    // With s the number of coordinates in the middle, a corner weighs
    // -1/4 on a face (s = 2) and on the centre (s = 3), an edge 1/2 and 1/4.
    for (unsigned int m = 0; m < hex_nodes; ++m)
      {
        const std::array<unsigned int, 3> at = {{m % 3, m / 3 % 3, m / 9}};
        const auto middles = std::count(at.begin(), at.end(), 1u);
        if (middles < 2)
          continue;
        Tensor<1, 3> sum;
        for (unsigned int n = 0; n < hex_nodes; ++n)
          {
            const std::array<unsigned int, 3> other = {
              {n % 3, n / 3 % 3, n / 9}};
            bool beside = true; // on the same face, or any for the centre
            for (unsigned int d = 0; d < 3; ++d)
              beside = beside && (at[d] == 1 || other[d] == at[d]);
            const auto between = std::count(other.begin(), other.end(), 1u);
            if (beside && between == 0)
              sum -= 0.25 * nodes[n];
            if (beside && between == 1)
              sum += (middles == 2 ? 0.5 : 0.25) * nodes[n];
          }
        nodes[m] = Point<3>(sum);
      }
  }
} // namespace mortise
