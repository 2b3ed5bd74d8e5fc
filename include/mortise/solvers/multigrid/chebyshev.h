// A smoother: Chebyshev polynomials in the operator scaled by its diagonal, one
// value for a node.
#pragma once

#include <mortise/operators/levels/nodal_operator.h>
#include <mortise/solvers/multipliers/interface_correction.h>

namespace mortise
{
  template <typename Number>
  class Chebyshev
  {
  public:
    /// Smooths what belongs to eigenvalues of D^{-1} A between @p smallest and the
    /// largest, which is estimated, by a polynomial whose degree goes with the
    /// root of their ratio: as well whatever the elements are; with @p correction,
    /// which makes D^{-1} respect a constraint, among what satisfies it.
    /// @p matrix and @p correction must stay alive. Collective. Not valid when
    /// A is not positive definite.
    Chebyshev(const NodalOperator<Number>       &matrix,
              double                             smallest,
              const InterfaceCorrection<Number> *correction = nullptr);

    /// Take @p correction in place of the one before. Without leaders on either side nothing else
    /// changes, since a constraint makes no eigenvalue larger. False as
    /// is_valid(). Collective.
    bool
    update(const InterfaceCorrection<Number> *correction);

    bool
    is_valid() const
    {
      return largest > 0.;
    }

    /// x += p(A) (b - A x); with @p from_zero x is taken for zero. Collective.
    void
    smooth(LevelVector<Number>       &x,
           const LevelVector<Number> &b,
           bool                       from_zero) const;

  private:
    void
    set_up();
    double
    estimate_largest() const;

    const NodalOperator<Number>       &matrix;
    const InterfaceCorrection<Number> *correction;
    LevelVector<Number>                inverse_diagonal;
    mutable LevelVector<Number>        r, d;
    const double                       smallest;
    bool                               has_leaders = false;
    double                             largest, range;
    unsigned int                       degree;
  };
} // namespace mortise
