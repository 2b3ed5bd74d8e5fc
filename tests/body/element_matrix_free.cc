// Proves that FE_Legendre gives the same operator by MatrixFree and by
// FEValues, on meshes with hanging nodes, for one degree and mixed ones, and
// that the operator does not depend on the ranks.

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>

#include <deal.II/hp/fe_values.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/spaces/hp_constraints.h>
#include <verdict.h>

#include "element_meshes.h"

using namespace dealii;
using namespace element_test;

using DistributedVector = LinearAlgebra::distributed::Vector<double>;

/// Mass plus stiffness by sum factorisation.
void
apply_matrix_free(const MatrixFree<3>     &matrix_free,
                  const unsigned int       n_components,
                  DistributedVector       &y,
                  const DistributedVector &x)
{
  AssertThrow(n_components == 3, ExcNotImplemented());
  const auto on_cells = [](const MatrixFree<3>                         &data,
                           DistributedVector                           &to,
                           const DistributedVector                     &from,
                           const std::pair<unsigned int, unsigned int> &range) {
    FEEvaluation<3, -1, 0, 3> phi(data, range);
    for (unsigned int cell = range.first; cell < range.second; ++cell)
      {
        phi.reinit(cell);
        phi.gather_evaluate(from,
                            EvaluationFlags::values |
                              EvaluationFlags::gradients);
        for (unsigned int q = 0; q < phi.n_q_points; ++q)
          {
            phi.submit_value(phi.get_value(q), q);
            phi.submit_gradient(phi.get_gradient(q), q);
          }
        phi.integrate_scatter(EvaluationFlags::values |
                                EvaluationFlags::gradients,
                              to);
      }
  };
  matrix_free.cell_loop<DistributedVector, DistributedVector>(on_cells,
                                                              y,
                                                              x,
                                                              true);
}

/// The same cell by cell; @p x has its constrained degrees of freedom set and ghosts updated.
void
apply_by_values(const Mapping<3>                &mapping,
                const DoFHandler<3>             &dof_handler,
                const hp::QCollection<3>        &quadrature,
                const AffineConstraints<double> &constraints,
                DistributedVector               &y,
                const DistributedVector         &x)
{
  const hp::MappingCollection<3>       mappings(mapping);
  hp::FEValues<3>                      hp_values(mappings,
                            dof_handler.get_fe_collection(),
                            quadrature,
                            update_values | update_gradients |
                              update_JxW_values);
  std::vector<types::global_dof_index> dofs;
  y = 0.;
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        hp_values.reinit(cell);
        const FEValues<3> &values = hp_values.get_present_fe_values();
        const unsigned int n      = values.dofs_per_cell;
        Vector<double>     local(n);
        dofs.resize(n);
        cell->get_dof_indices(dofs);
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
          {
            Tensor<1, 3> value;
            Tensor<2, 3> gradient;
            for (unsigned int i = 0; i < n; ++i)
              {
                const unsigned int c =
                  cell->get_fe().system_to_component_index(i).first;
                value[c] += x(dofs[i]) * values.shape_value(i, q);
                gradient[c] += x(dofs[i]) * values.shape_grad(i, q);
              }
            for (unsigned int i = 0; i < n; ++i)
              {
                const unsigned int c =
                  cell->get_fe().system_to_component_index(i).first;
                local(i) += (value[c] * values.shape_value(i, q) +
                             gradient[c] * values.shape_grad(i, q)) *
                            values.JxW(q);
              }
          }
        constraints.distribute_local_to_global(local, dofs, y);
      }
  y.compress(VectorOperation::add);
}

/// Largest difference of both products, relative to the product.
double
difference(const Triangulation<3> &triangulation,
           unsigned int            first,
           unsigned int            last)
{
  const MappingQ<3>   mapping(2);
  hp::FECollection<3> fes;
  hp::QCollection<3>  quadrature;
  hp::QCollection<1>  quadrature_1d;
  for (unsigned int p = 1; p <= 8; ++p)
    {
      fes.push_back(FESystem<3>(mortise::FE_Legendre(p), 3));
      quadrature.push_back(QGauss<3>(p + 1));
      quadrature_1d.push_back(QGauss<1>(p + 1));
    }
  DoFHandler<3> dof_handler(triangulation);
  draw_degrees(dof_handler, first - 1, last - 1, 5);
  dof_handler.distribute_dofs(fes);
  AffineConstraints<double> constraints;
  mortise::make_conformity_constraints(dof_handler, constraints);
  constraints.close();

  MatrixFree<3>                 matrix_free;
  MatrixFree<3>::AdditionalData data;
  data.mapping_update_flags =
    update_values | update_gradients | update_JxW_values;
  matrix_free.reinit(mapping, dof_handler, constraints, quadrature_1d, data);

  const MPI_Comm    comm = dof_handler.get_communicator();
  DistributedVector x, y, z;
  matrix_free.initialize_dof_vector(x);
  matrix_free.initialize_dof_vector(y);
  for (const auto i : dof_handler.locally_owned_dofs())
    if (!constraints.is_constrained(i))
      x(i) = std::sin(1. + i);
  apply_matrix_free(matrix_free, 3, y, x);

  IndexSet relevant;
  DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
  relevant.add_indices(constraints.get_local_lines());
  DistributedVector full(dof_handler.locally_owned_dofs(), relevant, comm);
  z.reinit(full);
  full.copy_locally_owned_data_from(x);
  constraints.distribute(full);
  full.update_ghost_values();
  apply_by_values(mapping, dof_handler, quadrature, constraints, z, full);

  double worst = 0., size = 0.;
  for (const auto i : dof_handler.locally_owned_dofs())
    if (!constraints.is_constrained(i))
      {
        worst = std::max(worst, std::abs(y(i) - z(i)));
        size  = std::max(size, std::abs(z(i)));
      }
  return Utilities::MPI::max(worst, comm) / Utilities::MPI::max(size, comm);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string shape : {"cube", "ball"})
    for (unsigned int p = 2; p <= 4; ++p)
      for (const unsigned int last : {p, p + 2})
        {
          parallel::distributed::Triangulation<3> triangulation(MPI_COMM_WORLD);
          create_shape(shape, p, triangulation);
          refine_at_random(triangulation, 1, p);
          const double      worst = difference(triangulation, p, last);
          const std::string what  = shape + ", p=" + std::to_string(p) + ".." +
                                   std::to_string(last) +
                                   ": MatrixFree equals FEValues, 1e-13";
          verdict(what, worst, 1e-13);
        }
}
