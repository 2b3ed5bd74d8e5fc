#include <mortise/body/elements/cell_face.h>
#include <mortise/body/elements/face_topology.h>
#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/simplex_elements.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  CellFace::CellFace(const CellIterator &cell, const unsigned int face)
  {
    const FiniteElement<3> &fe = cell->get_fe();
    if (cell->reference_cell() == ReferenceCells::Hexahedron)
      {
        basis   = &trace_basis(FaceShape::quadrilateral, fe.degree);
        indices = face_dof_indices(fe.degree, face);
        for (unsigned int v = 0; v < 4; ++v)
          vertices[v] = face_topology::vertex(face, v % 2, v / 2);
        for (unsigned int e = 0; e < 4; ++e)
          lines[e] = face_topology::line(face, e / 2, e % 2);
        orientation = face_topology::outward_sign(face);
        origin      = face_topology::unit_point(face, 0., 0.);
        along[0]    = face_topology::unit_point(face, 1., 0.) - origin;
        along[1]    = face_topology::unit_point(face, 0., 1.) - origin;
        return;
      }

    const auto tetrahedron_vertex = [](const unsigned int v) {
      return ReferenceCells::Tetrahedron.vertex<3>(v);
    };
    const FE_SimplexLegendre &element = SimplexElements::base(fe);
    basis                = &trace_basis(FaceShape::triangle, fe.degree);
    indices              = trace_dof_indices(element, face);
    const auto ascending = ascending_face_vertices(element.order, face);
    std::copy(ascending.begin(), ascending.end(), vertices.begin());
    vertices[3] = lines[3] = numbers::invalid_unsigned_int;
    for (unsigned int e = 0; e < 3; ++e)
      {
        const auto ends = basis->edge_vertices(e);
        for (unsigned int l = 0; l < 6; ++l)
          if (std::minmax(tetrahedron_lines[l][0], tetrahedron_lines[l][1]) ==
              std::minmax(ascending[ends[0]], ascending[ends[1]]))
            lines[e] = l;
      }
    origin   = tetrahedron_vertex(ascending[0]);
    along[0] = tetrahedron_vertex(ascending[1]) - origin;
    along[1] = tetrahedron_vertex(ascending[2]) - origin;
    const unsigned int opposite =
      6 - ascending[0] - ascending[1] - ascending[2];
    orientation = cross_product_3d(along[0], along[1]) *
                        (origin - tetrahedron_vertex(opposite)) >
                      0. ?
                    1. :
                    -1.;
  }
} // namespace mortise
