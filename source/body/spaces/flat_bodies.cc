// See flat_bodies.h.
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_tools.h>

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
    /// (doc/flat_cells.md), in those of bodies that are treated like it then,
    /// and in all cells of either.
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
      if (!body.mesh.tetrahedra || body.max_degree() <= 2)
        for (const auto &cell : body.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              const double flatness = short_direction(cell).flatness;
              ++n_cells;
              n_flat += flatness >= in_half_of_cells ? 1 : 0;
              if (flatness < least_flat)
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
    hexahedral_places(const unsigned int degree)
    {
      std::vector<std::array<unsigned int, dim>> places;
      for (const unsigned int i :
           FETools::hierarchic_to_lexicographic_numbering<dim>(degree))
        places.push_back({{i % (degree + 1),
                           i / (degree + 1) % (degree + 1),
                           i / (degree + 1) / (degree + 1)}});
      return places;
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
        const auto             places = hexahedral_places(degree);
        values.reinit(places.size(), 8);
        for (unsigned int i = 0; i < places.size(); ++i)
          for (unsigned int v = 0; v < 8; ++v)
            {
              values(i, v) = 1.;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const double x = points.point(places[i][d])[0];
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

  std::vector<std::vector<unsigned int>>
  lines_across(const Body::CellIterator &cell, const unsigned int degree)
  {
    const unsigned int number = short_direction(cell).number;
    std::map<std::vector<unsigned int>, std::vector<unsigned int>> lines;
    if (cell->reference_cell() == ReferenceCells::Hexahedron)
      {
        const auto places = hexahedral_places(degree);
        for (unsigned int i = 0; i < places.size(); ++i)
          lines[{places[i][(number + 1) % dim], places[i][(number + 2) % dim]}]
            .push_back(i);
      }
    else
      {
        // the ends of the short edge are one vertex of the triangle that is
        // left
        const auto &ends = tetrahedron_lines;
        const auto  seen = [&](const unsigned int vertex) {
          return vertex == ends[number][1] ? ends[number][0] : vertex;
        };
        for (unsigned int v = 0; v < cell->n_vertices(); ++v)
          lines[{seen(v), seen(v)}].push_back(v);
        if (degree == 2)
          for (unsigned int l = 0; l < cell->n_lines(); ++l)
            {
              const auto [a, b] =
                std::minmax({seen(ends[l][0]), seen(ends[l][1])});
              lines[{a, b}].push_back(cell->n_vertices() + l);
            }
      }
    std::vector<std::vector<unsigned int>> result;
    for (auto &line : lines)
      result.push_back(std::move(line.second));
    return result;
  }
} // namespace mortise
