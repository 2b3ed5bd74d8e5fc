// Laws in the logarithmic strain E = ln(C) / 2 and the stress T that does work
// on it: the second Piola-Kirchhoff stress is S = T : P_L, P_L = 2 dE/dC, and
// its derivative P_L : D : P_L + T : L_L with D = dT/dE and L_L = 4 d^2E/dC^2.
// Source: Miehe, Apel, Lambrecht (2002). In the axes of C the components of P_L
// and L_L are first and second divided differences of the logarithm at its
// eigenvalues.
#pragma once

#include <mortise/material/nonlinear_law.h>

namespace mortise
{
  class LogarithmicLaw : public NonlinearLaw
  {
  public:
    using NonlinearLaw::NonlinearLaw;

    TangentForm
    form() const final
    {
      return TangentForm::full_finite;
    }

    void
    stress(const V (&h)[3][3],
           const V *before,
           V       *after,
           V (&tau)[3][3]) const final;

    void
    tangent(const V (&h)[3][3], const V *before, V *moduli) const final;

  protected:
    /// A state of strain.
    struct Strain
    {
      V logarithms[3]; ///< eigenvalues of E
      V squares[3];    ///< eigenvalues of C - I
      V axes[3][3];    ///< their directions as columns
    };

    /// T in the axes of @p strain after the history @p before; @p after: that
    /// up to here, or null.
    virtual void
    stress_in_axes(const Strain &strain,
                   const V      *before,
                   V            *after,
                   V (&T)[3][3]) const = 0;

    /// The same with D = dT/dE in these axes, rows and columns xx, yy, zz, yz,
    /// zx, xy, for strains the last three of which are twice those of the
    /// tensor.
    virtual void
    moduli_in_axes(const Strain &strain,
                   const V      *before,
                   V (&T)[3][3],
                   V (&D)[6][6]) const = 0;

  private:
    static Strain
    strain_of(const V (&h)[3][3]);
  };
} // namespace mortise
