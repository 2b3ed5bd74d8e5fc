#include "simplex_blending.h"

#include <deal.II/grid/manifold.h>

#include <mortise/body/elements/fe_simplex_legendre.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Local vertices that have a part in a node.
    std::vector<unsigned int>
    parts_of(const Point<3> &node)
    {
      const auto                lambda = barycentric_coordinates(node);
      std::vector<unsigned int> parts;
      for (unsigned int v = 0; v < 4; ++v)
        if (lambda[v] > 1e-12)
          parts.push_back(v);
      return parts;
    }

    template <std::size_t n>
    bool
    is(const std::vector<unsigned int> &parts, const unsigned int (&entity)[n])
    {
      return parts.size() == n &&
             std::all_of(parts.begin(), parts.end(), [&](const unsigned int v) {
               return std::find(entity, entity + n, v) != entity + n;
             });
    }

    bool
    flat(const types::manifold_id id)
    {
      return id == numbers::flat_manifold_id;
    }

    /// The inverse of rows @p nodes and columns @p first ... of @p modes.
    FullMatrix<double>
    inverse_block(const FullMatrix<double>        &modes,
                  const std::vector<unsigned int> &nodes,
                  const unsigned int               first)
    {
      FullMatrix<double> block(nodes.size(), nodes.size()), inverse = block;
      for (unsigned int q = 0; q < nodes.size(); ++q)
        for (unsigned int k = 0; k < nodes.size(); ++k)
          block(q, k) = modes(nodes[q], first + k);
      if (!nodes.empty())
        inverse.invert(block);
      return inverse;
    }

    /// All entities of the cell have one manifold.
    bool
    uniform(const SimplexBlending::CellIterator &cell)
    {
      const auto id  = cell->manifold_id();
      bool       one = true;
      for (const unsigned int f : cell->face_indices())
        one = one && cell->face(f)->manifold_id() == id;
      for (const unsigned int l : cell->line_indices())
        one = one && cell->line(l)->manifold_id() == id;
      return one;
    }
  } // namespace

  SimplexBlending::SimplexBlending(const unsigned int degree)
    : degree(degree)
    , nodes(simplex_interpolation_points(degree))
  {}

  const SimplexBlending::Layout &
  SimplexBlending::layout(const VertexOrder &order)
  {
    const auto known = layouts.find(order);
    if (known != layouts.end())
      return known->second;
    Layout                          &result = layouts[order];
    const SimplexLegendrePolynomials modal(degree, order);
    result.modes.reinit(nodes.size(), modal.n());
    for (unsigned int q = 0; q < nodes.size(); ++q)
      {
        const std::vector<double> values = values_at(modal, nodes[q]);
        for (unsigned int i = 0; i < modal.n(); ++i)
          result.modes(q, i) = values[i];
        const auto parts = parts_of(nodes[q]);
        for (unsigned int l = 0; l < 6; ++l)
          if (is(parts, tetrahedron_lines[l]))
            result.line_nodes[l].push_back(q);
        for (unsigned int f = 0; f < 4; ++f)
          if (is(parts, tetrahedron_faces[f]))
            result.face_nodes[f].push_back(q);
        if (parts.size() == 4)
          result.inner_nodes.push_back(q);
      }
    for (unsigned int l = 0; l < 6; ++l)
      result.line_modes[l] = inverse_block(result.modes,
                                           result.line_nodes[l],
                                           4 + l * n_line_modes(degree));
    for (unsigned int f = 0; f < 4; ++f)
      {
        result.face_modes[f] = inverse_block(result.modes,
                                             result.face_nodes[f],
                                             4 + 6 * n_line_modes(degree) +
                                               f * n_face_modes(degree));
        // ascending, so that both cells ask a manifold the same question
        for (const unsigned int v : order)
          if (std::count(tetrahedron_faces[f], tetrahedron_faces[f] + 3, v) > 0)
            result.face_vertices[f].push_back(v);
        for (const auto &[i, j] : {std::make_pair(0, 1), {0, 2}, {1, 2}})
          for (unsigned int l = 0; l < 6; ++l)
            if (is({result.face_vertices[f][i], result.face_vertices[f][j]},
                   tetrahedron_lines[l]))
              result.face_lines[f].push_back(l);
        add_face_weights(result, f);
      }
    return result;
  }

  void
  SimplexBlending::add_face_weights(Layout            &layout,
                                    const unsigned int face) const
  {
    const unsigned int  n       = degree - 1; // nodes and modes of a line
    const auto         &own     = layout.face_nodes[face];
    FullMatrix<double> &weights = layout.face_weights[face];
    weights.reinit(own.size(), 3 + 3 * n);
    for (unsigned int q = 0; q < own.size(); ++q)
      {
        for (unsigned int v = 0; v < 3; ++v)
          weights(q, v) = layout.modes(own[q], layout.face_vertices[face][v]);
        for (unsigned int side = 0; side < 3; ++side)
          {
            const unsigned int line = layout.face_lines[face][side];
            for (unsigned int j = 0; j < n; ++j)
              {
                double weight = 0.;
                for (unsigned int k = 0; k < n; ++k)
                  weight += layout.modes(own[q], 4 + line * n + k) *
                            layout.line_modes[line](k, j);
                weights(q, 3 + side * n + j) = weight;
                // modes take what the vertices leave
                for (unsigned int v = 0; v < 3; ++v)
                  weights(q, v) -=
                    weight * layout.modes(layout.line_nodes[line][j],
                                          layout.face_vertices[face][v]);
              }
          }
      }
  }

  void
  SimplexBlending::bend_line(const CellIterator &cell,
                             const Layout       &layout,
                             const unsigned int  line)
  {
    const auto               &own = layout.line_nodes[line];
    const unsigned int        n   = own.size();
    std::vector<Tensor<1, 3>> off(n);
    for (unsigned int j = 0; j < n; ++j)
      {
        // ascending vertices; see face_vertices
        std::array<Point<3>, 2> ends;
        std::array<double, 2>   weights;
        const auto              lambda = barycentric_coordinates(nodes[own[j]]);
        unsigned int            i      = 0;
        for (const unsigned int v : vertex_order(cell))
          if (v == tetrahedron_lines[line][0] ||
              v == tetrahedron_lines[line][1])
            {
              ends[i]      = cell->vertex(v);
              weights[i++] = lambda[v];
            }
        off[j] = cell->line(line)->get_manifold().get_new_point(
                   make_array_view(ends.cbegin(), ends.cend()),
                   make_array_view(weights.cbegin(), weights.cend())) -
                 Point<3>(positions[own[j]]);
      }
    for (unsigned int k = 0; k < n; ++k)
      {
        Tensor<1, 3> mode;
        for (unsigned int j = 0; j < n; ++j)
          mode += layout.line_modes[line](k, j) * off[j];
        for (unsigned int q = 0; q < positions.size(); ++q)
          positions[q] += layout.modes(q, 4 + line * n + k) * mode;
      }
  }

  void
  SimplexBlending::bend_face(const CellIterator &cell,
                             const Layout       &layout,
                             const unsigned int  face)
  {
    const auto           &own     = layout.face_nodes[face];
    const bool            blended = !uniform(cell);
    std::vector<Point<3>> around;
    for (const unsigned int v : layout.face_vertices[face])
      around.push_back(cell->vertex(v));
    for (const unsigned int l : layout.face_lines[face])
      for (const unsigned int q : layout.line_nodes[l])
        if (blended)
          around.emplace_back(positions[q]);
    std::vector<Tensor<1, 3>> off(own.size());
    for (unsigned int j = 0; j < own.size(); ++j)
      {
        std::vector<double> weights(around.size());
        for (unsigned int i = 0; i < around.size(); ++i)
          weights[i] = blended ?
                         layout.face_weights[face](j, i) :
                         barycentric_coordinates(
                           nodes[own[j]])[layout.face_vertices[face][i]];
        off[j] = cell->face(face)->get_manifold().get_new_point(
                   make_array_view(around.cbegin(), around.cend()),
                   make_array_view(weights.cbegin(), weights.cend())) -
                 Point<3>(positions[own[j]]);
      }
    const unsigned int first =
      4 + 6 * n_line_modes(degree) + face * n_face_modes(degree);
    for (unsigned int k = 0; k < own.size(); ++k)
      {
        Tensor<1, 3> mode;
        for (unsigned int j = 0; j < own.size(); ++j)
          mode += layout.face_modes[face](k, j) * off[j];
        for (unsigned int q = 0; q < positions.size(); ++q)
          positions[q] += layout.modes(q, first + k) * mode;
      }
  }

  void
  SimplexBlending::bend_inside(const CellIterator &cell, const Layout &layout)
  {
    std::vector<Point<3>> vertices;
    for (const unsigned int v : vertex_order(cell))
      vertices.push_back(cell->vertex(v));
    for (const unsigned int q : layout.inner_nodes)
      {
        std::vector<double> weights;
        const auto          lambda = barycentric_coordinates(nodes[q]);
        for (const unsigned int v : vertex_order(cell))
          weights.push_back(lambda[v]);
        positions[q] = cell->get_manifold().get_new_point(
          make_array_view(vertices.cbegin(), vertices.cend()),
          make_array_view(weights.cbegin(), weights.cend()));
      }
  }

  std::vector<Point<3>>
  SimplexBlending::points(const CellIterator &cell)
  {
    const Layout &order = layout(vertex_order(cell));
    positions.assign(nodes.size(), Tensor<1, 3>());
    for (unsigned int q = 0; q < nodes.size(); ++q)
      for (unsigned int v = 0; v < 4; ++v)
        positions[q] += barycentric_coordinates(nodes[q])[v] * cell->vertex(v);

    for (unsigned int l = 0; l < 6; ++l)
      if (!flat(cell->line(l)->manifold_id()))
        bend_line(cell, order, l);
    for (unsigned int f = 0; f < 4; ++f)
      if (!flat(cell->face(f)->manifold_id()))
        bend_face(cell, order, f);
    if (!flat(cell->manifold_id()))
      bend_inside(cell, order);
    return std::vector<Point<3>>(positions.begin(), positions.end());
  }
} // namespace mortise
