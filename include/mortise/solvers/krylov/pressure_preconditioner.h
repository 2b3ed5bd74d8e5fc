// An approximate inverse of P, which stands for the Schur complement of the
// pressures. Sources: Silvester, Wathen (1994); Elman, Silvester, Wathen
// (2014), chapter 4.
#pragma once

#include <mortise/operators/block_system.h>

#include <memory>
#include <string>

namespace mortise
{
  class PressurePreconditioner
  {
  public:
    /// @p system, which has bodies in mixed form, must stay alive. Collective.
    explicit PressurePreconditioner(const BlockSystem &system);
    ~PressurePreconditioner();

    /// False, on every rank, when P is not positive definite.
    bool
    is_valid() const;

    /// dst = P^{-1} src, symmetric and positive definite. Collective.
    void
    vmult(Vector &dst, const Vector &src) const;

    std::string
    description() const;

  private:
    struct Polynomial; ///< of diag(P)^{-1} P
    std::unique_ptr<Polynomial> polynomial;
  };
} // namespace mortise
