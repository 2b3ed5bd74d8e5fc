#include <deal.II/base/quadrature_lib.h>

#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/cells/cell_values.h>
#include <mortise/operators/cells/load_kernel.h>
#include <mortise/operators/scene_load.h>

#include <map>
#include <memory>

namespace mortise
{
  using namespace dealii;

  PrescribedValues
  prescribed_values(const AffineConstraints<double> &constraints)
  {
    PrescribedValues values;
    for (const auto &line : constraints.get_lines())
      if (line.inhomogeneity != 0.)
        values.emplace(line.index, line.inhomogeneity);
    return values;
  }

  void
  for_each_loaded_cell(
    const Body                                                &body,
    const Loads                                               &loads,
    const std::function<void(const Body::CellIterator &,
                             const dealii::Vector<double> &)> &visit)
  {
    std::map<unsigned int, std::unique_ptr<LoadKernel>> kernels;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() &&
          (loads.body_force || loads.thermal_strain ||
           (!loads.tractions.empty() && cell->at_boundary())))
        {
          auto &kernel = kernels[cell->active_fe_index()];
          if (!kernel)
            kernel = std::make_unique<LoadKernel>(body, cell->get_fe());
          visit(cell, kernel->compute(cell, loads));
        }
  }

  void
  for_each_expanding_cell(
    const Body                                                &body,
    const ThermalStrain                                       &strain,
    const std::function<void(const Body::CellIterator &,
                             const dealii::Vector<double> &)> &visit)
  {
    ValuesByElement<FEValues<dim>> functions(
      body,
      [&](const FiniteElement<dim> &element) -> Quadrature<dim> {
        if (body.mesh.tetrahedra)
          return simplex_quadrature<dim>(2 * element.degree +
                                         body.mapping_degree + 1);
        return QGauss<dim>(element.degree + 2);
      },
      update_values | update_JxW_values | update_quadrature_points);
    dealii::Vector<double> load;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto pressure_cell = body.pressure->cell(cell);
          auto      &values        = functions(pressure_cell);
          values.reinit(Triangulation<dim>::cell_iterator(pressure_cell));
          load.reinit(values.dofs_per_cell);
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const double dilation =
                3. * strain(values.quadrature_point(q)) * values.JxW(q);
              for (const unsigned int i : values.dof_indices())
                load(i) -= dilation * values.shape_value(i, q);
            }
          visit(cell, load);
        }
  }
} // namespace mortise
