#include <deal.II/base/bounding_box.h>
#include <deal.II/base/geometry_info.h>

#include <mortise/base/numbers.h>
#include <mortise/body/mesh/surface_patches.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>

#include "mesh_file_parts.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Six times the volume of a tetrahedron over the third power of its
    /// longest edge; at a hexahedron's vertex: of the three edges there.
    double
    corner_quality(const std::array<Tensor<1, 3>, 3> &edges)
    {
      const double longest =
        std::max({edges[0].norm(), edges[1].norm(), edges[2].norm()});
      return longest == 0. ? 0. :
                             cross_product_3d(edges[0], edges[1]) * edges[2] /
                               (longest * longest * longest);
    }

    /// The least and the greatest corner quality of a cell.
    std::pair<double, double>
    quality_range(const CoarseMesh &mesh, const std::size_t c)
    {
      const auto               &v     = mesh.cells[c].vertices;
      std::pair<double, double> range = {2., -2.};
      for (unsigned int corner = 0; corner < (v.size() == 8 ? 8 : 1); ++corner)
        {
          std::array<Tensor<1, 3>, 3> edges;
          for (unsigned int d = 0; d < 3; ++d)
            edges[d] = v.size() == 8 ?
                         mesh.vertices[v[corner | (1 << d)]] -
                           mesh.vertices[v[corner & ~(1 << d)]] :
                         mesh.vertices[v[d + 1]] - mesh.vertices[v[0]];
          const double quality = corner_quality(edges);
          range.first          = std::min(range.first, quality);
          range.second         = std::max(range.second, quality);
        }
      return range;
    }

    /// Number all cells the other way round: tetrahedra by swapping two
    /// vertices, hexahedra by swapping two opposite faces.
    void
    mirror(CoarseMesh &mesh)
    {
      if (mesh.geometry != nullptr)
        {
          constexpr unsigned int tetrahedron[10] = {
            0, 1, 3, 2, 4, 8, 7, 6, 5, 9};
          auto               mirrored = *mesh.geometry;
          const unsigned int n        = mirrored.nodes_per_cell;
          for (std::size_t i = 0; i < mirrored.nodes.size(); ++i)
            mirrored.nodes[i] =
              mesh.geometry
                ->nodes[i / n * n + (n == 10 ? tetrahedron[i % n] :
                                               i % 9 + 9 * (2 - i % n / 9))];
          mesh.geometry = std::make_shared<CoarseGeometry>(mirrored);
        }
      for (CellData<3> &cell : mesh.cells)
        if (cell.vertices.size() == 4)
          std::swap(cell.vertices[2], cell.vertices[3]);
        else
          std::rotate(cell.vertices.begin(),
                      cell.vertices.begin() + 4,
                      cell.vertices.end());
    }

    std::string
    cell_name(const CoarseMesh &mesh, const std::size_t c)
    {
      return "cell " + std::to_string(mesh.cell_numbers[c]);
    }

    /// The curved cells are not folded at their nodes.
    void
    check_curved_cells(CoarseMesh &mesh)
    {
      const CoarseGeometry &geometry = *mesh.geometry;
      for (std::size_t c = 0; c < geometry.n_cells(); ++c)
        {
          double sign = 0.; // the nodes may be numbered inside out
          for (unsigned int i = 0; i < geometry.nodes_per_cell; ++i)
            {
              const Point<3> unit =
                geometry.nodes_per_cell == 27 ?
                  Point<3>(0.5 * (i % 3), 0.5 * (i / 3 % 3), 0.5 * (i / 9)) :
                  Point<3>(0.5 * (i == 4 || i == 5 || i == 8) + (i == 1),
                           0.5 * (i == 5 || i == 6 || i == 9) + (i == 2),
                           0.5 * (i == 7 || i == 8 || i == 9) + (i == 3));
              const double det = determinant(geometry.jacobian(c, unit));
              if (i == 0)
                sign = det;
              if (det * sign > 0.)
                continue;
              mesh.findings
                .error("second-order cells that their curved sides fold",
                       "allowed: a positive Jacobian (in gmsh: "
                       "Mesh.HighOrderOptimize = 2 or a finer mesh; or first "
                       "order, with Curved boundaries)")
                .at(cell_name(mesh, c), geometry.point(c, unit));
              break;
            }
        }
    }

    /// Vertices of named boundary faces, with the ids of these.
    std::vector<std::set<types::boundary_id>>
    named_surfaces(const CoarseMesh &mesh)
    {
      std::vector<std::set<types::boundary_id>> ids(mesh.vertices.size());
      for (const CellData<2> &face : mesh.faces.boundary_quads)
        for (const unsigned int v : face.vertices)
          if (face.boundary_id != 0)
            ids[v].insert(face.boundary_id);
      return ids;
    }

    std::vector<std::set<types::material_id>>
    volumes_at_vertices(const CoarseMesh &mesh)
    {
      std::vector<std::set<types::material_id>> ids(mesh.vertices.size());
      for (const CellData<3> &cell : mesh.cells)
        for (const unsigned int v : cell.vertices)
          ids[v].insert(cell.material_id);
      return ids;
    }

    /// Pairs of vertices that are closer than @p distance: neighbours along x
    /// that are near in y and z too.
    std::vector<std::pair<unsigned int, unsigned int>>
    coinciding_pairs(const std::vector<Point<3>> &vertices,
                     const double                 distance)
    {
      std::vector<unsigned int> order(vertices.size());
      for (unsigned int v = 0; v < order.size(); ++v)
        order[v] = v;
      // a direction in which hardly any two different vertices are equal
      const Tensor<1, 3> direction =
        Point<3>(1., 0.6180339887498949, 0.2360679774997897);
      const auto place = [&](const unsigned int v) {
        return direction * vertices[v];
      };
      std::sort(order.begin(),
                order.end(),
                [&](const unsigned int v, const unsigned int w) {
                  return place(v) < place(w);
                });
      std::vector<std::pair<unsigned int, unsigned int>> pairs;
      for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1;
             j < order.size() &&
             place(order[j]) - place(order[i]) <= 2. * distance;
             ++j)
          if (vertices[order[i]].distance(vertices[order[j]]) <= distance)
            pairs.emplace_back(order[i], order[j]);
      return pairs;
    }

    template <typename Id>
    bool
    disjoint(const std::set<Id> &a, const std::set<Id> &b)
    {
      return std::none_of(a.begin(), a.end(), [&](const Id id) {
        return b.count(id) > 0;
      });
    }

    /// Cells at the vertices of @p pairs.
    std::map<unsigned int, std::set<std::size_t>>
    cells_at_ends(
      const CoarseMesh                                         &mesh,
      const std::vector<std::pair<unsigned int, unsigned int>> &pairs)
    {
      std::map<unsigned int, std::set<std::size_t>> cells;
      for (const auto &[v, w] : pairs)
        cells[v], cells[w];
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (const unsigned int v : mesh.cells[c].vertices)
          if (const auto end = cells.find(v); end != cells.end())
            end->second.insert(c);
      return cells;
    }
  } // namespace

  void
  check_size(const CoarseMesh &mesh, const FileError &fail)
  {
    const auto   box  = BoundingBox<3>(mesh.vertices).get_boundary_points();
    const double size = box.first.distance(box.second);
    if (size >= smallest_length && size <= largest_length)
      return;
    std::ostringstream text;
    text << "has a body of size " << size << ", from " << place_name(box.first)
         << " to " << place_name(box.second)
         << "; allowed: " << allowed_lengths();
    fail(text.str());
  }

  void
  check_volumes(CoarseMesh &mesh)
  {
    constexpr double flat     = 1e-12;
    std::size_t      negative = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      negative += quality_range(mesh, c).second < -flat;
    if (negative == mesh.cells.size())
      mirror(mesh);
    bool flawed = false;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        const auto range = quality_range(mesh, c);
        if (range.first > flat)
          continue;
        flawed = true;
        mesh.findings
          .error(range.first < -flat ?
                   "cells that are turned inside out (negative volume)" :
                   "cells without volume",
                 std::string("allowed: ") +
                   (mesh.cells[c].vertices.size() == 4 ?
                      "tetrahedra of positive volume" :
                      "convex hexahedra"))
          .at(cell_name(mesh, c),
              middle(mesh.vertices, mesh.cells[c].vertices));
      }
    if (mesh.geometry != nullptr && !flawed)
      check_curved_cells(mesh);
  }

  void
  check_coinciding_nodes(CoarseMesh &mesh)
  {
    constexpr double same = 1e-9, near = 1e-6;
    const auto       box  = BoundingBox<3>(mesh.vertices).get_boundary_points();
    const double     size = box.first.distance(box.second);
    const auto       pairs = coinciding_pairs(mesh.vertices, near * size);
    if (pairs.empty())
      return;
    const auto surfaces = named_surfaces(mesh);
    const auto volumes  = volumes_at_vertices(mesh);
    const auto cells    = cells_at_ends(mesh, pairs);
    for (const auto &[v, w] : pairs)
      {
        const bool named = !surfaces[v].empty() && !surfaces[w].empty();
        if ((named && (disjoint(volumes[v], volumes[w]) ||
                       surfaces[v] != surfaces[w])) ||
            !disjoint(cells.at(v), cells.at(w))) // an edge
          continue;
        (mesh.vertices[v].distance(mesh.vertices[w]) <= same * size ?
           mesh.findings.error(
             "pairs of nodes at one place, which leave the cells apart there",
             "allowed: one node at a place (in gmsh: Coherence, or Coherence "
             "Mesh; for a crack or an interface within the body: two physical "
             "surfaces of different names)") :
           mesh.findings.warning(
             "pairs of nodes less than 1e-6 of the body apart that no cell joins",
             "are they meant to be one?"))
          .at("nodes " + std::to_string(mesh.vertex_numbers[v]) + " and " +
                std::to_string(mesh.vertex_numbers[w]),
              mesh.vertices[v]);
      }
  }
} // namespace mortise
