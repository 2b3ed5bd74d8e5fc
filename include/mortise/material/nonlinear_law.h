// Laws whose stress is not linear in the gradient of the displacement, at one
// point of as many cells as the processor computes together. The linear laws of
// law.h are compiled into the kernels; these are asked once per iterate, and
// kernels keep their tangents.
//
// Plasticity at small strain derives from this class as it is. Finite strain
// needs besides the metric of the deformed cells and the stress in the tangent,
// six numbers a point; isotropic tangents and those with a term of rank one
// need fewer moduli than the 21 that are kept here.
#pragma once

#include <mortise/base/batch.h>

namespace mortise
{
  template <typename Number>
  class NonlinearLaw
  {
  public:
    using V                                = typename Batch<Number>::Vector;
    static constexpr unsigned int n_moduli = 21;

    virtual ~NonlinearLaw() = default;

    /// Numbers that a point remembers, zero at first.
    virtual unsigned int
    n_history() const = 0;

    /// The symmetric stress s that belongs to h[i][j] = du_i/dx_j after
    /// @p before, the history up to the last accepted step; @p after: the
    /// history up to here.
    virtual void
    stress(const V (&h)[3][3],
           const V *before,
           V       *after,
           V (&s)[3][3]) const = 0;

    /// The derivative of the stress there: the upper triangle of
    /// AnisotropicLaw::C, row by row.
    virtual void
    tangent(const V (&h)[3][3], const V *before, V *moduli) const = 0;
  };
} // namespace mortise
