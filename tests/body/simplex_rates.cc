// Proves that FE_SimplexLegendre approximates at the full rate: the projection
// in H1 of a smooth function on a mesh of tetrahedra has errors of order h^p
// in H1 and h^(p+1) in L2, on straight cells and on cells curved by
// SimplexMapping of the same degree.

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/hp/fe_values.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparse_matrix.h>

#include <mortise/body/elements/simplex_elements.h>
#include <mortise/body/elements/simplex_mapping.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/body/spaces/hp_constraints.h>
#include <verdict.h>

#include <iostream>

#include "simplex_meshes.h"

using namespace dealii;

double
value(const Point<3> &x)
{
  return std::sin(2. * x[0] + x[1]) * std::exp(x[2] - x[1]);
}

Tensor<1, 3>
gradient(const Point<3> &x)
{
  const double s = std::sin(2. * x[0] + x[1]), c = std::cos(2. * x[0] + x[1]),
               e = std::exp(x[2] - x[1]);
  return Point<3>(2. * c * e, (c - s) * e, s * e);
}

struct Errors
{
  double l2 = 0., h1 = 0.;
};

Errors
projection_errors(const unsigned int p, const unsigned int n, const bool curved)
{
  Triangulation<3> triangulation;
  if (curved)
    simplex_test::create_quarter(n, true, triangulation);
  else
    {
      Triangulation<3> coarse;
      GridGenerator::subdivided_hyper_cube_with_simplices(coarse, n);
      auto [vertices, cells, faces] =
        GridTools::get_coarse_mesh_description(coarse);
      std::mt19937 random(p);
      simplex_test::number_at_random(vertices, cells, random);
      mortise::order_vertices(vertices, cells);
      triangulation.create_triangulation(vertices, cells, SubCellData());
    }

  const mortise::SimplexElements elements({p});
  DoFHandler<3>                  dof_handler(triangulation);
  for (const auto &cell : dof_handler.active_cell_iterators())
    cell->set_active_fe_index(elements.index(cell, p));
  dof_handler.distribute_dofs(elements.collection);
  AffineConstraints<double> constraints;
  mortise::make_conformity_constraints(dof_handler, constraints);
  constraints.close();
  DynamicSparsityPattern pattern(dof_handler.n_dofs());
  DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints);
  SparsityPattern sparsity;
  sparsity.copy_from(pattern);
  SparseMatrix<double> matrix(sparsity);
  Vector<double>       rhs(dof_handler.n_dofs()), u(dof_handler.n_dofs());

  const hp::MappingCollection<3> mapping(
    mortise::SimplexMapping(curved ? p : 1, triangulation));
  const hp::QCollection<3> rule(
    mortise::simplex_quadrature<3>(2 * p + (curved ? p : 2)));
  hp::FEValues<3>    fe_values(mapping,
                            elements.collection,
                            rule,
                            update_values | update_gradients |
                              update_quadrature_points | update_JxW_values);
  const unsigned int size = elements.collection[0].n_dofs_per_cell();
  std::vector<types::global_dof_index> dofs(size);
  for (const auto &cell : dof_handler.active_cell_iterators())
    {
      fe_values.reinit(cell);
      const FEValues<3> &values = fe_values.get_present_fe_values();
      // local = A^T A, local_rhs = A^T b: by component and value, of points
      const unsigned int n = values.n_quadrature_points;
      FullMatrix<double> A(4 * n, size), local(size);
      Vector<double>     b(4 * n), local_rhs(size);
      for (const unsigned int q : values.quadrature_point_indices())
        {
          const double       scale = std::sqrt(values.JxW(q));
          const Tensor<1, 3> df    = gradient(values.quadrature_point(q));
          b(q)                     = scale * value(values.quadrature_point(q));
          for (unsigned int d = 0; d < 3; ++d)
            b((d + 1) * n + q) = scale * df[d];
          for (unsigned int i = 0; i < size; ++i)
            {
              A(q, i)               = scale * values.shape_value(i, q);
              const Tensor<1, 3> dv = scale * values.shape_grad(i, q);
              for (unsigned int d = 0; d < 3; ++d)
                A((d + 1) * n + q, i) = dv[d];
            }
        }
      A.Tmmult(local, A);
      A.Tvmult(local_rhs, b);
      cell->get_dof_indices(dofs);
      constraints.distribute_local_to_global(
        local, local_rhs, dofs, matrix, rhs);
    }
  PreconditionJacobi<SparseMatrix<double>> jacobi;
  jacobi.initialize(matrix);
  SolverControl            control(20000, 1e-13 * rhs.l2_norm());
  SolverCG<Vector<double>> solver(control);
  solver.solve(matrix, u, rhs, jacobi);
  constraints.distribute(u);

  Errors                    errors;
  std::vector<double>       at_points(rule[0].size());
  std::vector<Tensor<1, 3>> gradients(rule[0].size());
  for (const auto &cell : dof_handler.active_cell_iterators())
    {
      fe_values.reinit(cell);
      const FEValues<3> &values = fe_values.get_present_fe_values();
      values.get_function_values(u, at_points);
      values.get_function_gradients(u, gradients);
      for (const unsigned int q : values.quadrature_point_indices())
        {
          const Point<3> x = values.quadrature_point(q);
          errors.l2 += std::pow(at_points[q] - value(x), 2) * values.JxW(q);
          errors.h1 +=
            (gradients[q] - gradient(x)).norm_square() * values.JxW(q);
        }
    }
  return {std::sqrt(errors.l2), std::sqrt(errors.h1)};
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const bool curved : {false, true})
    for (unsigned int p = 1; p <= (curved ? 4 : 8); ++p)
      {
        // subdivisions of the coarser mesh; high degrees reach rounding soon
        const unsigned int n =
          curved ? (p == 1 ? 8 : 4) : (p <= 2 ? 4 : (p <= 5 ? 2 : 1));
        const Errors coarse = projection_errors(p, n, curved),
                     fine   = projection_errors(p, 2 * n, curved);
        const double l2     = std::log2(coarse.l2 / fine.l2),
                     h1     = std::log2(coarse.h1 / fine.h1);
        const std::string at =
          "p=" + std::to_string(p) + (curved ? ", curved" : "");
        if (argc > 1)
          std::cout << at << " L2 " << fine.l2 << " rate " << l2 << ", H1 "
                    << fine.h1 << " rate " << h1 << std::endl;
        else
          {
            verdict(l2 >= p + 0.75, at + " L2: rate >= p + 0.75", l2);
            verdict(h1 >= p - 0.25, at + " H1: rate >= p - 0.25", h1);
          }
      }
}
