// Extrapolation of the remaining error of a cell from the changes of earlier
// refinements. Source: Szabo and Babuska, Finite Element Analysis (1991),
// chapter 4, for whole meshes.
#pragma once

namespace mortise
{
  /// Squares of the energy norm.
  struct ErrorTail
  {
    double left  = 0.; ///< by the change of the last refinement
    double ratio = 1.; ///< what another such refinement leaves of it
  };

  /// After a refinement that changed a solution by the square @p change, and one before it by @p before: errors are
  /// taken to fall by the same factor from refinement to refinement, but not to less than @p least_ratio of
  /// what they were. @p n_steps: how many refinements are between the two.
  ErrorTail
  geometric_tail(double       change,
                 double       before,
                 unsigned int n_steps,
                 double       least_ratio);

  /// After a rise of the degree where the solution is smooth, with coefficients
  /// that fall as legendre_decay() says: a geometric_tail() whose factor does
  /// not leave what smooth solutions have, since changes come from neighbours,
  /// too.
  ErrorTail
  smooth_tail(double change, double before, double decay);

  /// After a cell was split into ones of @p degree, on one of them, where the solution is smooth: halves have
  /// 2^-degree of the error of a cell that is small enough, of this one its
  /// square root is taken.
  ErrorTail
  smooth_split_tail(unsigned int degree);

  /// After rises of the degree, to @p p by the square @p change, to p - 1 by @p before: changes are taken to go on
  /// as a power of the degree, at least as its square, which they do beside
  /// edges and corners.
  ErrorTail
  power_tail(unsigned int p, double change, double before);
} // namespace mortise
