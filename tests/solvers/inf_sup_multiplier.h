// The inf-sup constant of the multipliers of one interface in a norm that is
// computed, not estimated.
#pragma once

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/mortar/coupling.h>

#include "../mortar/hierarchical_constraint.h"
#include "inf_sup.h"

namespace mortise::testing
{
  /// Data of the cells of one shape: the matrix of int grad u.grad v + u v
  /// without its interior, for scalar functions.
  class ScalarKernel
  {
  public:
    explicit ScalarKernel(const Body &body)
      : body(body)
    {}

    const dealii::FullMatrix<double> &
    compute(const Body::CellIterator &cell)
    {
      std::vector<double> shape = {double(cell->active_fe_index())};
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int d = 0; d < dim; ++d)
          shape.push_back(cell->vertex(v)[d] - cell->vertex(0)[d]);
      const bool same =
        shape.size() == last.size() &&
        std::equal(shape.begin(),
                   shape.end(),
                   last.begin(),
                   [](double a, double b) { return std::abs(a - b) < 1e-12; });
      if (!same)
        integrate(cell);
      last = shape;
      return matrix;
    }

  private:
    void
    integrate(const Body::CellIterator &cell)
    {
      using namespace dealii;
      const auto   &fe = cell->get_fe();
      FEValues<dim> values(*body.mapping,
                           fe.base_element(0),
                           gauss_quadrature<dim>(fe, fe.degree + 2),
                           update_values | update_gradients |
                             update_JxW_values);
      values.reinit(Triangulation<dim>::cell_iterator(cell));
      const unsigned int n = values.dofs_per_cell;
      FullMatrix<double> table((dim + 1) * values.n_quadrature_points, n);
      for (const unsigned int q : values.quadrature_point_indices())
        for (unsigned int i = 0; i < n; ++i)
          {
            const double root             = std::sqrt(values.JxW(q));
            table((dim + 1) * q + dim, i) = root * values.shape_value(i, q);
            const auto gradient           = values.shape_grad(i, q);
            for (unsigned int d = 0; d < dim; ++d)
              table((dim + 1) * q + d, i) = root * gradient[d];
          }
      matrix.reinit(n, n);
      table.Tmmult(matrix, table);
    }

