#include <deal.II/base/quadrature_lib.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/cells/load_kernel.h>
#include <mortise/operators/cells/lobatto_table.h>

namespace mortise
{
  using namespace dealii;

  struct LoadKernel::Hexahedra
  {
    Hexahedra(const Body &body, const unsigned int degree)
      : rule(degree + 1)
      , geometry(body, ReferenceCells::Hexahedron, rule)
      , table(lobatto_table(degree, rule.get_tensor_basis()[0]))
      , line(transposed(table.values))
      , slope(transposed(table.slopes))
      , modes(cell_dof_indices(degree))
    {}

    const QGauss<dim>               rule;
    CellGeometry                    geometry;
    const LineTable                 table;
    const FullMatrix<double>        line, slope; ///< (function, point)
    const std::vector<unsigned int> modes;
  };

  LoadKernel::LoadKernel(const Body &body, const FiniteElement<dim> &system)
    : body(body)
    , system(system)
    , load(system.n_dofs_per_cell())
  {
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < system.base_element(0).n_dofs_per_cell();
           ++i)
        system_index[c].push_back(system.component_to_system_index(c, i));
  }

  LoadKernel::~LoadKernel() = default;

  const dealii::Vector<double> &
  LoadKernel::compute(const Body::CellIterator &cell, const Loads &loads)
  {
    load = 0.;
    if (loads.body_force || loads.thermal_strain)
      {
        if (body.mesh.tetrahedra)
          add_to_tetrahedron(cell, loads);
        else
          add_to_hexahedron(cell, loads);
      }
    if (cell->at_boundary())
      for (const unsigned int f : cell->face_indices())
        for (const TractionCondition &condition : loads.tractions)
          if (cell->face(f)->at_boundary() &&
              cell->face(f)->boundary_id() == condition.boundary)
            add_traction(cell, f, condition);
    return load;
  }

  void
  LoadKernel::add_to_hexahedron(const Body::CellIterator &cell,
                                const Loads              &loads)
  {
    if (!hexahedra)
      hexahedra = std::make_unique<Hexahedra>(body, system.degree);
    const auto        &points    = hexahedra->geometry.points(cell);
    const auto        &jacobians = hexahedra->geometry.jacobians(cell);
    const auto        &line      = hexahedra->line;
    const unsigned int n         = line.n();
    const TensorArray  zero{{{n, n, n}}, std::vector<double>(points.size())};
    const auto         weight = [&](const unsigned int q) {
      return determinant(jacobians[q]) * hexahedra->rule.weight(q);
    };
    const auto add = [&](const unsigned int c, const TensorArray &sums) {
      for (unsigned int i = 0; i < sums.values.size(); ++i)
        load(system_index[c][hexahedra->modes[i]]) += sums.values[i];
    };
    if (loads.body_force)
      {
        std::array<TensorArray, dim> forces{{zero, zero, zero}};
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            const Tensor<1, dim> force =
              loads.body_force(points[q]) * weight(q);
            for (unsigned int c = 0; c < dim; ++c)
              forces[c].values[q] = force[c];
          }
        for (unsigned int c = 0; c < dim; ++c)
          add(c, apply_product(line, line, line, forces[c]));
      }
    if (loads.thermal_strain)
      {
        std::array<std::array<TensorArray, dim>, dim> stresses;
        for (auto &row : stresses)
          row = {{zero, zero, zero}};
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            // jacobians are dx_c / dxi_a as [a][c]
            const Tensor<2, dim> stress = thermal_stress(loads, points[q]) *
                                          invert(jacobians[q]) * weight(q);
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int a = 0; a < dim; ++a)
                stresses[c][a].values[q] = -stress[c][a];
          }
        const auto &slope = hexahedra->slope;
        for (unsigned int c = 0; c < dim; ++c)
          {
            add(c, apply_product(slope, line, line, stresses[c][0]));
            add(c, apply_product(line, slope, line, stresses[c][1]));
            add(c, apply_product(line, line, slope, stresses[c][2]));
          }
      }
  }

  Tensor<2, dim>
  LoadKernel::thermal_stress(const Loads &loads, const Point<dim> &x) const
  {
    return body.material.stress(-loads.thermal_strain(x) *
                                  Tensor<2, dim>(unit_symmetric_tensor<dim>()),
                                0.);
  }

  void
  LoadKernel::add_to_tetrahedron(const Body::CellIterator &cell,
                                 const Loads              &loads)
  {
    if (!tetrahedra)
      tetrahedra = std::make_unique<FEValues<dim>>(
        *body.mapping,
        system.base_element(0),
        simplex_quadrature<dim>(2 * system.degree + body.mapping_degree - 1),
        update_values | update_gradients | update_JxW_values |
          update_quadrature_points);
    tetrahedra->reinit(Triangulation<dim>::cell_iterator(cell));
    for (unsigned int q = 0; q < tetrahedra->n_quadrature_points; ++q)
      {
        const Point<dim> &x = tetrahedra->quadrature_point(q);
        Tensor<1, dim>    force;
        Tensor<2, dim>    stress;
        if (loads.body_force)
          force = loads.body_force(x) * tetrahedra->JxW(q);
        if (loads.thermal_strain)
          stress = thermal_stress(loads, x) * tetrahedra->JxW(q);
        for (unsigned int c = 0; c < dim; ++c)
          for (const unsigned int i : tetrahedra->dof_indices())
            load(system_index[c][i]) +=
              force[c] * tetrahedra->shape_value(i, q) -
              stress[c] * tetrahedra->shape_grad(i, q);
      }
  }

  void
  LoadKernel::add_traction(const Body::CellIterator &cell,
                           const unsigned int        f,
                           const TractionCondition  &condition)
  {
    if (!faces[f])
      faces[f] =
        std::make_unique<FaceValues>(body, cell, f, traction_points(system));
    FaceValues &face = *faces[f];
    face.reinit(cell);
    const auto &indices = face.indices();
    for (unsigned int q = 0; q < face.points.size(); ++q)
      {
        const Tensor<1, dim> force =
          condition.traction(face.points[q], face.normals[q]) * face.weights[q];
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int k = 0; k < indices.size(); ++k)
            load(system_index[c][indices[k]]) += force[c] * face.value(k, q);
      }
  }
} // namespace mortise
