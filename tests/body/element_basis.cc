// Proves the one-dimensional functions of the hierarchical element (values,
// derivatives, orthogonality, restriction to halves) and that FE_Legendre
// numbers, prolongs, interpolates and projects with them as FE_Q
// does with its own.

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <deal.II/numerics/vector_tools.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/legendre_basis.h>

#include <iostream>

#include "element_meshes.h"
#include "verdict.h"

using namespace dealii;
using namespace mortise;

constexpr unsigned int P = max_lobatto_degree;

void
check_derivatives()
{
  double     ends = 0., first = 0., second = 0., polynomial = 0.;
  const auto polynomials = lobatto_polynomials(P);
  for (const double x : {-0.05, 0., 0.2, 0.5, 0.713, 1., 1.05})
    {
      const double h = 1e-4;
      double v[P + 1], d[P + 1], s[P + 1], left[P + 1], right[P + 1], dl[P + 1],
        dr[P + 1];
      evaluate_lobatto(P, x, v, d, s);
      evaluate_lobatto(P, x - h, left, dl);
      evaluate_lobatto(P, x + h, right, dr);
      for (unsigned int k = 0; k <= P; ++k)
        {
          first =
            std::max(first, std::abs((right[k] - left[k]) / (2. * h) - d[k]));
          second =
            std::max(second, std::abs((dr[k] - dl[k]) / (2. * h) - s[k]));
          std::vector<double> values(3);
          polynomials[lobatto_to_lexicographic(P, k)].value(x, values);
          polynomial = std::max({polynomial,
                                 std::abs(values[0] - v[k]),
                                 std::abs(values[1] - d[k]) / 10.,
                                 std::abs(values[2] - s[k]) / 1000.});
          if ((x == 0. || x == 1.) && k >= 2)
            ends = std::max({ends, std::abs(v[k]), std::abs(values[0])});
        }
    }
  verdict("bubbles vanish at the ends", ends, 0.);
  verdict("first derivatives against differences", first, 1e-4);
  verdict("second derivatives against differences", second, 1e-2);
  verdict("polynomials of deal.II against the recurrence", polynomial, 1e-13);
}

void
check_orthogonality()
{
  const QGauss<1> quadrature(P + 1);
  double          worst = 0.;
  for (unsigned int k = 2; k <= P; ++k)
    for (unsigned int l = 0; l <= P; ++l)
      {
        double sum = 0.;
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            double v[P + 1], d[P + 1];
            evaluate_lobatto(P, quadrature.point(q)[0], v, d);
            sum += quadrature.weight(q) * d[k] * d[l];
          }
        worst = std::max(worst, std::abs(sum - (k == l ? 1. : 0.)));
      }
  verdict("derivatives of bubbles are orthonormal", worst, 1e-13);
}

void
check_restriction()
{
  double worst = 0., above = 0.;
  for (unsigned int child = 0; child < 2; ++child)
    {
      const FullMatrix<double> &R = lobatto_restriction(child);
      for (const double y : {0., 0.1, 0.45, 0.8, 1.})
        {
          double parent[P + 1], own[P + 1];
          evaluate_lobatto(P, 0.5 * (child + y), parent);
          evaluate_lobatto(P, y, own);
          for (unsigned int j = 0; j <= P; ++j)
            {
              for (unsigned int i = 0; i <= P; ++i)
                parent[j] -= R(i, j) * own[i];
              worst = std::max(worst, std::abs(parent[j]));
            }
        }
      for (unsigned int j = 0; j <= P; ++j)
        for (unsigned int i = std::max(2u, j + 1); i <= P; ++i)
          above = std::max(above, std::abs(R(i, j)));
      above = std::max(above, std::abs(R(child, child) - 1.));
    }
  verdict("restriction reproduces the functions", worst, 1e-14);
  verdict("restriction: entries that are 0 or 1", above, 0.);
}

void
check_numbering(const unsigned int p)
{
  const FE_Legendre  fe(p);
  const Point<3>     x(0.3, 0.55, 0.9);
  double             v[3][P + 1];
  const unsigned int n     = p + 1;
  double             worst = 0., face_error = 0.;
  const auto         cell = cell_dof_indices(p);
  for (unsigned int d = 0; d < 3; ++d)
    evaluate_lobatto(p, x[d], v[d]);
  for (unsigned int k = 0; k < n; ++k)
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        worst = std::max(worst,
                         std::abs(fe.shape_value(cell[i + n * (j + n * k)], x) -
                                  v[0][i] * v[1][j] * v[2][k]));
  for (unsigned int f = 0; f < 6; ++f)
    {
      const auto         face = face_dof_indices(p, f);
      const unsigned int d    = f / 2;
      Point<3>           y    = x;
      std::vector<bool>  on_face(fe.n_dofs_per_cell(), false);
      y[d] = f % 2;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            on_face[face[i + n * j]] = true;
            face_error =
              std::max(face_error,
                       std::abs(fe.shape_value(face[i + n * j], y) -
                                v[(d + 1) % 3][i] * v[(d + 2) % 3][j]));
          }
      for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
        if (!on_face[i] && fe.shape_value(i, y) != 0.)
          face_error = 1.;
    }
  verdict("p=" + std::to_string(p) + " cell numbering", worst, 1e-14);
  verdict("p=" + std::to_string(p) + " face numbering and supports",
          face_error,
          1e-14);
}

