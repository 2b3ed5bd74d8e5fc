// Chebyshev smoother with the diagonal as preconditioner, one value per node.
#pragma once

#include <mortise/operators/levels/level_operator_base.h>
#include <mortise/solvers/multipliers/interface_correction.h>

namespace mortise
{
  template <typename Number>
  class Chebyshev
  {
  public:
    /// Smooths errors of eigenvalues of D^{-1} A between @p smallest and the
    /// largest, which is estimated; the degree grows as the root of their
    /// ratio. With @p correction D^{-1} acts within the kernel of the
    /// constraint. @p matrix and @p correction must stay alive. Not valid if A
    /// is not positive definite. Collective.
    Chebyshev(const LevelOperatorBase<Number>   &matrix,
              double                             smallest,
              const InterfaceCorrection<Number> *correction = nullptr);

    /// Replace the correction. The spectrum is estimated again only with
    /// independent displacements, since a constraint makes no eigenvalue
    /// larger. False as is_valid(). Collective.
    bool
    update(const InterfaceCorrection<Number> *correction);

    bool
    is_valid() const
    {
      return largest > 0.;
    }

    /// x += p(A) (b - A x); with @p from_zero for x = 0. Collective.
    void
    smooth(LevelVector<Number>       &x,
           const LevelVector<Number> &b,
           bool                       from_zero) const;

  private:
    void
    set_up();
    double
    estimate_largest() const;

    const LevelOperatorBase<Number>   &matrix;
    const InterfaceCorrection<Number> *correction;
    LevelVector<Number>                inverse_diagonal;
    mutable LevelVector<Number>        r, d;
    const double                       smallest;
    bool                               has_independent = false;
    double                             largest, range;
    unsigned int                       degree;
  };
} // namespace mortise