    const Body                &body;
    std::vector<double>        last;
    dealii::FullMatrix<double> matrix;
  };

  /// The inner product of H1 in component @p c of a body; other dofs and
  /// constrained ones couple with nothing.
  inline SparseMatrix
  h1_product(const Body                              &body,
             const dealii::AffineConstraints<double> &constraints,
             const unsigned int                       c)
  {
    using namespace dealii;
    const auto                           n = body.dof_handler.n_dofs();
    std::vector<types::global_dof_index> dofs, all;
    const auto for_each_cell = [&](const auto &visit) {
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        {
          const auto &fe = cell->get_fe();
          all.resize(fe.n_dofs_per_cell());
          cell->get_dof_indices(all);
          dofs.clear();
          for (unsigned int i = 0; i < fe.base_element(0).n_dofs_per_cell();
               ++i)
            dofs.push_back(all[fe.component_to_system_index(c, i)]);
          visit(cell);
        }
    };
    DynamicSparsityPattern sparsity(n, n);
    for (unsigned int i = 0; i < n; ++i)
      sparsity.add(i, i);
    for_each_cell([&](const auto &) {
      constraints.add_entries_local_to_global(dofs, sparsity, false);
    });
    SparsityPattern pattern;
    pattern.copy_from(sparsity);
    dealii::SparseMatrix<double> A(pattern);
    ScalarKernel                 kernel(body);
    for_each_cell([&](const auto &cell) {
      constraints.distribute_local_to_global(kernel.compute(cell), dofs, A);
    });
    return copy_of(A);
  }

  /// Two bodies tied at zmax of the slave and zmin of the master.
  class InfSupInterface
  {
  public:
    /// @p reduced: whether the multiplier space hears of the conditions.
    InfSupInterface(const InfSupBody     &slave,
                    const InfSupBody     &master,
                    const bool            reduced,
                    const MultiplierBasis basis)
    {
      std::vector<const dealii::DoFHandler<dim> *> handlers;
      for (const InfSupBody *given : {&slave, &master})
        {
          bodies.push_back(make_body(*given, bodies.size(), {1., 0.3}));
          handlers.push_back(&bodies.back()->dof_handler);
          open.emplace_back();
          open.back().copy_from(make_constraints(*bodies.back(), *given));
        }
      numbering = FieldNumbering(handlers, MPI_COMM_WORLD);
      couple(reduced, basis);
      for (auto &constraints : open)
        constraints.close();
    }

    /// The multipliers of component @p c.
    Indices
    multipliers(const unsigned int c) const
    {
      std::vector<bool> mine(bodies[0]->dof_handler.n_dofs());
      for (const auto &cell : bodies[0]->dof_handler.active_cell_iterators())
        {
          const auto                                  &fe = cell->get_fe();
          std::vector<dealii::types::global_dof_index> dofs(
            fe.n_dofs_per_cell());
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (fe.system_to_component_index(i).first == c)
              mine[dofs[i]] = true;
        }
      Indices     result;
      const auto &dofs = couplings[0].multipliers->slave_dofs();
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (mine[dofs[i]])
          result.push_back(i);
      return result;
    }

    /// B_b A_b^{-1} B_b^T of body @p b in component @p c.
    DenseMatrix
    schur(const unsigned int b, const unsigned int c) const
    {
      const SparseMatrix        A        = h1_product(*bodies[b], open[b], c);
      const std::vector<double> diagonal = A.diagonal();
      Indices                   taken;
      for (unsigned int i = 0; i < A.m(); ++i)
        if (!open[b].is_constrained(i) && diagonal[i] > 0.)
          taken.push_back(i);
      Places columns(constraint.n(), -1);
      for (unsigned int i = 0; i < taken.size(); ++i)
        columns[numbering(b, taken[i])] = i;
      return schur_complement(submatrix(A, taken, taken),
                              constraint,
                              multipliers(c),
                              columns);
    }

  private:
    void
    couple(const bool reduced, const MultiplierBasis basis)
    {
      const auto scene   = scene_constraints(numbering, open);
      const auto surface = [&](const unsigned int b, const std::string &name) {
        return extract_surface(
          *bodies[b],
          boundary_faces(*bodies[b], bodies[b]->boundary_id(name, "inf-sup")),
          numbering,
          scene);
      };
      couplings.emplace_back();
      Coupling &coupling = couplings.back();
      coupling.interface =
        std::make_unique<InterfaceHandler>("tie",
                                           surface(0, "zmax"),
                                           surface(1, "zmin"),
                                           InterfaceOptions(),
                                           MPI_COMM_WORLD);
      coupling.frames = slave_frames(*bodies[0], coupling.interface->slave());
      coupling.local  = integrate_coupling(*coupling.interface, false, basis);
      std::vector<bool> blocked(bodies[0]->dof_handler.n_dofs(), false);
      if (reduced)
        for (unsigned int i = 0; i < blocked.size(); ++i)
          blocked[i] = open[0].is_constrained(i) &&
                       !bodies[0]->conformity.is_constrained(i);
      coupling.multipliers = std::make_unique<MultiplierSpace>(
        *bodies[0], coupling, partner_states(couplings)[0], blocked);
      coupling.multipliers->number(coupling.interface->slave(), 0);
      const auto rows =
        dealii::complete_index_set(coupling.multipliers->n_owned());
      constraint =
        hierarchical_constraint(couplings,
                                {numbering.owned(), rows, MPI_COMM_WORLD});
    }

    Bodies                                         bodies;
    std::vector<dealii::AffineConstraints<double>> open;
    FieldNumbering                                 numbering;
    std::vector<Coupling>                          couplings;
    SparseMatrix                                   constraint;
  };

  struct MultiplierInfSup
  {
    unsigned int multipliers = 0; ///< of one component
    double       beta        = 0.;
    double slave = 0.; ///< by the slave's displacements alone, in their norm
  };

  /// Displacements that the norm is computed with: the slave's box, mirrored at
  /// the interface, its subdivisions halved and the degree raised.
  struct NormSpace
  {
    unsigned int halvings = 1, degrees = 2;
  };

  /// In component x, flat interface zmax of the slave's box.
  inline MultiplierInfSup
  multiplier_inf_sup(const InfSupBody     &slave,
                     const InfSupBody     &master,
                     const bool            reduced = true,
                     const NormSpace      &space   = {},
                     const MultiplierBasis basis   = MultiplierBasis::standard)
  {
    const InfSupInterface pair(slave, master, reduced, basis);
    DenseMatrix           S_slave = pair.schur(0, 0), S = pair.schur(1, 0);
    S.add(1., S_slave);

    const auto norm = [&](const std::vector<std::string> &clamped) {
      InfSupBody rich  = slave;
      rich.clamped     = clamped;
      rich.degree      = std::min(slave.degree + space.degrees, max_degree);
      auto        &box = rich.mesh.extent;
      const double top = box[5];
      box[5] += top - box[2];
      box[2] = top;
      for (auto &n : rich.mesh.subdivisions)
        n <<= space.halvings;
      return InfSupInterface(slave, rich, reduced, basis).schur(1, 0);
    };
    const DenseMatrix N_slave = norm(slave.clamped);
    DenseMatrix       N       = N_slave;
    N.add(1., slave.clamped == master.clamped ? N_slave : norm(master.clamped));

    MultiplierInfSup result;
    result.multipliers = S.m();
    result.beta =
      std::sqrt(std::max(0., generalized_eigenvalues(S, N).front()));
    result.slave = std::sqrt(
      std::max(0., generalized_eigenvalues(S_slave, N_slave).front()));
    return result;
  }
} // namespace mortise::testing
