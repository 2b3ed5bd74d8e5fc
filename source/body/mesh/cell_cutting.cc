#include <mortise/body/mesh/cell_cutting.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Faces = std::vector<std::vector<unsigned int>>;

    /// Vertices around each face of gmsh's cell, seen from outside.
    const Faces &
    faces_of(const std::size_t n_vertices)
    {
      static const Faces tetrahedron = {{0, 2, 1},
                                        {0, 1, 3},
                                        {0, 3, 2},
                                        {1, 2, 3}};
      static const Faces pyramid     = {
        {0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
      static const Faces wedge = {
        {0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
      static const Faces hexahedron = {{3, 0, 4, 7},
                                       {1, 2, 6, 5},
                                       {0, 1, 5, 4},
                                       {2, 3, 7, 6},
                                       {0, 3, 2, 1},
                                       {4, 5, 6, 7}};
      return n_vertices == 4 ? tetrahedron :
             n_vertices == 5 ? pyramid :
             n_vertices == 6 ? wedge :
                               hexahedron;
    }

    /// Places of the nodes of a tetrahedron of @p order 1 or 2.
    std::vector<Point<3>>
    tetrahedron_nodes(const unsigned int order)
    {
      std::vector<Point<3>> nodes = {Point<3>(),
                                     Point<3>(1., 0., 0.),
                                     Point<3>(0., 1., 0.),
                                     Point<3>(0., 0., 1.)};
      for (unsigned int a = 0; a < 4 && order == 2; ++a)
        for (unsigned int b = a + 1; b < 4; ++b)
          nodes.push_back(nodes[a] + (nodes[b] - nodes[a]) / 2.);
      return nodes;
    }

    class ModelCutter
    {
    public:
      explicit ModelCutter(const GmshModel &model)
        : result(model)
      {}

      GmshModel
      cut()
      {
        for (GmshElements &block : result.elements)
          if (block.n_vertices != block.dimension + 1 && block.order <= 2)
            block = block.dimension == 2 ? triangles(block) : tetrahedra(block);
        return std::move(result);
      }

    private:
      static GmshElements
      triangles(const GmshElements &quadrilaterals)
      {
        GmshElements parts = quadrilaterals;
        parts.n_vertices   = 3;
        parts.order        = 1;
        parts.type         = "Triangle 3";
        parts.reference.resize(3);
        parts.nodes.clear();
        parts.tags.clear();
        for (std::size_t e = 0; e < quadrilaterals.size(); ++e)
          {
            const unsigned int *nodes =
              &quadrilaterals.nodes[e * quadrilaterals.reference.size()];
            for (const auto &triangle :
                 cut_quadrilateral({{nodes[0], nodes[1], nodes[2], nodes[3]}}))
              {
                for (const unsigned int v : triangle)
                  parts.nodes.push_back(nodes[v]);
                parts.tags.push_back(quadrilaterals.tags[e]);
              }
          }
        return parts;
      }

      GmshElements
      tetrahedra(const GmshElements &cells)
      {
        GmshElements parts = cells;
        parts.n_vertices   = 4;
        parts.type      = cells.order == 1 ? "Tetrahedron 4" : "Tetrahedron 10";
        parts.reference = tetrahedron_nodes(cells.order);
        parts.nodes.clear();
        parts.tags.clear();
        for (std::size_t e = 0; e < cells.size(); ++e)
          {
            const auto first = cells.nodes.begin() + e * cells.reference.size();
            for (const auto &vertices :
                 cut_cell({first, first + cells.n_vertices}))
              {
                for (const unsigned int v : vertices)
                  parts.nodes.push_back(first[v]);
                for (unsigned int a = 0; a < 4 && cells.order == 2; ++a)
                  for (unsigned int b = a + 1; b < 4; ++b)
                    parts.nodes.push_back(
                      middle(cells, e, vertices[a], vertices[b]));
                parts.tags.push_back(cells.tags[e]);
              }
          }
        return parts;
      }

      /// Local node halfway between the vertices @p a and @p b, or the number of
      /// nodes if there is none.
      static unsigned int
      node_between(const GmshElements &cells,
                   const unsigned int  a,
                   const unsigned int  b)
      {
        const auto    &x    = cells.reference;
        const Point<3> half = x[a] + (x[b] - x[a]) / 2.;
        const auto     at   = [&half](const Point<3> &node) {
          return node.distance(half) < 1e-8;
        };
        return std::find_if(x.begin() + cells.n_vertices, x.end(), at) -
               x.begin();
      }

      /// The node in the middle of two vertices of cell @p e, a new one on a
      /// diagonal of serendipity elements.
      unsigned int
      middle(const GmshElements &cells,
             const std::size_t   e,
             const unsigned int  a,
             const unsigned int  b)
      {
        const unsigned int  n     = cells.reference.size();
        const unsigned int *nodes = &cells.nodes[e * n];
        const unsigned int  there = node_between(cells, a, b);
        if (there < n)
          return nodes[there];
        const auto [place, is_new] =
          middles.emplace(std::minmax(nodes[a], nodes[b]), result.nodes.size());
        if (is_new)
          {
            result.nodes.push_back(serendipity_middle(cells, nodes, a, b));
            result.node_tags.push_back(0);
          }
        return place->second;
      }

      /// The middle of the face on which vertices @p a and @p b are opposite, or
      /// else of the hexahedron.
      Point<3>
      serendipity_middle(const GmshElements &cells,
                         const unsigned int *nodes,
                         const unsigned int  a,
                         const unsigned int  b) const
      {
        std::vector<unsigned int> corners;
        for (unsigned int v = 0; v < cells.n_vertices; ++v)
          corners.push_back(v);
        for (const std::vector<unsigned int> &face : faces_of(cells.n_vertices))
          if (std::count(face.begin(), face.end(), a) > 0 &&
              std::count(face.begin(), face.end(), b) > 0)
            corners = face;
        Tensor<1, 3> sum_of_corners, sum_of_middles;
        unsigned int n_middles = 0;
        for (unsigned int i = 0; i < corners.size(); ++i)
          {
            sum_of_corners += result.nodes[nodes[corners[i]]];
            for (unsigned int j = 0; j < i; ++j)
              {
                const unsigned int node =
                  node_between(cells, corners[i], corners[j]);
                if (node == cells.reference.size())
                  continue;
                sum_of_middles += result.nodes[nodes[node]];
                ++n_middles;
              }
          }
        // the functions of corners are -1/4 there, those of edges all the same
        const double weight = (1. + corners.size() / 4.) / n_middles;
        return Point<3>(weight * sum_of_middles - sum_of_corners / 4.);
      }

      GmshModel result;
      /// Middles of diagonals by the nodes at their ends.
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> middles;
    };
  } // namespace

  std::vector<unsigned int>
  around(std::vector<unsigned int> vertices)
  {
    for (std::size_t v = 2; v + 1 < vertices.size(); v += 4)
      std::swap(vertices[v], vertices[v + 1]);
    return vertices;
  }

  std::array<std::array<unsigned int, 3>, 2>
  cut_quadrilateral(const std::array<unsigned int, 4> &around)
  {
    const unsigned int v =
      std::min_element(around.begin(), around.end()) - around.begin();
    return {{{{v, (v + 1) % 4, (v + 2) % 4}}, {{v, (v + 2) % 4, (v + 3) % 4}}}};
  }

  std::vector<std::array<unsigned int, 4>>
  cut_cell(const std::vector<unsigned int> &vertices)
  {
    const unsigned int lowest =
      std::min_element(vertices.begin(), vertices.end()) - vertices.begin();
    std::vector<std::array<unsigned int, 4>> parts;
    for (const std::vector<unsigned int> &face : faces_of(vertices.size()))
      if (std::count(face.begin(), face.end(), lowest) == 0)
        {
          if (face.size() == 3)
            parts.push_back({{lowest, face[0], face[1], face[2]}});
          else
            for (const auto &t : cut_quadrilateral({{vertices[face[0]],
                                                     vertices[face[1]],
                                                     vertices[face[2]],
                                                     vertices[face[3]]}}))
              parts.push_back({{lowest, face[t[0]], face[t[1]], face[t[2]]}});
        }
    return parts;
  }

  GmshModel
  cut_into_tetrahedra(const GmshModel &model)
  {
    return ModelCutter(model).cut();
  }
} // namespace mortise
