// Approximate Schur complement C = B T B^T + S of the multipliers, with a
// diagonal approximation T of K^{-1} and the compliance S of springs. Source:
// Braess and Sarazin (1997).
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
  /// T = diag(K)^{-1}, averaged over the components of a node, so that C is the
  /// same for all components; zero for independent displacements. Iterations
  /// are equal to those with a value per component, or up to 3 in 19 fewer. C
  /// is factorised.
  class ApproximateSchurComplement
  {
  public:
    /// @p system, @p product must stay alive. @p max_gathered: as in SolverOptions.
    /// Collective.
    ApproximateSchurComplement(const BlockSystem            &system,
                               const RowsByEntity           &rows,
                               const CouplingProduct<float> &product,
                               std::size_t                   max_gathered);

    /// To be called after BlockSystem::active has changed. False as is_valid().
    /// Collective.
    bool
    update_active();

    /// After LinearSolver::update_directions(), with an active set; false as
    /// is_valid(). Collective.
    bool
    update_directions();

    /// False if the multipliers are linearly dependent.
    bool
    is_valid() const
    {
      return valid;
    }

    /// The factorisation in words; empty for the usual one, in single precision
    /// on all ranks.
    std::string
    description() const;

    /// dst = T src.
    void
    apply_inverse_diagonal(Vector &dst, const Vector &src) const;

    /// T by owned displacement.
    const LevelVector<double> &
    inverse_diagonal() const
    {
      return weights;
    }

    /// y = C^{-1} jump for active multipliers, zero for others, to at least
    /// four digits in the norm of C. Collective.
    void
    apply_inverse(Vector &y, const Vector &jump) const;

  private:
    /// C from that of the rows by component. Collective.
    RowsByNode
    in_directions(RowsByNode C) const;

    /// Factorise the @p active rows and columns of C, in single precision if
    /// that is accurate enough. Collective.
    void
    factorise(RowsByNode active);

    /// to = C from.
    SchwarzInverse::Product
    product_with_schur() const;

    void
    solve(Vector &y, const Vector &jump) const;

    const BlockSystem            &system;
    const CouplingProduct<float> &product;
    const std::size_t             max_gathered;
    LevelVector<double>           weights;
    /// B T B^T of rows by component, and in the frames of multipliers or, of
    /// active ones alone, in the directions of the active set; kept once not
    /// all multipliers are active.
    RowsByNode undirected, schur;

    /// (Entry, inverse of the diagonal) of multipliers without off-diagonal
    /// entries in C, unless Schwarz treats all.
    std::vector<std::pair<int, double>> uncoupled_entries;
    /// One of these inverts the rest of C, the last if no other can.
    std::unique_ptr<SchwarzInverse>          schwarz;
    std::unique_ptr<CholeskyInverse<double>> cholesky;
    std::unique_ptr<MumpsFactorisation>      mumps;
    std::vector<int>            mumps_entries;    ///< as in RowsByNode
    mutable std::vector<double> mumps_x, mumps_b; ///< by these
    bool                        valid = false;
  };
} // namespace mortise
