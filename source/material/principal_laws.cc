#include <mortise/material/principal_laws.h>

namespace mortise
{
  void
  PrincipalLaw::stress_in_axes(const Strain &strain,
                               const V *,
                               V *,
                               V (&T)[3][3]) const
  {
    V tau[3], slope[3][3];
    principal(strain, tau, slope);
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        T[a][b] = a == b ? tau[a] : V{};
  }

  void
  PrincipalLaw::moduli_in_axes(const Strain &strain,
                               const V *,
                               V (&T)[3][3],
                               V (&D)[6][6]) const
  {
    V tau[3], slope[3][3];
    principal(strain, tau, slope);
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        {
          T[a][b]         = a == b ? tau[a] : V{};
          D[a][b]         = slope[a][b];
          D[a][3 + b]     = V{};
          D[3 + a][b]     = V{};
          D[3 + a][3 + b] = V{};
        }
    for (unsigned int r = 0; r < 3; ++r)
      {
        // the axes turn: (tau_a - tau_b) / (2 (ln l_a - ln l_b))
        constexpr double   near = 1e-4;
        const unsigned int a = (r + 1) % 3, b = (r + 2) % 3;
        const V difference = strain.logarithms[a] - strain.logarithms[b];
        const V limit =
          0.25 * (slope[a][a] - slope[a][b] + slope[b][b] - slope[b][a]);
        const V secant  = 0.5 * (tau[a] - tau[b]) / difference;
        D[3 + r][3 + r] = fabs(difference) < near ? limit : secant;
      }
  }

  void
  Hencky::principal(const Strain &strain, V (&tau)[3], V (&slope)[3][3]) const
  {
    const V(&ln)[3] = strain.logarithms;
    const V mean    = lambda * (ln[0] + ln[1] + ln[2]);
    for (unsigned int a = 0; a < 3; ++a)
      {
        tau[a] = mean + 2. * mu * ln[a];
        for (unsigned int b = 0; b < 3; ++b)
          slope[a][b] = V{} + (lambda + (a == b ? 2. * mu : 0.));
      }
  }

  double
  Ogden::shear_modulus(const std::vector<Term> &terms)
  {
    double sum = 0.;
    for (const Term &term : terms)
      sum += 0.5 * term.modulus * term.exponent;
    return sum;
  }

  void
  Ogden::principal(const Strain &strain, V (&tau)[3], V (&slope)[3][3]) const
  {
    const V(&ln)[3]   = strain.logarithms;
    const V ln_volume = ln[0] + ln[1] + ln[2];
    V       mean, of_mean;
    volume.get(ln_volume, mean, of_mean);
    for (unsigned int a = 0; a < 3; ++a)
      {
        tau[a] = mean;
        for (unsigned int b = 0; b < 3; ++b)
          slope[a][b] = of_mean;
      }
    for (const Term &term : terms)
      {
        V power[3]; // l_a^alpha of the isochoric stretches, less one
        for (unsigned int a = 0; a < 3; ++a)
          power[a] = expm1(term.exponent * (ln[a] - ln_volume / 3.));
        const V mean = (power[0] + power[1] + power[2]) / 3.;
        for (unsigned int a = 0; a < 3; ++a)
          {
            tau[a] += term.modulus * (power[a] - mean);
            // (delta_ac - 1/3) alpha l_c^alpha (delta_cb - 1/3)
            for (unsigned int b = 0; b < 3; ++b)
              slope[a][b] += term.modulus * term.exponent *
                             ((a == b ? 1. + power[a] : V{}) -
                              (1. + power[a] + power[b] - mean) / 3.);
          }
      }
  }
} // namespace mortise
