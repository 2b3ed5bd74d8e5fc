// The error that belongs to a residual, from how much solutions changed while
// residuals fell. Pure functions of numbers.
#pragma once

namespace mortise
{
  /// Ratio of squares of error and residual before any refinement.
  constexpr double square_by_residual_at_first = 0.5 * 0.5;

  /// Lower bound of this ratio if residuals did not decrease.
  constexpr double square_by_residual_unseen = 0.8 * 0.8;

  /// Of that, or of what earlier refinements have shown, after the next one.
  constexpr double kept_of_earlier_cycles = 0.8 * 0.8;

  /// By which the root may be too small, since it is not the same everywhere:
  /// half as large again, and less,
  /// down to a sixth, where more than two refinements in a row have shown it, @p n_seen with the last one.
  double
  upper_factor(unsigned int n_seen);

  /// By more than what may be chance, and so that something is seen.
  bool
  falls(double before, double now);

  /// The square of the error in the energy norm by that of the residual: a refinement made the latter @p now
  /// out of @p before, and changed the solution by the square @p change, by which that of the error became
  /// smaller, since what is left of it is orthogonal to the change.
  double
  square_by_residual(double change, double before, double now);
} // namespace mortise
