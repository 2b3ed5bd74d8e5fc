#include <mortise/output/lagrange_cells.h>

#include <map>
#include <utility>

namespace mortise
{
  namespace
  {
    using Node  = std::array<unsigned int, 3>;
    using Nodes = std::vector<Node>;

    /// Barycentric coordinates times the degree.
    using Barycentric = std::array<unsigned int, 4>;

    Barycentric
    operator+(const Barycentric &a, const Barycentric &b)
    {
      return {{a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]}};
    }

    Barycentric
    operator*(const unsigned int n, const Barycentric &a)
    {
      return {{n * a[0], n * a[1], n * a[2], n * a[3]}};
    }

    /// The unit of each corner.
    constexpr std::array<Barycentric, 4> unit = {
      {{{1, 0, 0, 0}}, {{0, 1, 0, 0}}, {{0, 0, 1, 0}}, {{0, 0, 0, 1}}}};

    /// Nodes between two corners, counted from the first.
    void
    add_edge(const unsigned int        n,
             const unsigned int        from,
             const unsigned int        to,
             const Barycentric        &origin,
             std::vector<Barycentric> &nodes)
    {
      for (unsigned int i = 1; i < n; ++i)
        nodes.push_back(origin + (n - i) * unit[from] + i * unit[to]);
    }

    /// A triangle of degree @p n: corners, edges, and a triangle of degree n - 3
    /// inside.
    void
    add_triangle(const unsigned int                 n,
                 const std::array<unsigned int, 3> &corners,
                 const Barycentric                 &origin,
                 std::vector<Barycentric>          &nodes)
    {
      if (n == 0)
        {
          nodes.push_back(origin);
          return;
        }
      for (const unsigned int v : corners)
        nodes.push_back(origin + n * unit[v]);
      for (unsigned int e = 0; e < 3; ++e)
        add_edge(n, corners[e], corners[(e + 1) % 3], origin, nodes);
      if (n > 2)
        add_triangle(n - 3,
                     corners,
                     origin + unit[corners[0]] + unit[corners[1]] +
                       unit[corners[2]],
                     nodes);
    }

    /// The same for a tetrahedron, with one of degree n - 4 inside.
    void
    add_tetrahedron(const unsigned int        n,
                    const Barycentric        &origin,
                    std::vector<Barycentric> &nodes)
    {
      constexpr unsigned int edges[6][2] = {
        {0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
      constexpr std::array<std::array<unsigned int, 3>, 4> faces = {
        {{{0, 1, 3}}, {{2, 3, 1}}, {{0, 3, 2}}, {{0, 2, 1}}}};
      if (n == 0)
        {
          nodes.push_back(origin);
          return;
        }
      for (const Barycentric &corner : unit)
        nodes.push_back(origin + n * corner);
      for (const auto &[from, to] : edges)
        add_edge(n, from, to, origin, nodes);
      for (const auto &face : faces)
        if (n > 2)
          add_triangle(n - 3,
                       face,
                       origin + unit[face[0]] + unit[face[1]] + unit[face[2]],
                       nodes);
      if (n > 3)
        add_tetrahedron(n - 4,
                        origin + unit[0] + unit[1] + unit[2] + unit[3],
                        nodes);
    }

    Nodes
    simplex_nodes_of(const bool tetrahedron, const unsigned int n)
    {
      std::vector<Barycentric> all;
      if (tetrahedron)
        add_tetrahedron(n, {}, all);
      else
        add_triangle(n, {{0, 1, 2}}, {}, all);
      Nodes nodes;
      for (const Barycentric &b : all)
        nodes.push_back({{b[1], b[2], b[3]}});
      return nodes;
    }

    /// The corners and edges of a square of degree @p n, around it; edges run
    /// along their axis.
    void
    add_square_corners(const unsigned int n, const unsigned int k, Nodes &nodes)
    {
      nodes.insert(nodes.end(),
                   {{{0, 0, k}}, {{n, 0, k}}, {{n, n, k}}, {{0, n, k}}});
    }

    void
    add_square_edges(const unsigned int n, const unsigned int k, Nodes &nodes)
    {
      for (const bool far : {false, true})
        {
          for (unsigned int i = 1; i < n; ++i)
            nodes.push_back({{i, far ? n : 0, k}});
          for (unsigned int j = 1; j < n; ++j)
            nodes.push_back({{far ? 0 : n, j, k}});
        }
    }

    Nodes
    quadrilateral_nodes(const unsigned int n)
    {
      Nodes nodes;
      add_square_corners(n, 0, nodes);
      add_square_edges(n, 0, nodes);
      for (unsigned int j = 1; j < n; ++j)
        for (unsigned int i = 1; i < n; ++i)
          nodes.push_back({{i, j, 0}});
      return nodes;
    }

    Nodes
    hexahedron_nodes(const unsigned int n)
    {
      Nodes nodes;
      for (const unsigned int k : {0u, n})
        add_square_corners(n, k, nodes);
      for (const unsigned int k : {0u, n})
        add_square_edges(n, k, nodes);
      for (const unsigned int j : {0u, n})
        for (const unsigned int i : {0u, n})
          for (unsigned int k = 1; k < n; ++k)
            nodes.push_back({{i, j, k}});
      for (unsigned int across = 0; across < 3; ++across)
        for (const unsigned int at : {0u, n})
          for (unsigned int j = 1; j < n; ++j)
            for (unsigned int i = 1; i < n; ++i)
              {
                Node node;
                node[across]              = at;
                node[across == 0 ? 1 : 0] = i;
                node[across == 2 ? 1 : 2] = j;
                nodes.push_back(node);
              }
      for (unsigned int k = 1; k < n; ++k)
        for (unsigned int j = 1; j < n; ++j)
          for (unsigned int i = 1; i < n; ++i)
            nodes.push_back({{i, j, k}});
      return nodes;
    }
  } // namespace

  const std::vector<std::array<unsigned int, 3>> &
  lagrange_nodes(const LagrangeShape shape, const unsigned int degree)
  {
    static std::map<std::pair<LagrangeShape, unsigned int>, Nodes> all;
    Nodes &nodes = all[{shape, degree}];
    if (nodes.empty())
      switch (shape)
        {
          case LagrangeShape::triangle:
          case LagrangeShape::tetrahedron:
            nodes =
              simplex_nodes_of(shape == LagrangeShape::tetrahedron, degree);
            break;
          case LagrangeShape::quadrilateral:
            nodes = quadrilateral_nodes(degree);
            break;
          case LagrangeShape::hexahedron:
            nodes = hexahedron_nodes(degree);
            break;
        }
    return nodes;
  }

  unsigned int
  vtk_type(const LagrangeShape shape, const unsigned int degree)
  {
    switch (shape)
      {
        case LagrangeShape::triangle:
          return degree > 1 ? 69 : 5;
        case LagrangeShape::quadrilateral:
          return degree > 1 ? 70 : 9;
        case LagrangeShape::tetrahedron:
          return degree > 1 ? 71 : 10;
        default:
          return degree > 1 ? 72 : 12;
      }
  }
} // namespace mortise
