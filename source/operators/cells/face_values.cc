#include <deal.II/base/quadrature_lib.h>

#include <mortise/body/elements/cell_face.h>
#include <mortise/body/elements/face_topology.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/body/mesh/vertex_order.h>
#include <mortise/operators/cells/face_values.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    Point<dim>
    corner(const unsigned int f, const unsigned int i)
    {
      return ReferenceCells::Tetrahedron.vertex<dim>(tetrahedron_faces[f][i]);
    }

    /// Two edges of the reference face, their cross product pointing outwards.
    std::array<Tensor<1, dim>, 2>
    reference_edges(const bool simplex, const unsigned int f)
    {
      std::array<Tensor<1, dim>, 2> along;
      bool                          outwards = false;
      if (simplex)
        {
          along[0] = corner(f, 1) - corner(f, 0);
          along[1] = corner(f, 2) - corner(f, 0);
          outwards =
            cross_product_3d(along[0], along[1]) *
              (corner(f, 0) - ReferenceCells::Tetrahedron.barycenter<dim>()) >
            0.;
        }
      else
        {
          along[0][face_topology::direction(f, 0)] = 1.;
          along[1][face_topology::direction(f, 1)] = 1.;
          outwards = face_topology::outward_sign(f) > 0.;
        }
      if (!outwards)
        std::swap(along[0], along[1]);
      return along;
    }
  } // namespace

  Quadrature<dim>
  face_rule(const FiniteElement<dim> &element,
            const unsigned int        f,
            const unsigned int        n)
  {
    if (element.reference_cell() == ReferenceCells::Hexahedron)
      {
        std::array<Quadrature<1>, dim> lines;
        lines.fill(QGauss<1>(n));
        lines[f / 2] = Quadrature<1>(Point<1>(f % 2));
        return QAnisotropic<dim>(lines[0], lines[1], lines[2]);
      }
    const auto              plane = gauss_quadrature<dim - 1>(element, n);
    std::vector<Point<dim>> points;
    for (const Point<dim - 1> &xi : plane.get_points())
      points.push_back(corner(f, 0) + xi[0] * (corner(f, 1) - corner(f, 0)) +
                       xi[1] * (corner(f, 2) - corner(f, 0)));
    return Quadrature<dim>(points, plane.get_weights());
  }

  FaceGeometry::FaceGeometry(const Body            &body,
                             const unsigned int     f,
                             const Quadrature<dim> &rule)
    : geometry(body,
               body.mesh.tetrahedra ? ReferenceCells::Tetrahedron :
                                      ReferenceCells::Hexahedron,
               rule)
    , reference_weights(rule.get_weights())
    , along(reference_edges(body.mesh.tetrahedra, f))
  {}

  void
  FaceGeometry::reinit(const Body::CellIterator &cell)
  {
    points                = geometry.points(cell);
    const auto &jacobians = geometry.jacobians(cell);
    normals.resize(points.size());
    weights.resize(points.size());
    tangents.resize(points.size());
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        tangents[q] = {{along[0] * jacobians[q], along[1] * jacobians[q]}};
        const Tensor<1, dim> area =
          cross_product_3d(tangents[q][0], tangents[q][1]);
        normals[q] = area / area.norm();
        weights[q] = reference_weights[q] * area.norm();
      }
  }

  FaceValues::FaceValues(const Body               &body,
                         const Body::CellIterator &cell,
                         const unsigned int        f,
                         const unsigned int        n)
    : FaceValues(body, cell, f, face_rule(cell->get_fe(), f, n))
  {}

  FaceValues::FaceValues(const Body               &body,
                         const Body::CellIterator &cell,
                         const unsigned int        f,
                         const Quadrature<dim>    &rule)
    : FaceGeometry(body, f, rule)
    , functions(CellFace(cell, f).indices)
  {
    const auto &element = cell->get_fe().base_element(0);
    for (const Point<dim> &point : rule.get_points())
      for (const unsigned int i : functions)
        values.push_back(element.shape_value(i, point));
  }
} // namespace mortise
