// The residual norm that all solvers report.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/solve_report.h>

#include <functional>

namespace mortise
{
  /// The true residual of the whole system in a norm independent of units:
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

    /// The scalar product of norm(). Collective.
    double
    product(const SystemVector &a, const SystemVector &b) const;

    /// A solution x and its residual r.
    struct Solved
    {
      const SystemVector &rhs, &x, &r;
    };

    /// Set the residual of @p report and whether it is converged: at most
    /// @p tolerance relative to the right hand side; or rounding, by its
    /// backward error against |K| |u| + |B|^T |lambda| + |f| (Oettli, Prager
    /// 1964), while @p relative_error, an estimate in the energy norm, is below
    /// 1e-6. Collective.
    void
    assess(const Solved                  &solved,
           double                         tolerance,
           const std::function<double()> &relative_error,
           SolveReport                   &report) const;

    /// What rounding leaves of the residual of @p x, zero at constrained
    /// components: a step of rounding for each of the terms of a row, whose
    /// sizes are |K| |u| + |B|^T |lambda| + |f| with diag(K) for |K|.
    /// Collective.
    double
    attainable(const SystemVector &rhs, const SystemVector &x) const
    {
      constexpr double rounding = 1e-14;
      return rounding * magnitude(rhs, x);
    }

    /// Lower bound of the energy of displacements that balance a right hand
    /// side of norm @p rhs_norm without multipliers: f D_u^{-1} f over the
    /// largest eigenvalue of D_u^{-1} K, at most 22 (degree 8 on tetrahedra).
    /// Much smaller energies are rounding of displacements where multipliers
    /// balance the loads.
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
    /// Norm of the terms of compute() with diag(K) for |K|, a lower bound.
    double
    magnitude(const SystemVector &rhs, const SystemVector &x) const;

    const BlockSystem &system;
    SystemVector       weight; ///< inverse diagonals
    bool               interface_present = false;
  };
} // namespace mortise
