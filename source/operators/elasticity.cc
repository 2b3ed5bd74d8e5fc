#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/base/error.h>
#include <mortise/body/simplex_quadrature.h>
#include <mortise/operators/cell_kernel.h>
#include <mortise/operators/elasticity.h>
#include <mortise/operators/matrix_scatter.h>

#include <array>
#include <cmath>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::vector<types::global_dof_index>
    scene_dofs(const Body                  &body,
               const Body::CellIterator    &cell,
               const DisplacementNumbering &numbering)
    {
      std::vector<types::global_dof_index> dofs(
        cell->get_fe().n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      for (auto &dof : dofs)
        dof = numbering(body.index, dof);
      return dofs;
    }

    Quadrature<dim>
    load_quadrature(const FiniteElement<dim> &element,
                    const unsigned int        mapping_degree)
    {
      if (element.reference_cell() == ReferenceCells::Hexahedron)
        return QGauss<dim>(element.degree + 1);
      return simplex_quadrature<dim>(2 * element.degree + mapping_degree - 1);
    }

    /// What the loads of the cells of one element share. Values are made when
    /// there are any.
    struct LoadKernel
    {
      LoadKernel(const Body &body, const FiniteElement<dim> &system)
        : body(body)
        , system(system)
        , load(system.n_dofs_per_cell())
      {
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int i = 0; i < element().n_dofs_per_cell(); ++i)
            system_index[c].push_back(system.component_to_system_index(c, i));
      }

      const FiniteElement<dim> &
      element() const ///< scalar
      {
        return system.base_element(0);
      }

      FEValues<dim> &
      cell_values()
      {
        if (!cell)
          cell = std::make_unique<FEValues<dim>>(
            *body.mapping,
            element(),
            load_quadrature(system, body.mapping_degree),
            update_values | update_JxW_values | update_quadrature_points);
        return *cell;
      }

      FEFaceValues<dim> &
      face_values()
      {
        if (!face)
          face = std::make_unique<FEFaceValues<dim>>(
            *body.mapping,
            element(),
            gauss_quadrature<dim - 1>(system, system.degree + 2),
            update_values | update_JxW_values | update_normal_vectors |
              update_quadrature_points);
        return *face;
      }

      const Body                                &body;
      const FiniteElement<dim>                  &system;
      std::array<std::vector<unsigned int>, dim> system_index;
      dealii::Vector<double>                     load;

    private:
      std::unique_ptr<FEValues<dim>>     cell;
      std::unique_ptr<FEFaceValues<dim>> face;
    };

    struct Kernel : LoadKernel
    {
      Kernel(const Body &body, const FiniteElement<dim> &system)
        : LoadKernel(body, system)
        , stiffness(body, system)
        , matrix(system.n_dofs_per_cell())
      {}

      CellKernel         stiffness;
      FullMatrix<double> matrix;
    };

    void
    add_body_force(const Body::CellIterator &cell,
                   const Loads              &loads,
                   LoadKernel               &kernel)
    {
      auto &values = kernel.cell_values();
      values.reinit(typename Triangulation<dim>::cell_iterator(cell));
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        {
          const Tensor<1, dim> force =
            loads.body_force(values.quadrature_point(q)) * values.JxW(q);
          for (unsigned int c = 0; c < dim; ++c)
            for (const unsigned int i : values.dof_indices())
              kernel.load(kernel.system_index[c][i]) +=
                force[c] * values.shape_value(i, q);
        }
    }

    void
    add_tractions(const Body::CellIterator &cell,
                  const Loads              &loads,
                  LoadKernel               &kernel)
    {
      if (!cell->at_boundary())
        return;
      for (const unsigned int f : cell->face_indices())
        for (const TractionCondition &condition : loads.tractions)
          if (cell->face(f)->at_boundary() &&
              cell->face(f)->boundary_id() == condition.boundary)
            {
              auto &values = kernel.face_values();
              values.reinit(typename Triangulation<dim>::cell_iterator(cell),
                            f);
              for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                {
                  const Tensor<1, dim> force =
                    condition.traction(values.quadrature_point(q),
                                       values.normal_vector(q)) *
                    values.JxW(q);
                  for (unsigned int c = 0; c < dim; ++c)
                    for (const unsigned int i : values.dof_indices())
                      kernel.load(kernel.system_index[c][i]) +=
                        force[c] * values.shape_value(i, q);
                }
            }
    }

    void
    compute_load(const Body::CellIterator &cell,
                 const Loads              &loads,
                 LoadKernel               &kernel)
    {
      kernel.load = 0.;
      if (loads.body_force)
        add_body_force(cell, loads, kernel);
      add_tractions(cell, loads, kernel);
    }

    /// Eliminate the interior of the cell and add the rest. Its own rows keep a
    /// diagonal of the same size and couple with nothing.
    void
    add_condensed(Kernel                              &kernel,
                  std::vector<types::global_dof_index> dofs,
                  CondensedInteriors                  &interiors,
                  MatrixScatter                       &scatter)
    {
      const unsigned int n_b = kernel.system.get_first_hex_index();
      if (n_b < dofs.size())
        {
          for (unsigned int i = n_b; i < dofs.size(); ++i)
            scatter.add_diagonal(dofs[i], kernel.matrix(i, i));
          if (!interiors.eliminate(kernel.matrix, kernel.load, n_b))
            throw std::runtime_error(
              "the stiffness of a cell's interior is not positive definite");
          dofs.resize(n_b);
        }
      scatter.add(kernel.matrix, kernel.load, dofs);
    }
  } // namespace

  CondensedInteriors
  assemble_elasticity(const Body                      &body,
                      const Loads                     &loads,
                      const DisplacementNumbering     &numbering,
                      const AffineConstraints<double> &constraints,
                      SparseMatrix                    &stiffness,
                      Vector                          &load)
  {
    std::map<unsigned int, std::unique_ptr<Kernel>> kernels;
    CondensedInteriors                              interiors;
    MatrixScatter scatter(constraints, stiffness, load);
    std::string   tangled;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          auto &kernel = kernels[cell->active_fe_index()];
          if (!kernel)
            kernel = std::make_unique<Kernel>(body, cell->get_fe());

          if (!kernel->stiffness.compute(cell, kernel->matrix))
            {
              tangled = tangled_message(body, cell);
              break;
            }
          compute_load(cell, loads, *kernel);
          add_condensed(*kernel,
                        scene_dofs(body, cell, numbering),
                        interiors,
                        scatter);
        }
    throw_if_any(tangled, body.triangulation().get_communicator());
    return interiors;
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
          (loads.body_force ||
           (!loads.tractions.empty() && cell->at_boundary())))
        {
          auto &kernel = kernels[cell->active_fe_index()];
          if (!kernel)
            kernel = std::make_unique<LoadKernel>(body, cell->get_fe());
          compute_load(cell, loads, *kernel);
          visit(cell, kernel->load);
        }
  }
} // namespace mortise
