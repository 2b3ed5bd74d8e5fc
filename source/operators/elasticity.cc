#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/base/error.h>
#include <mortise/body/simplex_quadrature.h>
#include <mortise/operators/cell_kernel.h>
#include <mortise/operators/elasticity.h>
#include <mortise/operators/element_schur.h>
#include <mortise/operators/face_values.h>
#include <mortise/operators/matrix_scatter.h>
#include <mortise/operators/pressure_kernel.h>
#include <mortise/operators/pressure_scatter.h>

#include <array>
#include <cmath>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::vector<types::global_dof_index>
    scene_dofs(const Body               &body,
               const Body::CellIterator &cell,
               const FieldNumbering     &numbering)
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

      FaceValues &
      face_values(const Body::CellIterator &cell, const unsigned int f)
      {
        if (!faces[f])
          faces[f] =
            std::make_unique<FaceValues>(body, cell, f, system.degree + 2);
        faces[f]->reinit(cell);
        return *faces[f];
      }

      const Body                                &body;
      const FiniteElement<dim>                  &system;
      std::array<std::vector<unsigned int>, dim> system_index;
      dealii::Vector<double>                     load;

    private:
      std::unique_ptr<FEValues<dim>>             cell;
      std::array<std::unique_ptr<FaceValues>, 6> faces;
    };

    struct Kernel : LoadKernel
    {
      Kernel(const Body &body, const FiniteElement<dim> &system)
        : LoadKernel(body, system)
        , stiffness(body, system)
        , matrix(system.n_dofs_per_cell())
      {}

      CellKernel                      stiffness;
      FullMatrix<double>              matrix;
      std::unique_ptr<PressureKernel> pressure; ///< in mixed form
      PressureBlocks                  blocks;
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
              const FaceValues &face    = kernel.face_values(cell, f);
              const auto       &indices = face.indices();
              for (unsigned int q = 0; q < face.points.size(); ++q)
                {
                  const Tensor<1, dim> force =
                    condition.traction(face.points[q], face.normals[q]) *
                    face.weights[q];
                  for (unsigned int c = 0; c < dim; ++c)
                    for (unsigned int k = 0; k < indices.size(); ++k)
                      kernel.load(kernel.system_index[c][indices[k]]) +=
                        force[c] * face.value(k, q);
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

    /// Which displacements of the boundary of a cell are not prescribed.
    std::vector<unsigned int>
    not_prescribed(const AffineConstraints<double>            &constraints,
                   const std::vector<types::global_dof_index> &dofs,
                   const FiniteElement<dim>                   &system)
    {
      std::vector<unsigned int> free;
      for (unsigned int i = 0; i < system.get_first_hex_index(); ++i)
        if (const auto *entries = constraints.get_constraint_entries(dofs[i]);
            entries == nullptr || !entries->empty())
          free.push_back(i);
      return free;
    }

    /// [K G^T; G -C] and the load of a cell: displacements of its boundary, all
    /// pressures, displacements of its interior.
    std::pair<FullMatrix<double>, dealii::Vector<double>>
    mixed_cell(const Kernel &kernel)
    {
      const unsigned int n_b      = kernel.system.get_first_hex_index(),
                         n_u      = kernel.matrix.m(),
                         n_p      = kernel.pressure->mass().m();
      const FullMatrix<double> &G = kernel.pressure->divergence(),
                               &M = kernel.pressure->mass();
      const double c              = kernel.body.material.compressibility();
      const auto   place          = [&](const unsigned int i) {
        return i < n_b ? i : i + n_p;
      };
      FullMatrix<double>     all(n_u + n_p);
      dealii::Vector<double> load(n_u + n_p);
      for (unsigned int i = 0; i < n_u; ++i)
        {
          load(place(i)) = kernel.load(i);
          for (unsigned int j = 0; j < n_u; ++j)
            all(place(i), place(j)) = kernel.matrix(i, j);
          for (unsigned int k = 0; k < n_p; ++k)
            all(place(i), n_b + k) = all(n_b + k, place(i)) = G(k, i);
        }
      for (unsigned int k = 0; k < n_p; ++k)
        for (unsigned int l = 0; l < n_p; ++l)
          all(n_b + k, n_b + l) = -c * M(k, l);
      return {std::move(all), std::move(load)};
    }

    /// The same in mixed form: with what is eliminated counted last, the cell
    /// has the displacements of its boundary, its pressures, and the rest.
    void
    add_mixed(Kernel                                     &kernel,
              std::vector<types::global_dof_index>        dofs,
              const std::vector<types::global_dof_index> &pressures,
              const std::vector<unsigned int>            &free,
              CondensedInteriors                         &interiors,
              MatrixScatter                              &scatter,
              PressureScatter                            &pressure_scatter)
    {
      const unsigned int n_b = kernel.system.get_first_hex_index(),
                         n_p = pressures.size();
      auto [all, load]       = mixed_cell(kernel);
      for (unsigned int i = n_b; i < dofs.size(); ++i)
        scatter.add_diagonal(dofs[i], kernel.matrix(i, i));
      if (n_b < dofs.size() && !interiors.eliminate(all, load, n_b + n_p))
        throw std::runtime_error(
          "the stiffness of a cell's interior is not positive definite");
      dofs.resize(n_b);
      scatter.add(all, load, dofs);

      PressureBlocks &blocks = kernel.blocks;
      blocks.divergence.reinit(n_p, n_b);
      blocks.compliance.reinit(n_p, n_p);
      blocks.load.reinit(n_p);
      for (unsigned int k = 0; k < n_p; ++k)
        {
          for (unsigned int i = 0; i < n_b; ++i)
            blocks.divergence(k, i) = all(n_b + k, i);
          for (unsigned int l = 0; l < n_p; ++l)
            blocks.compliance(k, l) = -all(n_b + k, n_b + l);
          blocks.load(k) = load(n_b + k);
        }
      blocks.norm = kernel.pressure->mass();
      blocks.norm *= kernel.body.material.pressure_norm();
      if (free.size() < n_b)
        {
          blocks.norm *= regular_part;
          blocks.norm.add(1.,
                          element_schur(all, blocks.divergence, free),
                          1.,
                          blocks.compliance);
        }
      pressure_scatter.add(blocks, pressures, dofs);
    }
  } // namespace

  CondensedInteriors
  assemble_elasticity(const Body                      &body,
                      const Loads                     &loads,
                      const FieldNumbering            &numbering,
                      const AffineConstraints<double> &constraints,
                      SparseMatrix                    &stiffness,
                      Vector                          &load,
                      PressureScatter                 *pressures)
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
          const auto dofs = scene_dofs(body, cell, numbering);
          if (!body.pressure)
            add_condensed(*kernel, dofs, interiors, scatter);
          else
            {
              if (!kernel->pressure)
                kernel->pressure = std::make_unique<PressureKernel>(
                  body, cell->get_fe(), body.pressure->cell(cell)->get_fe());
              kernel->pressure->compute(cell);
              add_mixed(*kernel,
                        dofs,
                        pressures->dofs(body, cell),
                        not_prescribed(constraints, dofs, cell->get_fe()),
                        interiors,
                        scatter,
                        *pressures);
            }
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
