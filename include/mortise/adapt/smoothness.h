// Decay of the Legendre coefficients of a solution on a cell, which decides
// between p and h refinement. Sources: Mavriplis (1994); Eibner and Melenk, An
// adaptive strategy for hp-FEM based on testing for analyticity (2007).
#pragma once

#include <vector>

namespace mortise
{
  /// Of lower degrees there are too few coefficients.
  constexpr unsigned int least_degree_of_decay = 3;

  /// The largest factor by which the Legendre coefficients of the derivatives
  /// of a displacement on a hexahedron fall from one degree to the next, over
  /// the directions that have a part in those of the highest degree. Constants
  /// do not count, nor the higher half of degrees above four, which are not
  /// accurate where neighbours have lower degrees. @p displacement: coefficients by component, of FE_Legendre of @p degree,
  /// at least least_degree_of_decay. @p pressure: of one degree less, or empty; with the factor @p unit, the size of the
  /// cell by a modulus, its squares go together with those of the derivatives:
  /// what is missing of a large pressure makes displacements that are not
  /// smooth although the solution is.
  double
  legendre_decay(unsigned int                            degree,
                 const std::vector<std::vector<double>> &displacement,
                 const std::vector<double>              &pressure = {},
                 double                                  unit     = 0.);

  /// May a cell with this legendre_decay() be taken as far from where a
  /// solution is not smooth?
  bool
  is_smooth(double decay);
} // namespace mortise
