// Laws whose stress is not linear in the gradient of the displacement, for
// several points at once. They know no mesh and no form of equations: kernels
// bring gradients to points and take stresses and tangents from there.
#pragma once

#include <mortise/base/batch_math.h>
#include <mortise/material/tangent_form.h>

#include <optional>

namespace mortise
{
  class NonlinearLaw
  {
  public:
    using V = DoubleBatch;

    /// @p compressibility: of the pressure in mixed form, see
    /// LinearElastic::compressibility().
    explicit NonlinearLaw(const double compressibility = 0.)
      : compressibility(compressibility)
    {}

    virtual ~NonlinearLaw() = default;

    virtual TangentForm
    form() const = 0;

    /// Numbers that a point remembers, zero at first.
    virtual unsigned int
    n_history() const
    {
      return 0;
    }

    /// Number of the equivalent plastic strain among these, if there is one.
    virtual std::optional<unsigned int>
    plastic_strain() const
    {
      return {};
    }

    /// Of h[i][j] = du_i/dX_j after @p before, the history up to the last
    /// accepted step: at small strain the stress, at finite strain the
    /// Kirchhoff
    /// stress tau = P F^T, symmetric, force per area; @p after: the history up
    /// to here. Not a number where the law has no stress.
    virtual void
    stress(const V (&h)[3][3],
           const V *before,
           V       *after,
           V (&tau)[3][3]) const = 0;

    /// The moduli there, as many as n_moduli() of form(): at small strain of
    /// d stress = C d strain, at finite strain of the spatial tangent c in
    /// d(tau F^{-T}) = (grad du tau + c : sym grad du) F^{-T}.
    virtual void
    tangent(const V (&h)[3][3], const V *before, V *moduli) const = 0;

    /// In mixed form, where the stress above lacks -p I with an unknown p: the
    /// dilatation that belongs to @p p, tr e or ln J, and its derivative.
    virtual void
    dilatation_of_pressure(const V &p, V &value, V &slope) const
    {
      value = -compressibility * p;
      slope = V{} - compressibility;
    }

  private:
    const double compressibility;
  };
} // namespace mortise
