// Proves that the diagonally scaled mass and stiffness of one cell are far
// better conditioned with FE_Legendre than with FE_Q_Hierarchical. With the
// argument "table" it prints the numbers of doc/guide/elements.md.

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_q_hierarchical.h>
#include <deal.II/fe/fe_values.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <mortise/body/elements/fe_legendre.h>
#include <verdict.h>

#include <cstdio>
#include <iostream>

#include "scaled_condition.h"

using namespace dealii;

struct Condition
{
  double mass, stiffness;
};

Condition
condition(const FiniteElement<3> &fe)
{
  Triangulation<3> triangulation;
  GridGenerator::hyper_cube(triangulation);
  FEValues<3> values(fe,
                     QGauss<3>(fe.degree + 1),
                     update_values | update_gradients | update_JxW_values);
  values.reinit(triangulation.begin_active());
  const unsigned int n = fe.n_dofs_per_cell();
  FullMatrix<double> mass(n), stiffness(n);
  for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          mass(i, j) +=
            values.shape_value(i, q) * values.shape_value(j, q) * values.JxW(q);
          stiffness(i, j) +=
            values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q);
        }
  return {scaled_condition(mass, 0), scaled_condition(stiffness, 1)};
}

int
main(int argc, char **argv)
{
  if (argc > 1 && std::string(argv[1]) == "table")
    {
      std::printf("| p | mass: FE_Legendre | FE_Q_Hierarchical | FE_Q "
                  "| stiffness: FE_Legendre | FE_Q_Hierarchical | FE_Q |\n"
                  "|---|---|---|---|---|---|---|\n");
      for (unsigned int p = 1; p <= 8; ++p)
        {
          const Condition legendre = condition(mortise::FE_Legendre(p)),
                          monomial = condition(FE_Q_Hierarchical<3>(p)),
                          nodal    = condition(FE_Q<3>(p));
          std::printf("| %u | %.1e | %.1e | %.1e | %.1e | %.1e | %.1e |\n",
                      p,
                      legendre.mass,
                      monomial.mass,
                      nodal.mass,
                      legendre.stiffness,
                      monomial.stiffness,
                      nodal.stiffness);
        }
      return 0;
    }

  for (unsigned int p = 2; p <= 5; ++p)
    {
      const Condition   legendre = condition(mortise::FE_Legendre(p));
      const Condition   monomial = condition(FE_Q_Hierarchical<3>(p));
      const std::string at       = "p=" + std::to_string(p);
      verdict(at + " mass: condition <= 2e6", legendre.mass, 2e6);
      verdict(at + " stiffness: condition <= 2e4", legendre.stiffness, 2e4);
      if (p >= 4)
        verdict(at + " a hundred times better than FE_Q_Hierarchical",
                100. * std::max(legendre.mass / monomial.mass,
                                legendre.stiffness / monomial.stiffness),
                1.);
    }
}
