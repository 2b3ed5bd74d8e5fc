// The measure of error that all solvers report. It never preconditions.
#pragma once

#include <mortise/operators/block_system.h>

namespace mortise
{
  /// The true residual of the whole system in a norm that does not depend on units:
  ///
  ///     |(r_u, r_lambda)|^2 = r_u . D_u^{-1} r_u + r_lambda . D_lambda^{-1} r_lambda
  ///
  /// with D_u = diag(K + J) and D_lambda = diag(W). Both terms are energies, so that scaling the
  /// lengths, the modulus or the load changes nothing in the relative residual.
  class ScaledResidual
  {
  public:
    explicit ScaledResidual(const BlockSystem &system);

    /// r_u = f - K u - B^T lambda, r_lambda = g - B u. Collective.
    void
    compute(const Vector &u, const Vector &lambda, Vector &r_u, Vector &r_lambda) const;

    /// The norm above; r_lambda is not looked at without an interface. Collective.
    double
    norm(const Vector &r_u, const Vector &r_lambda) const;

    /// Norm of the right hand side (f, g), for relative residuals.
    double
    right_hand_side_norm() const
    {
      return rhs_norm;
    }

    bool
    has_interface() const
    {
      return interface_present;
    }

  private:
    const BlockSystem &system;
    Vector             inverse_diagonal_u;
    Vector             inverse_diagonal_lambda;
    double             rhs_norm          = 0.;
    bool               interface_present = false;
  };
} // namespace mortise
