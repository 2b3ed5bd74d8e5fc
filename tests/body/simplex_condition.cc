// Proves that the diagonally scaled mass and stiffness of one tetrahedron are
// well conditioned with FE_SimplexLegendre, that its modes on faces and inside
// are orthonormal in L2, and that the conditions are those of nodal functions
// or better where deal.II has them. With the argument "table" it prints the
// conditions.

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <mortise/body/elements/fe_simplex_legendre.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <verdict.h>

#include <cstdio>
#include <iostream>

#include "scaled_condition.h"

using namespace dealii;

struct Matrices
{
  FullMatrix<double> mass, stiffness;
};

/// On the reference tetrahedron.
Matrices
cell_matrices(const FiniteElement<3> &fe)
{
  Triangulation<3> triangulation;
  GridGenerator::reference_cell(triangulation, ReferenceCells::Tetrahedron);
  const MappingFE<3> affine{FE_SimplexP<3>(1)};
  FEValues<3>        values(affine,
                     fe,
                     mortise::simplex_quadrature<3>(2 * fe.degree),
                     update_values | update_gradients | update_JxW_values);
  values.reinit(triangulation.begin_active());
  const unsigned int n = fe.n_dofs_per_cell();
  Matrices           matrices{FullMatrix<double>(n), FullMatrix<double>(n)};
  for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          matrices.mass(i, j) +=
            values.shape_value(i, q) * values.shape_value(j, q) * values.JxW(q);
          matrices.stiffness(i, j) +=
            values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q);
        }
  return matrices;
}

/// Deviation of the modes of each face from orthonormal in L2 of the
/// reference triangle.
double
face_deviation(const mortise::FE_SimplexLegendre &fe)
{
  const auto   rule  = mortise::simplex_quadrature<2>(2 * fe.degree);
  const double n     = fe.n_dofs_per_quad();
  double       worst = 0.;
  for (unsigned int f = 0; f < 4; ++f)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        {
          double sum = 0.;
          for (unsigned int q = 0; q < rule.size(); ++q)
            {
              const double weights[3] = {1. - rule.point(q)[0] -
                                           rule.point(q)[1],
                                         rule.point(q)[0],
                                         rule.point(q)[1]};
              Point<3>     x;
              for (unsigned int v = 0; v < 3; ++v)
                if (mortise::tetrahedron_faces[f][v] > 0)
                  x[mortise::tetrahedron_faces[f][v] - 1] = weights[v];
              const unsigned int first = fe.get_first_quad_index(f);
              sum += rule.weight(q) * fe.shape_value(first + i, x) *
                     fe.shape_value(first + j, x);
            }
          worst = std::max(worst, std::abs(sum - (i == j ? 1. : 0.)));
        }
  return worst;
}

/// The same matrix for the nodal functions of the interpolation points, which
/// for p = 1, 2 are those of FE_SimplexP.
FullMatrix<double>
nodal_matrix(const mortise::FE_SimplexLegendre &fe,
             const FullMatrix<double>          &matrix)
{
  const unsigned int          n = fe.n_dofs_per_cell();
  FullMatrix<double>          modes(n), product(n), nodal(n);
  std::vector<Vector<double>> values(n, Vector<double>(1));
  std::vector<double>         coefficients(n);
  for (unsigned int j = 0; j < n; ++j)
    {
      values[j](0) = 1.;
      fe.convert_generalized_support_point_values_to_dof_values(values,
                                                                coefficients);
      values[j](0) = 0.;
      for (unsigned int i = 0; i < n; ++i)
        modes(i, j) = coefficients[i];
    }
  matrix.mmult(product, modes);
  modes.Tmmult(nodal, product);
  return nodal;
}

double
interior_deviation(const FiniteElement<3> &fe, const FullMatrix<double> &mass)
{
  double worst = 0.;
  for (unsigned int i = fe.get_first_hex_index(); i < mass.m(); ++i)
    for (unsigned int j = fe.get_first_hex_index(); j < mass.m(); ++j)
      worst = std::max(worst, std::abs(mass(i, j) - (i == j ? 1. : 0.)));
  return worst;
}

int
main(int argc, char **argv)
{
  const bool table = argc > 1 && std::string(argv[1]) == "table";
  if (table)
    std::printf("| p | mass | nodal | stiffness | nodal |\n"
                "|---|---|---|---|---|\n");
  for (unsigned int p = 1; p <= 8; ++p)
    {
      const mortise::FE_SimplexLegendre fe(p);
      const Matrices                    matrices = cell_matrices(fe);
      const double mass      = scaled_condition(matrices.mass, 0),
                   stiffness = scaled_condition(matrices.stiffness, 1);
      const double nodal_mass =
                     scaled_condition(nodal_matrix(fe, matrices.mass), 0),
                   nodal_stiffness =
                     scaled_condition(nodal_matrix(fe, matrices.stiffness), 1);
      if (table)
        {
          std::printf("| %u | %.1e | %.1e | %.1e | %.1e |\n",
                      p,
                      mass,
                      nodal_mass,
                      stiffness,
                      nodal_stiffness);
          continue;
        }
      const std::string at = "p=" + std::to_string(p);
      if (p <= 2)
        {
          const Matrices nodal = cell_matrices(FE_SimplexP<3>(p));
          verdict(at + " nodal functions as FE_SimplexP's, 1e-12",
                  std::abs(scaled_condition(nodal.mass, 0) / nodal_mass - 1.) +
                    std::abs(scaled_condition(nodal.stiffness, 1) /
                               nodal_stiffness -
                             1.),
                  1e-12);
        }
      if (p == 1)
        {
          // scaled to one: 1/2 beside the diagonal of the mass, hence
          // (1 + 3/2) / (1 - 1/2)
          verdict(at + " mass: condition 5, 1e-12", std::abs(mass - 5.), 1e-12);
        }
      // algebraic growth; the factors are those of p = 2..8 and half as much
      verdict(at + " mass: condition <= 40 p^4", mass, 40. * std::pow(p, 4));
      verdict(at + " stiffness: condition <= 12 p^3",
              stiffness,
              12. * std::pow(p, 3));
      verdict(at + " face modes are orthonormal, 1e-12",
              face_deviation(fe),
              1e-12);
      verdict(at + " interior modes are orthonormal, 1e-12",
              interior_deviation(fe, matrices.mass),
              1e-12);
    }
}
