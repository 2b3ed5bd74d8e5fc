// See flat_bodies.h.
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_tools.h>

#include <mortise/body/elements/simplex_basis.h>
#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/body/spaces/flat_bodies.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// How many times shorter the short direction is in half of the cells of a
    /// body from where on a scene is better solved like this
    /// (doc/measurements/flat_cells.md), in those of bodies that are treated
    /// like it then, and in all cells of either.
    constexpr double flat = 25., flat_beside = 6., least_flat = 5.;

    /// The short direction of a cell: of a hexahedron an axis of its reference
    /// cell; of a tetrahedron an edge.
    struct ShortDirection
    {
      unsigned int number = 0;
      double flatness = 0.; ///< by how much the next longer direction is longer
    };

    ShortDirection
    short_direction(const Body::CellIterator &cell)
    {
      std::vector<double> lengths;
      if (cell->reference_cell() == ReferenceCells::Hexahedron)
        {
          lengths.assign(dim, 0.);
          for (unsigned int v = 0; v < 8; ++v)
            for (unsigned int d = 0; d < dim; ++d)
              if ((v >> d & 1U) == 0)
                lengths[d] +=
                  cell->vertex(v).distance(cell->vertex(v | 1U << d)) / 4.;
        }
      else
        for (unsigned int l = 0; l < cell->n_lines(); ++l)
          lengths.push_back(
            cell->line(l)->vertex(0).distance(cell->line(l)->vertex(1)));
      ShortDirection result;
      result.number =
        std::min_element(lengths.begin(), lengths.end()) - lengths.begin();
      const double shortest  = lengths[result.number];
      lengths[result.number] = std::numeric_limits<double>::max();
      result.flatness =
        *std::min_element(lengths.begin(), lengths.end()) / shortest;
      return result;
    }

    bool
    is_flat(const Body &body, const double in_half_of_cells)
    {
      double n_cells = 0., n_flat = 0., n_others = 0.;
      // nodes of tetrahedra that lie on no line need all those around them
      const unsigned int needed =
        body.mesh.tetrahedra && body.max_degree() > 2 ? body.max_degree() : 0;
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const double flatness = short_direction(cell).flatness;
            ++n_cells;
            n_flat += flatness >= in_half_of_cells ? 1 : 0;
            if (flatness < least_flat || body.degree(cell) < needed)
              {
                ++n_others;
                break; // one is enough: most scenes have no flat bodies
              }
          }
      const MPI_Comm comm = body.triangulation().get_communicator();
      return Utilities::MPI::sum(n_others, comm) == 0. &&
             Utilities::MPI::sum(2. * n_flat - n_cells, comm) > 0.;
    }

    /// Places in the cell of the nodes of hexahedra, as numbers of
    /// Gauss-Lobatto points along each axis, in the order of FE_Q.
    std::vector<std::array<unsigned int, dim>>
    hexahedral_positions(const unsigned int degree)
    {
      std::vector<std::array<unsigned int, dim>> positions;
      for (const unsigned int i :
           FETools::hierarchic_to_lexicographic_numbering<dim>(degree))
        positions.push_back({{i % (degree + 1),
                              i / (degree + 1) % (degree + 1),
                              i / (degree + 1) / (degree + 1)}});
      return positions;
    }

    NodesAcross
    hexahedral_lines(const unsigned int degree, const unsigned int axis)
    {
      const auto positions = hexahedral_positions(degree);
      std::map<std::array<unsigned int, 2>, std::vector<unsigned int>> lines;
      for (unsigned int i = 0; i < positions.size(); ++i)
        lines[{{positions[i][(axis + 1) % dim],
                positions[i][(axis + 2) % dim]}}]
          .push_back(i);
      NodesAcross result;
      for (auto &line : lines)
        result.lines.push_back(std::move(line.second));
      return result;
    }

    /// Barycentric coordinates in the triangle that is left where the vertices
    /// @p a and @p b become one, which is the first.
    std::array<double, 3>
    in_triangle(const std::array<double, 4> &lambda,
                const unsigned int           a,
                const unsigned int           b)
    {
      std::array<double, 3> result{{lambda[a] + lambda[b], 0., 0.}};
      unsigned int          next = 1;
      for (unsigned int v = 0; v < lambda.size(); ++v)
        if (v != a && v != b)
          result[next++] = lambda[v];
      return result;
    }

    /// P_p(triangle) + lambda_b P_(p - 1)(triangle) at a node.
    std::vector<double>
    functions_across(const unsigned int           degree,
                     const std::array<double, 4> &lambda,
                     const unsigned int           a,
                     const unsigned int           b)
    {
      const auto triangle = in_triangle(lambda, a, b);
      const auto size     = [](const unsigned int p) {
        return (p + 1) * (p + 2) / 2;
      };
      std::vector<double> values(size(degree) + size(degree - 1));
      const VertexOrder   order{{0, 1, 2, 3}};
      double             *at = values.data();
      SimplexLegendrePolynomials(degree, order).evaluate_trace(triangle, at);
      at += size(degree);
      SimplexLegendrePolynomials(degree - 1, order)
        .evaluate_trace(triangle, at);
      for (; at != values.data() + values.size(); ++at)
        *at *= lambda[b];
      return values;
    }

    /// All by ascending vertices.
    NodesAcross
    tetrahedral_lines(const unsigned int degree,
                      const unsigned int a,
                      const unsigned int b)
    {
      NodesAcross result;
      // nodes of lines and faces are where others are in the triangle, unless
      // the short edge is one of several of the face
      std::map<std::array<long, 3>, std::vector<unsigned int>> lines;
      std::vector<unsigned int>                                given;
      const auto &nodes = simplex_nodes(degree);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        {
          const auto   lambda   = barycentric_coordinates(nodes[i]);
          const auto   triangle = in_triangle(lambda, a, b);
          const double other    = std::max(triangle[1], triangle[2]);
          const bool   between  = std::min(lambda[a], lambda[b]) > 1e-8;
          if (between && other > 1e-8)
            result.others.push_back({i, {}});
          else
            {
              std::array<long, 3> place;
              for (unsigned int k = 0; k < 3; ++k)
                place[k] = std::lround(1e8 * triangle[k]);
              lines[place].push_back(i);
              if (!between)
                given.push_back(i);
            }
        }
      for (auto &line : lines)
        result.lines.push_back(std::move(line.second));
      if (result.others.empty())
        return result;
      // as many values are given as there are functions
      FullMatrix<double> functions(given.size());
      for (unsigned int k = 0; k < given.size(); ++k)
        {
          const auto values = functions_across(
            degree, barycentric_coordinates(nodes[given[k]]), a, b);
          AssertDimension(values.size(), given.size());
          std::copy(values.begin(), values.end(), &functions(k, 0));
        }
      functions.gauss_jordan();
      for (auto &[node, entries] : result.others)
        {
          const auto values = functions_across(
            degree, barycentric_coordinates(nodes[node]), a, b);
          for (unsigned int k = 0; k < given.size(); ++k)
            {
              double weight = 0.;
              for (unsigned int j = 0; j < values.size(); ++j)
                weight += values[j] * functions(j, k);
              if (std::abs(weight) > 1e-12)
                entries.emplace_back(given[k], weight);
            }
        }
      return result;
    }
  } // namespace

  std::vector<bool>
  find_flat_bodies(const std::vector<const Body *> &bodies)
  {
    const auto is = [](const double flatness) {
      return [flatness](const Body *body) { return is_flat(*body, flatness); };
    };
    std::vector<bool> result(bodies.size());
    std::transform(bodies.begin(), bodies.end(), result.begin(), is(flat));
    if (std::find(result.begin(), result.end(), true) != result.end())
      std::transform(bodies.begin(),
                     bodies.end(),
                     result.begin(),
                     is(flat_beside));
    return result;
  }

  FullMatrix<double>
  linear_values(const Body::CellIterator &cell, const unsigned int degree)
  {
    FullMatrix<double> values;
    if (cell->reference_cell() == ReferenceCells::Hexahedron)
      {
        const QGaussLobatto<1> points(degree + 1);
        const auto             positions = hexahedral_positions(degree);
        values.reinit(positions.size(), 8);
        for (unsigned int i = 0; i < positions.size(); ++i)
          for (unsigned int v = 0; v < 8; ++v)
            {
              values(i, v) = 1.;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const double x = points.point(positions[i][d])[0];
                  values(i, v) *= (v >> d & 1U) == 1 ? x : 1. - x;
                }
            }
      }
    else
      {
        const VertexOrder order = vertex_order(cell);
        const auto       &nodes = simplex_nodes(degree);
        const auto        index = ascending_dof_indices(degree, order);
        values.reinit(nodes.size(), order.size());
        for (unsigned int i = 0; i < nodes.size(); ++i)
          for (unsigned int v = 0; v < order.size(); ++v)
            values(index[i], order[v]) = barycentric_coordinates(nodes[i])[v];
      }
    return values;
  }

  std::vector<Point<dim>>
  straight_positions(const Body::CellIterator &cell, const unsigned int degree)
  {
    const FullMatrix<double> &values = linear_values(cell, degree);
    std::vector<Point<dim>>   positions(values.m());
    for (unsigned int i = 0; i < positions.size(); ++i)
      for (const unsigned int v : cell->vertex_indices())
        positions[i] += values(i, v) * cell->vertex(v);
    return positions;
  }

  NodesAcross
  nodes_across(const Body::CellIterator &cell, const unsigned int degree)
  {
    const unsigned int number = short_direction(cell).number;
    if (cell->reference_cell() == ReferenceCells::Hexahedron)
      return hexahedral_lines(degree, number);
    const VertexOrder ranks = vertex_ranks(vertex_order(cell));
    const auto [a, b]       = std::minmax({ranks[tetrahedron_lines[number][0]],
                                           ranks[tetrahedron_lines[number][1]]});
    static std::map<std::array<unsigned int, 3>, NodesAcross> tables;
    NodesAcross &ascending = tables[{{degree, a, b}}];
    if (ascending.lines.empty())
      ascending = tetrahedral_lines(degree, a, b);
    const auto  index  = ascending_dof_indices(degree, vertex_order(cell));
    NodesAcross result = ascending;
    for (auto &line : result.lines)
      for (unsigned int &i : line)
        i = index[i];
    for (auto &[node, entries] : result.others)
      {
        node = index[node];
        for (auto &entry : entries)
          entry.first = index[entry.first];
      }
    return result;
  }
} // namespace mortise
