// Proves that conformity and boundary constraints work together in an
// assembled, distributed system: a harmonic polynomial given on the boundary is
// found exactly inside, with hanging nodes, degrees drawn at random and any
// number of ranks.

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/hp/fe_values.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <deal.II/numerics/vector_tools.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/spaces/hp_constraints.h>
#include <verdict.h>

#include "element_meshes.h"

using namespace dealii;
using namespace element_test;

using DistributedVector = TrilinosWrappers::MPI::Vector;

double
exact(const Point<3> &x)
{
  return x[0] * x[0] - x[1] * x[1] + x[0] * x[1] * x[2] - 2. * x[2] + 0.5;
}

/// Fix what carries the modes of boundary faces at the values of @p modes (with ghosts).
void
constrain_boundary(const DoFHandler<3>          &dof_handler,
                   const mortise::EntityDegrees &degrees,
                   const DistributedVector      &modes,
                   AffineConstraints<double>    &constraints)
{
  std::vector<types::global_dof_index> masters;
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (!cell->is_artificial())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          {
            degrees.get_master_dofs(cell, masters);
            for (const unsigned int i :
                 mortise::face_dof_indices(cell->get_fe().degree, f))
              if (masters[i] != numbers::invalid_dof_index &&
                  !constraints.is_constrained(masters[i]))
                {
                  constraints.add_line(masters[i]);
                  constraints.set_inhomogeneity(masters[i], modes(masters[i]));
                }
          }
  mortise::complete_constraints(dof_handler, constraints);
}

void
assemble(const DoFHandler<3>             &dof_handler,
         const AffineConstraints<double> &constraints,
         TrilinosWrappers::SparseMatrix  &matrix,
         DistributedVector               &rhs)
{
  hp::QCollection<3> quadrature;
  for (unsigned int i = 0; i < dof_handler.get_fe_collection().size(); ++i)
    quadrature.push_back(QGauss<3>(dof_handler.get_fe(i).degree + 1));
  hp::FEValues<3> hp_values(dof_handler.get_fe_collection(),
                            quadrature,
                            update_gradients | update_JxW_values);
  std::vector<types::global_dof_index> dofs;
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        hp_values.reinit(cell);
        const FEValues<3> &values = hp_values.get_present_fe_values();
        const unsigned int n      = values.dofs_per_cell;
        FullMatrix<double> local(n);
        Vector<double>     local_rhs(n);
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              local(i, j) += values.shape_grad(i, q) * values.shape_grad(j, q) *
                             values.JxW(q);
        dofs.resize(n);
        cell->get_dof_indices(dofs);
        constraints.distribute_local_to_global(
          local, local_rhs, dofs, matrix, rhs, true);
      }
  matrix.compress(VectorOperation::add);
  rhs.compress(VectorOperation::add);
}

/// Largest difference of the found modes from the exact ones.
double
solve(const Triangulation<3> &triangulation,
      const unsigned int      p,
      const unsigned int      seed)
{
  hp::FECollection<3> fes;
  for (unsigned int degree = 1; degree <= 8; ++degree)
    fes.push_back(mortise::FE_Legendre(degree));
  DoFHandler<3> dof_handler(triangulation);
  draw_degrees(dof_handler, p - 1, p + 1, seed);
  dof_handler.distribute_dofs(fes);
  const IndexSet &owned = dof_handler.locally_owned_dofs();
  const MPI_Comm  comm  = dof_handler.get_communicator();
  IndexSet        relevant;
  DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);

  // The modes of a polynomial are found exactly by interpolation on a cube.
  DistributedVector modes(owned, comm),
    modes_with_ghosts(owned, relevant, comm);
  VectorTools::interpolate(dof_handler,
                           ScalarFunctionFromFunctionObject<3>(exact),
                           modes);
  modes_with_ghosts = modes;

  const mortise::EntityDegrees degrees(dof_handler);
  AffineConstraints<double>    constraints;
  mortise::make_conformity_constraints(dof_handler, degrees, constraints);
  constrain_boundary(dof_handler, degrees, modes_with_ghosts, constraints);
  constraints.close();

  TrilinosWrappers::SparsityPattern pattern(owned, owned, comm);
  DoFTools::make_sparsity_pattern(dof_handler,
                                  pattern,
                                  constraints,
                                  false,
                                  Utilities::MPI::this_mpi_process(comm));
  pattern.compress();
  TrilinosWrappers::SparseMatrix matrix;
  matrix.reinit(pattern);
  DistributedVector rhs(owned, comm), u(owned, comm);
  assemble(dof_handler, constraints, matrix, rhs);

  SolverControl                        control(2000, 1e-13 * rhs.l2_norm());
  SolverCG<DistributedVector>          cg(control);
  TrilinosWrappers::PreconditionJacobi jacobi;
  jacobi.initialize(matrix);
  cg.solve(matrix, u, rhs, jacobi);
  constraints.distribute(u);
  u -= modes;
  return u.linfty_norm();
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (unsigned int p = 2; p <= 4; ++p)
    for (unsigned int seed = 1; seed <= 2; ++seed)
      {
        parallel::distributed::Triangulation<3> triangulation(MPI_COMM_WORLD);
        create_shape("cube", seed, triangulation);
        refine_at_random(triangulation, p == 2 ? 2 : 1, seed);
        const double      error = solve(triangulation, p, seed);
        const std::string what =
          "p=" + std::to_string(p) + ".." + std::to_string(p + 2) + ", mesh " +
          std::to_string(seed) + ": harmonic polynomial is found, 1e-9";
        verdict(what, error, 1e-9);
      }
}
