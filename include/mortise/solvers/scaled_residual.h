// The measure of error that all solvers report. It never preconditions.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/solve_report.h>

#include <functional>

namespace mortise
{
  /// The true residual of the whole system in a norm that does not depend on
  /// units:
  ///
  ///     |(r_u, r_p, r_lambda)|^2 = r_u . D_u^{-1} r_u + r_p . D_p^{-1} r_p +
  ///     r_lambda . D_lambda^{-1} r_lambda
  ///
  /// with D_u = diag(K), D_p = diag(P) and D_lambda = diag(B D_u^{-1} B^T). All
  /// terms are energies, so that scaling the lengths, the modulus or the load
  /// changes nothing in the relative residual.
  class ScaledResidual
  {
  public:
    explicit ScaledResidual(const BlockSystem &system);

    /// r = rhs - [K G^T B^T; G -C 0; B 0 0] x. Collective.
    void
    compute(const SystemVector &rhs,
            const SystemVector &x,
            SystemVector       &r) const;

    /// The norm above. Collective.
    double
    norm(const SystemVector &r) const
    {
      return std::sqrt(product(r, r));
    }

    /// The product that belongs to it. Collective.
    double
    product(const SystemVector &a, const SystemVector &b) const;

    /// A solution x and its residual r.
    struct Solved
    {
      const SystemVector &rhs, &x, &r;
    };

    /// Note the residual in @p report, and whether that is converged: relative to the right hand
    /// side it is at most @p tolerance; or all that is left of it is rounding, its backward error
    /// against |K| |u| + |B|^T |lambda| + |f| (Oettli, Prager 1964), and @p relative_error, an
    /// estimate of the error in the energy norm over that of the solution, is
    /// below 1e-6. Collective.
    void
    judge(const Solved                  &solved,
          double                         tolerance,
          const std::function<double()> &relative_error,
          SolveReport                   &report) const;

    /// A lower bound of the energy of displacements that balance a right hand
    /// side of norm @p rhs_norm without multipliers: f D_u^{-1} f over the largest eigenvalue of
    /// D_u^{-1} K, 22 at most (degree 8 on tetrahedra). Where multipliers
    /// balance it and displacements are zero to rounding, what is small beside
    /// it is rounding.
    static double
    least_energy(const double rhs_norm)
    {
      return rhs_norm * rhs_norm / 25.;
    }

    /// 1 / D_u, on the owned displacements.
    const Vector &
    inverse_diagonal_u() const
    {
      return weight.displacement;
    }

    /// 1 / D_p, on the owned pressures; only with mixed bodies.
    const Vector &
    inverse_diagonal_p() const
    {
      return weight.pressure;
    }

    /// 1 / D_lambda, on the owned multipliers; only with an interface.
    const Vector &
    inverse_diagonal_lambda() const
    {
      return weight.multiplier;
    }

  private:
    /// The norm of the terms that compute() adds up, with diag(K) for |K|: a
    /// lower bound.
    double
    magnitude(const SystemVector &rhs, const SystemVector &x) const;

    const BlockSystem &system;
    SystemVector       weight; ///< inverse diagonals
    bool               interface_present = false;
  };
} // namespace mortise
