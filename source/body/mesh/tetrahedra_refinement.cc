#include <mortise/body/mesh/curved_boundaries.h>
#include <mortise/body/mesh/tetrahedra.h>
#include <mortise/body/mesh/vertex_order.h>

#include <algorithm>
#include <array>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Vertices (0 to 3) and middles of lines (4 to 9) of a tetrahedron.
    using Child = std::array<unsigned int, 4>;

    Point<3>
    unit_point(const unsigned int i)
    {
      const auto vertex = [](const unsigned int v) {
        return ReferenceCells::Tetrahedron.vertex<3>(v);
      };
      return i < 4 ? vertex(i) :
                     Point<3>(0.5 * (vertex(tetrahedron_lines[i - 4][0]) +
                                     vertex(tetrahedron_lines[i - 4][1])));
    }

    /// The eight children, positive if the parent is; the last four around
    /// @p diagonal (0, 1, 2) of the octahedron.
    std::array<Child, 8>
    children(const unsigned int diagonal)
    {
      // ends of the diagonals, and the other middles around each
      constexpr unsigned int ends[3][2] = {{4, 9}, {5, 7}, {6, 8}};
      std::array<Child, 8>   result     = {
        {{{0, 4, 6, 7}}, {{4, 1, 5, 8}}, {{6, 5, 2, 9}}, {{7, 8, 9, 3}}}};
      const auto &first            = ends[(diagonal + 1) % 3],
                 &second           = ends[(diagonal + 2) % 3];
      const unsigned int around[4] = {first[0], second[0], first[1], second[1]};
      for (unsigned int i = 0; i < 4; ++i)
        {
          Child &child         = result[4 + i];
          child                = {{ends[diagonal][0],
                                   ends[diagonal][1],
                                   around[i],
                                   around[(i + 1) % 4]}};
          const Point<3>     x = unit_point(child[0]);
          const Tensor<1, 3> a = unit_point(child[1]) - x,
                             b = unit_point(child[2]) - x,
                             c = unit_point(child[3]) - x;
          if (cross_product_3d(a, b) * c < 0.)
            std::swap(child[2], child[3]);
        }
      return result;
    }

    /// Appends the middles of edges to the vertices of a mesh.
    class Middles
    {
    public:
      Middles(const CoarseMesh &coarse, std::vector<Point<3>> &vertices)
        : coarse(coarse)
        , curved(coarse.shapes.empty() ? CurvedEdges() : curved_edges(coarse))
        , vertices(vertices)
      {}

      /// Middle of the edge between the vertices @p v and @p w, and where it
      /// is if the mesh has curved geometry.
      unsigned int
      operator()(const unsigned int v,
                 const unsigned int w,
                 const Point<3>    *place)
      {
        const std::array<unsigned int, 2> key = {
          {std::min(v, w), std::max(v, w)}};
        const auto known = indices.find(key);
        if (known != indices.end())
          return known->second;
        Point<3> middle =
          coarse.vertices[v] + 0.5 * (coarse.vertices[w] - coarse.vertices[v]);
        const auto surfaces = curved.find(key);
        if (place != nullptr)
          middle = *place;
        else if (surfaces != curved.end())
          middle = project(surfaces->second, middle);
        vertices.push_back(middle);
        return indices[key] = vertices.size() - 1;
      }

    private:
      const CoarseMesh                                   &coarse;
      const CurvedEdges                                   curved;
      std::vector<Point<3>>                              &vertices;
      std::map<std::array<unsigned int, 2>, unsigned int> indices;
    };

    /// Nodes of second order of @p child within cell @p cell of @p geometry.
    void
    add_nodes(const CoarseGeometry  &geometry,
              const std::size_t      cell,
              const Child           &child,
              std::vector<Point<3>> &nodes)
    {
      for (unsigned int i = 0; i < 10; ++i)
        {
          const auto   lambda = barycentric_coordinates(unit_point(i));
          Tensor<1, 3> unit;
          for (unsigned int v = 0; v < 4; ++v)
            unit += lambda[v] * unit_point(child[v]);
          nodes.push_back(geometry.point(cell, Point<3>(unit)));
        }
    }

    /// The four parts of @p face, whose edges have middles already.
    void
    cut_face(const CellData<2> &face, Middles &middles, SubCellData &faces)
    {
      const auto        &v    = face.vertices;
      const unsigned int m[3] = {middles(v[0], v[1], nullptr),
                                 middles(v[1], v[2], nullptr),
                                 middles(v[2], v[0], nullptr)};
      for (const std::array<unsigned int, 3> &part :
           {std::array<unsigned int, 3>{{v[0], m[0], m[2]}},
            std::array<unsigned int, 3>{{m[0], v[1], m[1]}},
            std::array<unsigned int, 3>{{m[2], m[1], v[2]}},
            std::array<unsigned int, 3>{{m[0], m[1], m[2]}}})
        {
          CellData<2> data = face;
          std::copy(part.begin(), part.end(), data.vertices.begin());
          faces.boundary_quads.push_back(data);
        }
    }
  } // namespace

  CoarseMesh
  refine_tetrahedra(const CoarseMesh &mesh)
  {
    CoarseMesh fine;
    fine.vertices = mesh.vertices;
    fine.names    = mesh.names;
    fine.shapes   = mesh.shapes;
    Middles               middles(mesh, fine.vertices);
    std::vector<Point<3>> nodes;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        const auto                  &v = mesh.cells[c].vertices;
        std::array<unsigned int, 10> all;
        std::copy(v.begin(), v.end(), all.begin());
        for (unsigned int l = 0; l < 6; ++l)
          all[4 + l] = middles(v[tetrahedron_lines[l][0]],
                               v[tetrahedron_lines[l][1]],
                               mesh.geometry != nullptr ?
                                 &mesh.geometry->nodes[10 * c + 4 + l] :
                                 nullptr);
        const auto length = [&](const unsigned int i, const unsigned int j) {
          return fine.vertices[all[i]].distance(fine.vertices[all[j]]);
        };
        const std::array<double, 3> lengths = {
          {length(4, 9), length(5, 7), length(6, 8)}};
        for (const Child &child :
             children(std::min_element(lengths.begin(), lengths.end()) -
                      lengths.begin()))
          {
            CellData<3> cell = mesh.cells[c];
            for (unsigned int i = 0; i < 4; ++i)
              cell.vertices[i] = all[child[i]];
            fine.cells.push_back(cell);
            if (mesh.geometry != nullptr)
              add_nodes(*mesh.geometry, c, child, nodes);
          }
      }
    for (const CellData<2> &face : mesh.faces.boundary_quads)
      cut_face(face, middles, fine.faces);
    if (mesh.geometry != nullptr)
      fine.geometry = std::make_shared<CoarseGeometry>(10, nodes);
    return fine;
  }
} // namespace mortise
