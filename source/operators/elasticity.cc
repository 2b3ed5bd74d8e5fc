#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/base/error.h>
#include <mortise/body/simplex_quadrature.h>
#include <mortise/operators/elasticity.h>

#include <array>
#include <cmath>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Dofs of the cell without those of its interior, which come last.
    unsigned int
    n_boundary_dofs(const Body::CellIterator &cell)
    {
      return cell->get_fe().get_first_hex_index();
    }

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
    cell_quadrature(const FiniteElement<dim> &element,
                    const unsigned int        mapping_degree)
    {
      if (element.reference_cell() == ReferenceCells::Hexahedron)
        return QGauss<dim>(element.degree + 1);
      return simplex_quadrature<dim>(2 * element.degree + mapping_degree - 1);
    }

    Quadrature<dim - 1>
    face_quadrature(const FiniteElement<dim> &element)
    {
      if (element.reference_cell() == ReferenceCells::Hexahedron)
        return QGauss<dim - 1>(element.degree + 2);
      return simplex_quadrature<dim - 1>(2 * element.degree + 3);
    }

    /// What the cells of one element share. One scalar element serves the three
    /// components.
    struct Kernel
    {
      Kernel(const Mapping<dim>       &mapping,
             const FiniteElement<dim> &system,
             const unsigned int        mapping_degree)
        : element(system.base_element(0).clone())
        , n(element->n_dofs_per_cell())
        , cell_values(mapping,
                      *element,
                      cell_quadrature(*element, mapping_degree),
                      update_values | update_gradients | update_JxW_values |
                        update_quadrature_points)
        , face_values(mapping,
                      *element,
                      face_quadrature(*element),
                      update_values | update_JxW_values |
                        update_normal_vectors | update_quadrature_points)
        , matrix(dim * n)
        , load(dim * n)
      {
        for (unsigned int c = 0; c < dim; ++c)
          {
            scaled_gradients[c].reinit(cell_values.n_quadrature_points, n);
            for (unsigned int i = 0; i < n; ++i)
              system_index[c].push_back(system.component_to_system_index(c, i));
          }
        for (auto &row : products)
          for (auto &product : row)
            product.reinit(n, n);
      }

      std::unique_ptr<FiniteElement<dim>>        element; ///< scalar
      unsigned int                               n;
      FEValues<dim>                              cell_values;
      FEFaceValues<dim>                          face_values;
      std::array<std::vector<unsigned int>, dim> system_index;
      std::array<FullMatrix<double>, dim>
        scaled_gradients; ///< sqrt(w) dN_i/dx_c
      std::array<std::array<FullMatrix<double>, dim>, dim>
                             products; ///< int dN_i/dx_c dN_j/dx_d
      FullMatrix<double>     matrix;
      dealii::Vector<double> load;
      FullMatrix<double>     boundary_matrix; ///< without the interior
      dealii::Vector<double> boundary_load;
    };

    /// K_(ic)(jd) = lambda H_cd + mu H_dc + delta_cd mu sum_e H_ee with
    /// H_cd(i, j) = int dN_i/dx_c dN_j/dx_d. Returns whether all volumes are
    /// positive.
    bool
    compute_matrix(const LinearElastic &material, Kernel &kernel)
    {
      const auto &values = kernel.cell_values;
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        {
          if (!(values.JxW(q) > 0.))
            return false;
          const double root = std::sqrt(values.JxW(q));
          for (unsigned int i = 0; i < kernel.n; ++i)
            {
              const Tensor<1, dim> gradient = values.shape_grad(i, q);
              for (unsigned int c = 0; c < dim; ++c)
                kernel.scaled_gradients[c](q, i) = root * gradient[c];
            }
        }
      auto &H = kernel.products;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = c; d < dim; ++d)
          kernel.scaled_gradients[c].Tmmult(H[c][d],
                                            kernel.scaled_gradients[d]);

      const double lambda = material.lame_lambda(), mu = material.lame_mu();
      for (unsigned int i = 0; i < kernel.n; ++i)
        for (unsigned int j = 0; j < kernel.n; ++j)
          {
            const double laplace =
              mu * (H[0][0](i, j) + H[1][1](i, j) + H[2][2](i, j));
            for (unsigned int c = 0; c < dim; ++c)
              {
                const auto &row = kernel.system_index[c];
                kernel.matrix(row[i], row[j]) =
                  (lambda + mu) * H[c][c](i, j) + laplace;
                for (unsigned int d = c + 1; d < dim; ++d)
                  {
                    // H_dc(i, j) = H_cd(j, i); the block (d, c) is the
                    // transpose of (c, d)
                    const double value =
                      lambda * H[c][d](i, j) + mu * H[c][d](j, i);
                    kernel.matrix(row[i], kernel.system_index[d][j]) = value;
                    kernel.matrix(kernel.system_index[d][j], row[i]) = value;
                  }
              }
          }
      return true;
    }

    void
    add_body_force(const Loads &loads, Kernel &kernel)
    {
      const auto &values = kernel.cell_values;
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        {
          const Tensor<1, dim> force =
            loads.body_force(values.quadrature_point(q)) * values.JxW(q);
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int i = 0; i < kernel.n; ++i)
              kernel.load(kernel.system_index[c][i]) +=
                force[c] * values.shape_value(i, q);
        }
    }

    void
    add_tractions(const Body::CellIterator &cell,
                  const Loads              &loads,
                  Kernel                   &kernel)
    {
      if (!cell->at_boundary())
        return;
      auto &values = kernel.face_values;
      for (const unsigned int f : cell->face_indices())
        for (const TractionCondition &condition : loads.tractions)
          if (cell->face(f)->at_boundary() &&
              cell->face(f)->boundary_id() == condition.boundary)
            {
              values.reinit(typename Triangulation<dim>::cell_iterator(cell),
                            f);
              for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                {
                  const Tensor<1, dim> force =
                    condition.traction(values.quadrature_point(q),
                                       values.normal_vector(q)) *
                    values.JxW(q);
                  for (unsigned int c = 0; c < dim; ++c)
                    for (unsigned int i = 0; i < kernel.n; ++i)
                      kernel.load(kernel.system_index[c][i]) +=
                        force[c] * values.shape_value(i, q);
                }
            }
    }

    /// Eliminate the interior of the cell and add the rest. Its own rows keep a
    /// diagonal of the same size and couple with nothing.
    void
    add_condensed(Kernel                              &kernel,
                  std::vector<types::global_dof_index> dofs,
                  const unsigned int                   n_b,
                  const AffineConstraints<double>     &constraints,
                  CondensedInteriors                  &interiors,
                  SparseMatrix                        &stiffness,
                  Vector                              &load)
    {
      if (n_b == dofs.size())
        {
          constraints.distribute_local_to_global(
            kernel.matrix, kernel.load, dofs, stiffness, load);
          return;
        }
      for (unsigned int i = n_b; i < dofs.size(); ++i)
        stiffness.add(dofs[i], dofs[i], kernel.matrix(i, i));
      if (!interiors.eliminate(kernel.matrix, kernel.load, n_b))
        throw std::runtime_error(
          "the stiffness of a cell's interior is not positive definite");
      kernel.boundary_matrix.reinit(n_b, n_b);
      kernel.boundary_matrix.fill(kernel.matrix);
      kernel.boundary_load.reinit(n_b);
      std::copy_n(kernel.load.begin(), n_b, kernel.boundary_load.begin());
      dofs.resize(n_b);
      constraints.distribute_local_to_global(
        kernel.boundary_matrix, kernel.boundary_load, dofs, stiffness, load);
    }
  } // namespace

  void
  add_cell_couplings(const Body                      &body,
                     const DisplacementNumbering     &numbering,
                     const AffineConstraints<double> &constraints,
                     DynamicSparsityPattern          &sparsity)
  {
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          auto               dofs = scene_dofs(body, cell, numbering);
          const unsigned int n_b  = n_boundary_dofs(cell);
          for (unsigned int i = n_b; i < dofs.size(); ++i)
            sparsity.add(dofs[i], dofs[i]);
          dofs.resize(n_b);
          constraints.add_entries_local_to_global(dofs, sparsity, false);
        }
  }

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
    std::string                                     tangled;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          auto &kernel = kernels[cell->active_fe_index()];
          if (!kernel)
            kernel = std::make_unique<Kernel>(*body.mapping,
                                              cell->get_fe(),
                                              body.mapping_degree);

          kernel->cell_values.reinit(
            typename Triangulation<dim>::cell_iterator(cell));
          if (!compute_matrix(body.material, *kernel))
            {
              std::ostringstream message;
              message
                << "Body " << body.name << ": the cell with centre "
                << cell->center()
                << " is tangled (its Jacobian is not positive everywhere); every cell must "
                   "have a positive volume. Use a finer mesh or a lower degree";
              tangled = message.str();
              break;
            }
          kernel->load = 0.;
          if (loads.body_force)
            add_body_force(loads, *kernel);
          add_tractions(cell, loads, *kernel);
          add_condensed(*kernel,
                        scene_dofs(body, cell, numbering),
                        n_boundary_dofs(cell),
                        constraints,
                        interiors,
                        stiffness,
                        load);
        }
    throw_if_any(tangled, body.triangulation().get_communicator());
    return interiors;
  }
} // namespace mortise
