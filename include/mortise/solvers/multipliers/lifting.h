// T, a cheap approximation of the inverse stiffness for forces B^T lambda on
// interfaces: each node by itself. The projector and the Schur complement
// B T B^T of the solvers are made of it.
#pragma once

#include <mortise/solvers/factorisation/cholesky_inverse.h>
#include <mortise/solvers/factorisation/mumps_factorisation.h>
#include <mortise/solvers/factorisation/schwarz_inverse.h>
#include <mortise/solvers/multipliers/coupling_product.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mortise
{
  /// T = diag(K)^{-1} on the nodes of interfaces but zero for leading
  /// displacements; one value for a node, so that multipliers of all
  /// components see the same wherever no boundary condition tells them apart.
  /// Iterations are the same or up to 3 in 19 fewer than with a value for each
  /// component. C = B T B^T + S is factorised, S the compliance of springs.
  class Lifting
  {
  public:
    /// @p system, @p product must stay alive. @p max_gathered: as in SolverOptions.
    /// Collective.
    Lifting(const BlockSystem            &system,
            const CouplingRows           &rows,
            const CouplingProduct<float> &product,
            std::size_t                   max_gathered);

    /// After other multipliers have become active. False as is_valid().
    /// Collective.
    bool
    update_active();

    /// False when the multipliers are not independent of each other.
    bool
    is_valid() const
    {
      return valid;
    }

    /// How C is inverted; empty for what does in most scenes, a factorisation
    /// in single precision that all ranks share.
    std::string
    description() const;

    /// dst = T src.
    void
    vmult(Vector &dst, const Vector &src) const;

    /// T by owned displacement.
    const LevelVector<double> &
    diagonal() const
    {
      return weights;
    }

    /// y = C^{-1} jump, to four digits at least in the norm of C; both with the
    /// rows of B, those that are active: y is zero elsewhere. Collective.
    void
    apply_inverse_schur(Vector &y, const Vector &jump) const;

  private:
    /// Factorise @p active rows and columns of C, entries those of multipliers, in single precision
    /// where that is accurate enough. Collective.
    void
    factorise(NodalMatrix active);

    /// to = C from.
    SchwarzInverse::Product
    product_with_schur() const;

    void
    solve(Vector &y, const Vector &jump) const;

    const BlockSystem            &system;
    const CouplingProduct<float> &product;
    const std::size_t             max_gathered;
    LevelVector<double>           weights;
    NodalMatrix schur; ///< kept once not all multipliers are active

    /// (Entry, inverse of the diagonal) of multipliers that C couples with no
    /// other, unless Schwarz treats all.
    std::vector<std::pair<int, double>> lone;
    /// For the others one of them; the last for what no other can.
    std::unique_ptr<SchwarzInverse>          schwarz;
    std::unique_ptr<CholeskyInverse<double>> cholesky;
    std::unique_ptr<MumpsFactorisation>      mumps;
    std::vector<int>            mumps_entries;    ///< as in NodalMatrix
    mutable std::vector<double> mumps_x, mumps_b; ///< by these
    bool                        valid = false;
  };
} // namespace mortise
