#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/body/mesh/mesh_measures.h>
#include <mortise/body/mesh/vertex_order.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh_file_parts.h"

namespace mortise
{
  using namespace dealii;

  void
  MeasureRange::add(const double value, const std::size_t cell)
  {
    if (value < least)
      {
        least      = value;
        least_cell = cell;
      }
    if (value > greatest)
      {
        greatest      = value;
        greatest_cell = cell;
      }
    sum += value;
    ++count;
  }

  namespace
  {
    /// Derivatives of the coordinates in cell @p c at @p unit, in rows.
    Tensor<2, 3>
    jacobian(const CoarseMesh &mesh, const std::size_t c, const Point<3> &unit)
    {
      if (mesh.geometry != nullptr)
        return mesh.geometry->jacobian(c, unit);
      const auto  &v = mesh.cells[c].vertices;
      Tensor<2, 3> result;
      for (unsigned int i = 0; i < v.size(); ++i)
        {
          Tensor<1, 3> slope;
          if (v.size() == 8)
            slope = GeometryInfo<3>::d_linear_shape_function_gradient(unit, i);
          else
            for (unsigned int d = 0; d < 3; ++d)
              slope[d] = i == 0 ? -1. : (i == d + 1 ? 1. : 0.);
          result += outer_product(Tensor<1, 3>(mesh.vertices[v[i]]), slope);
        }
      return result;
    }

    /// Local vertices of face @p f, three of which span it.
    std::vector<unsigned int>
    face_vertices(const bool hexahedron, const unsigned int f)
    {
      if (!hexahedron)
        return {std::begin(tetrahedron_faces[f]),
                std::end(tetrahedron_faces[f])};
      std::vector<unsigned int> vertices;
      for (unsigned int v = 0; v < 4; ++v)
        vertices.push_back(GeometryInfo<3>::face_to_cell_vertices(f, v));
      return vertices;
    }

    Point<3>
    unit_vertex(const bool hexahedron, const unsigned int v)
    {
      return hexahedron ? GeometryInfo<3>::unit_cell_vertex(v) :
                          Point<3>(v == 1, v == 2, v == 3);
    }

    std::vector<double>
    areas_of_faces(const CoarseMesh &mesh)
    {
      const bool          hexahedra = mesh.cells.front().vertices.size() == 8;
      const Quadrature<2> rule =
        hexahedra ? Quadrature<2>(QGauss<2>(4)) : simplex_quadrature<2>(8);
      std::map<std::vector<unsigned int>, std::size_t> places;
      const auto &faces = mesh.faces.boundary_quads;
      for (std::size_t i = 0; i < faces.size(); ++i)
        {
          auto key = faces[i].vertices;
          std::sort(key.begin(), key.end());
          places[key] = i;
        }
      std::vector<double> areas(faces.size(), 0.);
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (unsigned int f = 0; f < (hexahedra ? 6 : 4); ++f)
          {
            const auto                local = face_vertices(hexahedra, f);
            std::vector<unsigned int> key;
            for (const unsigned int v : local)
              key.push_back(mesh.cells[c].vertices[v]);
            std::sort(key.begin(), key.end());
            const auto place = places.find(key);
            if (place == places.end())
              continue;
            const Point<3>     origin = unit_vertex(hexahedra, local[0]);
            const Tensor<1, 3> s = unit_vertex(hexahedra, local[1]) - origin;
            const Tensor<1, 3> t = unit_vertex(hexahedra, local[2]) - origin;
            for (unsigned int q = 0; q < rule.size(); ++q)
              {
                const Tensor<2, 3> J = jacobian(mesh,
                                                c,
                                                origin + rule.point(q)[0] * s +
                                                  rule.point(q)[1] * t);
                areas[place->second] +=
                  rule.weight(q) * cross_product_3d(J * s, J * t).norm();
              }
          }
      return areas;
    }

    double
    scaled_jacobian(const CoarseMesh &mesh, const std::size_t c)
    {
      const auto &v     = mesh.cells[c].vertices;
      const bool  cube  = v.size() == 8;
      double      least = std::numeric_limits<double>::max();
      // of a tetrahedron the determinant is the same at all vertices
      for (unsigned int corner = 0; corner < v.size(); ++corner)
        {
          std::array<Tensor<1, 3>, 3> edges;
          for (unsigned int d = 0; d < 3; ++d)
            edges[d] = cube ? mesh.vertices[v[corner | (1 << d)]] -
                                mesh.vertices[v[corner & ~(1 << d)]] :
                              mesh.vertices[v[d < corner ? d : d + 1]] -
                                mesh.vertices[v[corner]];
          const double lengths =
            edges[0].norm() * edges[1].norm() * edges[2].norm();
          const double sign = !cube && corner % 2 == 1 ? -1. : 1.;
          const double value =
            lengths > 0. ?
              sign * cross_product_3d(edges[0], edges[1]) * edges[2] / lengths :
              0.;
          least = std::min(least, value);
        }
      return cube ? least : std::sqrt(2.) * least;
    }
  } // namespace

  MeshMeasures
  measure(const CoarseMesh &mesh)
  {
    const bool          hexahedra = mesh.cells.front().vertices.size() == 8;
    const Quadrature<3> rule =
      hexahedra ? Quadrature<3>(QGauss<3>(3)) : simplex_quadrature<3>(4);
    MeshMeasures measures;
    measures.areas = areas_of_faces(mesh);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        double volume = 0.;
        for (unsigned int q = 0; q < rule.size(); ++q)
          volume +=
            rule.weight(q) * determinant(jacobian(mesh, c, rule.point(q)));
        measures.volumes.push_back(volume);
        MeasureRange edges;
        for (const auto &[v, w] : cell_edges(mesh.cells[c].vertices))
          {
            const double length = mesh.vertices[v].distance(mesh.vertices[w]);
            edges.add(length, c);
            measures.edges.add(length, c);
          }
        measures.edge_ratios.add(edges.greatest / edges.least, c);
        measures.scaled_jacobians.add(scaled_jacobian(mesh, c), c);
      }
    return measures;
  }
} // namespace mortise
