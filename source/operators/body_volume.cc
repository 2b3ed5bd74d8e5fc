#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/body_volume.h>
#include <mortise/operators/cells/cell_geometry.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  double
  body_volume(const Body &body)
  {
    // the determinant has degree 3 m - 1 along each axis of a hexahedron, and
    // 3 (m - 1) in all on a tetrahedron
    const unsigned int    m = body.mapping_degree;
    const Quadrature<dim> rule =
      body.mesh.tetrahedra ?
        simplex_quadrature<dim>(std::max(1u, 3 * (m - 1))) :
        Quadrature<dim>(QGauss<dim>((3 * m + 1) / 2));
    CellGeometry geometry(body,
                          body.mesh.tetrahedra ? ReferenceCells::Tetrahedron :
                                                 ReferenceCells::Hexahedron,
                          rule);
    const double reference_volume = body.mesh.tetrahedra ? 1. / 6. : 1.;
    double       volume           = 0.;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          if (const auto jacobian = geometry.constant_jacobian(cell))
            {
              volume += determinant(*jacobian) * reference_volume;
              continue;
            }
          const auto &jacobians = geometry.jacobians(cell);
          for (unsigned int q = 0; q < jacobians.size(); ++q)
            volume += determinant(jacobians[q]) * rule.weight(q);
        }
    return Utilities::MPI::sum(volume, body.triangulation().get_communicator());
  }
} // namespace mortise