void
check_transfer(const unsigned int p)
{
  const FE_Legendre   fe(p);
  const unsigned int  n = fe.n_dofs_per_cell();
  std::vector<double> parent(n);
  for (unsigned int i = 0; i < n; ++i)
    parent[i] = std::cos(1. + 3. * i);
  double              worst = 0.;
  std::vector<double> merged(n, 0.);
  const Point<3>      y(0.21, 0.6, 0.87);
  for (unsigned int child = 0; child < 8; ++child)
    {
      const auto     child_values = embed_in_child(p, child, parent);
      const Point<3> x = GeometryInfo<3>::child_to_cell_coordinates(y, child);
      double         difference = 0.;
      for (unsigned int i = 0; i < n; ++i)
        difference += parent[i] * fe.shape_value(i, x) -
                      child_values[i] * fe.shape_value(i, y);
      worst           = std::max(worst, std::abs(difference));
      const auto part = merge_from_child(p, child, child_values);
      for (unsigned int i = 0; i < n; ++i)
        merged[i] += part[i];
    }
  verdict("p=" + std::to_string(p) + " prolongation is exact", worst, 1e-12);
  worst = 0.;
  for (unsigned int i = 0; i < n; ++i)
    worst = std::max(worst, std::abs(merged[i] - parent[i]));
  verdict("p=" + std::to_string(p) + " merging undoes it", worst, 1e-12);
}

/// Error in L2 of the projection of a smooth function on a curved mesh.
double
projection_error(const FiniteElement<3> &fe, const unsigned int p)
{
  Triangulation<3> triangulation;
  element_test::create_shape("quarter ball", 1, triangulation);
  if (p < 4)
    triangulation.refine_global(1);
  const MappingQ<3> mapping(2);
  DoFHandler<3>     dof_handler(triangulation);
  dof_handler.distribute_dofs(fe);
  AffineConstraints<double> constraints;
  constraints.close();
  DynamicSparsityPattern pattern(dof_handler.n_dofs());
  DoFTools::make_sparsity_pattern(dof_handler, pattern);
  SparsityPattern sparsity;
  sparsity.copy_from(pattern);
  SparseMatrix<double> mass(sparsity);
  Vector<double>       rhs(dof_handler.n_dofs()), u(dof_handler.n_dofs());

  const QGauss<3> quadrature(p + 1);
  FEValues<3>     values(mapping,
                     fe,
                     quadrature,
                     update_values | update_JxW_values |
                       update_quadrature_points);
  const auto      f = [](const Point<3> &x) {
    return std::sin(6. * x[0] + 3. * x[1]) * std::exp(x[2]);
  };
  FullMatrix<double> local(fe.n_dofs_per_cell());
  Vector<double>     local_rhs(fe.n_dofs_per_cell());
  // local = A^T A, local_rhs = A^T b: by point, and function
  FullMatrix<double> A(quadrature.size(), fe.n_dofs_per_cell());
  Vector<double>     b(quadrature.size());
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
  std::vector<double>                  at_points(quadrature.size());
  for (const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const double scale = std::sqrt(values.JxW(q));
          b(q)               = scale * f(values.quadrature_point(q));
          for (unsigned int i = 0; i < dofs.size(); ++i)
            A(q, i) = scale * values.shape_value(i, q);
        }
      A.Tmmult(local, A);
      A.Tvmult(local_rhs, b);
      cell->get_dof_indices(dofs);
      constraints.distribute_local_to_global(local, local_rhs, dofs, mass, rhs);
    }
  SparseDirectUMFPACK solver;
  solver.initialize(mass);
  solver.vmult(u, rhs);

  double error = 0.;
  for (const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      values.get_function_values(u, at_points);
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        error += std::pow(at_points[q] - f(values.quadrature_point(q)), 2) *
                 values.JxW(q);
    }
  return std::sqrt(error);
}

void
check_interpolation(const unsigned int p)
{
  Triangulation<3> triangulation;
  GridGenerator::subdivided_hyper_cube(triangulation, 2);
  DoFHandler<3> legendre(triangulation), nodal(triangulation);
  legendre.distribute_dofs(FE_Legendre(p));
  nodal.distribute_dofs(FE_Q<3>(p));
  const ScalarFunctionFromFunctionObject<3> f([](const Point<3> &x) {
    return std::exp(x[0] - 2. * x[1]) * std::sin(x[2] + x[0]);
  });
  Vector<double> u(legendre.n_dofs()), v(nodal.n_dofs());
  VectorTools::interpolate(legendre, f, u);
  VectorTools::interpolate(nodal, f, v);
  FEValues<3>         u_values(legendre.get_fe(), QGauss<3>(3), update_values);
  FEValues<3>         v_values(nodal.get_fe(), QGauss<3>(3), update_values);
  std::vector<double> a(27), b(27);
  double              worst = 0.;
  auto                other = nodal.begin_active();
  for (const auto &cell : legendre.active_cell_iterators())
    {
      u_values.reinit(cell);
      v_values.reinit(other++);
      u_values.get_function_values(u, a);
      v_values.get_function_values(v, b);
      for (unsigned int q = 0; q < a.size(); ++q)
        worst = std::max(worst, std::abs(a[q] - b[q]));
    }
  verdict("p=" + std::to_string(p) + " interpolation equals FE_Q's",
          worst,
          1e-13);
}

int
main()
{
  check_derivatives();
  check_orthogonality();
  check_restriction();
  for (unsigned int p = 1; p <= P; ++p)
    {
      check_numbering(p);
      check_transfer(p);
      check_interpolation(p);
    }
  for (unsigned int p = 1; p <= P; ++p)
    {
      const double nodal    = projection_error(FE_Q<3>(p), p);
      const double legendre = projection_error(FE_Legendre(p), p);
      verdict("p=" + std::to_string(p) +
                " error of the L2 projection as FE_Q's, relative",
              std::abs(nodal - legendre) / nodal,
              1e-10);
    }
}
