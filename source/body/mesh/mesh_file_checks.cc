#include <deal.II/base/bounding_box.h>
#include <deal.II/base/geometry_info.h>

#include <mortise/base/numbers.h>

#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include "mesh_file_parts.h"

namespace mortise
{
  using namespace dealii;

  std::string
  place_name(const Point<3> &x)
  {
    std::ostringstream text;
    text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
    return text.str();
  }

  namespace
  {
    Point<3>
    centre(const CoarseMesh &mesh, const std::size_t cell)
    {
      Tensor<1, 3> sum;
      for (const unsigned int v : mesh.cells[cell].vertices)
        sum += mesh.vertices[v];
      return Point<3>(sum / double(mesh.cells[cell].vertices.size()));
    }

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

    /// The curved cells are not folded at their nodes.
    void
    check_curved_cells(const CoarseMesh &mesh, const FileError &fail)
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
              if (!(det * sign > 0.))
                fail(
                  "has a second-order cell that its curved sides fold, near " +
                  place_name(geometry.point(c, unit)) +
                  "; allowed: a positive Jacobian (in gmsh: "
                  "Mesh.HighOrderOptimize = 2 or a finer mesh; or first order, with "
                  "Curved boundaries)");
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
  check_volumes(CoarseMesh &mesh, const FileError &fail)
  {
    constexpr double flat     = 1e-12;
    std::size_t      negative = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      negative += quality_range(mesh, c).second < -flat;
    if (negative == mesh.cells.size())
      mirror(mesh);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        const auto range = quality_range(mesh, c);
        if (range.first > flat)
          continue;
        const bool tetrahedron = mesh.cells[c].vertices.size() == 4;
        fail(
          "has a cell " +
          std::string(range.first < -flat ?
                        "that is turned inside out (negative volume)" :
                        "without volume") +
          ", at " + place_name(centre(mesh, c)) + "; allowed: " +
          (tetrahedron ? "tetrahedra of positive volume" : "convex hexahedra"));
      }
    if (mesh.geometry != nullptr)
      check_curved_cells(mesh, fail);
  }

  void
  check_coinciding_nodes(const CoarseMesh &mesh, const FileError &fail)
  {
    const auto box = BoundingBox<3>(mesh.vertices).get_boundary_points();
    const auto pairs =
      coinciding_pairs(mesh.vertices, 1e-9 * box.first.distance(box.second));
    if (pairs.empty())
      return;
    const auto surfaces = named_surfaces(mesh);
    const auto volumes  = volumes_at_vertices(mesh);
    for (const auto &[v, w] : pairs)
      {
        const bool named = !surfaces[v].empty() && !surfaces[w].empty();
        if (named &&
            (disjoint(volumes[v], volumes[w]) || surfaces[v] != surfaces[w]))
          continue;
        fail(
          "has two nodes at " + place_name(mesh.vertices[v]) + " (" +
          std::to_string(pairs.size()) +
          " such pairs in this body), which leaves its cells apart there; allowed: one node "
          "at a place (in gmsh: Coherence, or Coherence Mesh; for a crack or an interface "
          "within the body: two physical surfaces of different names)");
      }
  }
} // namespace mortise
