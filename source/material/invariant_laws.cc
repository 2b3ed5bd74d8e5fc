#include <mortise/material/invariant_laws.h>
#include <mortise/material/kinematics.h>
#include <mortise/material/voigt.h>

namespace mortise
{
  namespace
  {
    using V = DoubleBatch;

    V
    trace_of(const V (&a)[3][3])
    {
      return a[0][0] + a[1][1] + a[2][2];
    }

    /// b - I = h + h^T + h h^T, C - I of the transpose.
    void
    left_strain(const V (&h)[3][3], V (&strain)[3][3])
    {
      V transposed[3][3];
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          transposed[i][j] = h[j][i];
      right_strain(transposed, strain);
    }

    /// Of a symmetric tensor.
    void
    square(const V (&a)[3][3], V (&result)[3][3])
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          result[i][j] = result[j][i] =
            a[i][0] * a[0][j] + a[i][1] * a[1][j] + a[i][2] * a[2][j];
    }

    /// @p set(I, J) for the upper triangle, row by row.
    template <typename Set>
    void
    set_moduli(const Set &set, V *moduli)
    {
      for (unsigned int I = 0; I < 6; ++I)
        for (unsigned int J = I; J < 6; ++J)
          *moduli++ = set(I, J);
    }

    /// Component (I, J) of the tensor that takes d to a d a.
    V
    both_sides(const V (&a)[3][3], const unsigned int I, const unsigned int J)
    {
      const unsigned int i = voigt_pairs[I][0], j = voigt_pairs[I][1],
                         k = voigt_pairs[J][0], l = voigt_pairs[J][1];
      return 0.5 * (a[i][k] * a[j][l] + a[i][l] * a[j][k]);
    }

    const V &
    component(const V (&a)[3][3], const unsigned int I)
    {
      return a[voigt_pairs[I][0]][voigt_pairs[I][1]];
    }

    /// What the isochoric part of Mooney and Rivlin's law is made of.
    struct IsochoricStrain
    {
      explicit IsochoricStrain(const V (&h)[3][3])
        : ln_volume(log1p(dilatation(h)))
        , scale(exp(-2. / 3. * ln_volume))
      {
        left_strain(h, strain);
        square(strain, squared);
        trace = trace_of(strain);
      }

      /// tau of C10 and C01.
      void
      get_stress(const double c10, const double c01, V (&tau)[3][3]) const
      {
        // the deviator of I1 b - b^2 is that of (1 + tr e) e - e^2, e = b - I
        const V first = 2. * c10 * scale, second = 2. * c01 * scale * scale,
                factor = first + second * (1. + trace);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            tau[i][j] = factor * strain[i][j] - second * squared[i][j];
        const V mean = trace_of(tau) / 3.;
        for (unsigned int i = 0; i < 3; ++i)
          tau[i][i] -= mean;
      }

      V ln_volume, scale, trace;
      V strain[3][3], squared[3][3];
    };
  } // namespace

  void
  NeoHookean::stress(const V (&h)[3][3], const V *, V *, V (&tau)[3][3]) const
  {
    const V mean = lambda * log1p(dilatation(h));
    left_strain(h, tau);
    for (auto &row : tau)
      for (V &entry : row)
        entry *= mu;
    for (unsigned int i = 0; i < 3; ++i)
      tau[i][i] += mean;
  }

  void
  NeoHookean::tangent(const V (&h)[3][3], const V *, V *moduli) const
  {
    moduli[0] = mu - lambda * log1p(dilatation(h));
    moduli[1] = V{} + lambda;
  }

  void
  StVenantKirchhoff::stress(const V (&h)[3][3],
                            const V *,
                            V *,
                            V (&tau)[3][3]) const
  {
    V strain[3][3], squared[3][3];
    left_strain(h, strain);
    square(strain, squared);
    const V mean = 0.5 * lambda * trace_of(strain);
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int j = 0; j < 3; ++j)
          tau[i][j] = (mean + mu) * strain[i][j] + mu * squared[i][j];
        tau[i][i] += mean;
      }
  }

  void
  StVenantKirchhoff::tangent(const V (&h)[3][3], const V *, V *moduli) const
  {
    V b[3][3];
    left_strain(h, b);
    for (unsigned int i = 0; i < 3; ++i)
      b[i][i] += 1.;
    set_moduli(
      [&](const unsigned int I, const unsigned int J) {
        return lambda * component(b, I) * component(b, J) +
               2. * mu * both_sides(b, I, J);
      },
      moduli);
  }

  void
  MooneyRivlin::stress(const V (&h)[3][3], const V *, V *, V (&tau)[3][3]) const
  {
    const IsochoricStrain isochoric(h);
    V                     mean, slope;
    isochoric.get_stress(c10, c01, tau);
    volume.get(isochoric.ln_volume, mean, slope);
    for (unsigned int i = 0; i < 3; ++i)
      tau[i][i] += mean;
  }

  void
  MooneyRivlin::tangent(const V (&h)[3][3], const V *, V *moduli) const
  {
    const IsochoricStrain isochoric(h);
    const V              &t = isochoric.trace, &g = isochoric.scale;
    V                     mean, slope, first[3][3], second[3][3], b[3][3];
    volume.get(isochoric.ln_volume, mean, slope);
    isochoric.get_stress(c10, 0., first);
    isochoric.get_stress(0., c01, second);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          b[i][j] = g * (isochoric.strain[i][j] + (i == j ? 1. : 0.));
          // of the terms with I
          first[i][j] = 2. / 3. * first[i][j] + 4. / 3. * second[i][j];
        }
    // traces of the stresses before their deviators are taken
    const V of_first  = 2. * c10 * g * (3. + t),
            of_second = 2. * c01 * g * g *
                        (6. + t * (4. + t) - trace_of(isochoric.squared)),
            unit = 2. / 3. * (of_first + of_second) - 2. * mean,
            both = slope - 2. / 9. * of_first - 4. / 9. * of_second;
    set_moduli(
      [&](const unsigned int I, const unsigned int J) {
        V sum =
          4. * c01 * (component(b, I) * component(b, J) - both_sides(b, I, J));
        if (J < 3)
          sum += both - component(first, I);
        if (I < 3)
          sum -= component(first, J);
        if (I == J)
          sum += I < 3 ? unit : 0.5 * unit;
        return sum;
      },
      moduli);
  }
} // namespace mortise
