#include <mortise/base/numbers.h>
#include <mortise/material/plasticity.h>
#include <mortise/material/voigt.h>

#include <cmath>

namespace mortise
{
  namespace
  {
    using V = DoubleBatch;

    const double root_of_two_thirds = std::sqrt(2. / 3.);

    /// a : a of a symmetric tensor by its six numbers.
    V
    square(const V (&a)[6])
    {
      return a[0] * a[0] + a[1] * a[1] + a[2] * a[2] +
             2. * (a[3] * a[3] + a[4] * a[4] + a[5] * a[5]);
    }

    bool
    any(const IntegerBatch &mask)
    {
      for (unsigned int l = 0; l < Batch<double>::size; ++l)
        if (mask[l] != 0)
          return true;
      return false;
    }
  } // namespace

  std::optional<ConstantDefect>
  Hardening::defect() const
  {
    const std::string softening = ": softening is not supported";
    for (const auto &[name, number] :
         {std::pair("Hardening modulus", modulus),
          std::pair("Kinematic hardening modulus", kinematic_modulus),
          std::pair("Saturation exponent", saturation_exponent)})
      if (!(number >= 0. && number <= largest_modulus))
        return ConstantDefect{name,
                              text_of(number),
                              "0 or a positive number" + softening};
    if (!table.empty())
      return defect_of_table();
    if (!(yield_stress >= smallest_modulus && yield_stress <= largest_modulus))
      return ConstantDefect{"Yield stress",
                            yield_stress == 0. ?
                              "nothing with Law = J2 plasticity" :
                              text_of(yield_stress),
                            "a positive number (force per area) " +
                              allowed_moduli()};
    if (saturation_stress != 0. && !(saturation_stress >= yield_stress))
      return ConstantDefect{"Saturation stress",
                            text_of(saturation_stress),
                            "at least the Yield stress, " +
                              text_of(yield_stress) + softening};
    if ((saturation_stress > 0.) != (saturation_exponent > 0.))
      return ConstantDefect{saturation_stress > 0. ? "Saturation exponent" :
                                                     "Saturation stress",
                            "nothing beside the other one",
                            "a positive number, or neither"};
    return {};
  }

  std::optional<ConstantDefect>
  Hardening::defect_of_table() const
  {
    if (yield_stress != 0. || modulus != 0. || saturation_stress != 0.)
      return ConstantDefect{
        "Hardening table",
        "one beside Yield stress, Hardening modulus or Saturation stress",
        "one of both"};
    double strain = 0., stress = smallest_modulus;
    for (unsigned int i = 0; i < table.size(); ++i)
      {
        const auto &[alpha, sigma] = table[i];
        if (!(i == 0 ? alpha == 0. : alpha > strain) || !(sigma >= stress))
          {
            return ConstantDefect{
              "Hardening table",
              "\"" + text_of(alpha) + ", " + text_of(sigma) + "\"",
              "\"plastic strain, yield stress; ...\", strains ascending from 0, stresses positive and not descending"};
          }
        strain = alpha;
        stress = sigma;
      }
    return {};
  }

  void
  Hardening::evaluate(const V &alpha, V &value, V &slope) const
  {
    if (table.empty())
      {
        value = yield_stress + modulus * alpha;
        slope = V{} + modulus;
        if (saturation_stress > 0.)
          {
            const double rise = saturation_stress - yield_stress;
            const V      rest = expm1(-saturation_exponent * alpha);
            value -= rise * rest;
            slope += rise * saturation_exponent * (1. + rest);
          }
        return;
      }
    value = V{} + table.back().second;
    slope = V{};
    for (unsigned int i = table.size() - 1; i > 0; --i)
      {
        const auto &[from, low] = table[i - 1];
        const double rise = (table[i].second - low) / (table[i].first - from);
        const auto   here = alpha < table[i].first;
        value             = here ? low + rise * (alpha - from) : value;
        slope             = here ? V{} + rise : slope;
      }
  }

  Plasticity::Return
  Plasticity::return_from(const V (&h)[3][3], const V *before) const
  {
    Return result;
    result.dilatation = h[0][0] + h[1][1] + h[2][2];
    // s_tr - beta = 2 G (dev e - ep) - 2/3 Hk ep
    const double back = 2. / 3. * hardening.kinematic_modulus;
    for (unsigned int k = 0; k < 6; ++k)
      {
        const unsigned int i = voigt_pairs[k][0], j = voigt_pairs[k][1];
        V                  e = 0.5 * (h[i][j] + h[j][i]);
        if (k < 3)
          e -= result.dilatation / 3.;
        result.relative[k] = 2. * G * e - (2. * G + back) * before[k];
      }
    result.size = sqrt(square(result.relative));
    // g(x) = size - (2 G + 2/3 Hk) x - sqrt(2/3) sigma_y(alpha + sqrt(2/3) x)
    // falls: its root lies between low and high, where Newton's method stays
    const double stiffness = 2. * G + back;
    V            yield, slope;
    hardening.evaluate(before[6], yield, slope);
    const V    first = result.size - root_of_two_thirds * yield;
    const auto flows = first > 0.;
    V          low = {}, high = flows ? first / stiffness : V{};
    V          x = flows ? first / (stiffness + 2. / 3. * slope) : V{};
    result.slope = slope;
    constexpr unsigned int most     = 100;
    constexpr double       rounding = 4e-16;
    for (unsigned int k = 0; k < most && any(flows); ++k)
      {
        hardening.evaluate(before[6] + root_of_two_thirds * x, yield, slope);
        const V g    = result.size - stiffness * x - root_of_two_thirds * yield;
        low          = flows & (g > 0.) ? x : low;
        high         = flows & (g < 0.) ? x : high;
        V next       = x + g / (stiffness + 2. / 3. * slope);
        next         = (next < low) | (next > high) ? 0.5 * (low + high) : next;
        result.slope = slope;
        const auto moves =
          flows & (fabs(next - x) * stiffness > rounding * result.size);
        x = moves ? next : x;
        if (!any(moves))
          break;
      }
    result.flow = x;
    return result;
  }

  void
  Plasticity::stress(const V (&h)[3][3],
                     const V *before,
                     V       *after,
                     V (&s)[3][3]) const
  {
    const Return at       = return_from(h, before);
    const V      pressure = K * at.dilatation;
    const V      factor   = at.size > 0. ? at.flow / at.size : V{};
    const double back     = 2. / 3. * hardening.kinematic_modulus;
    for (unsigned int k = 0; k < 6; ++k)
      {
        const unsigned int i = voigt_pairs[k][0], j = voigt_pairs[k][1];
        // s = relative + back stress before - 2 G flow n
        V value =
          at.relative[k] + back * before[k] - 2. * G * factor * at.relative[k];
        if (k < 3)
          value += pressure;
        s[i][j] = s[j][i] = value;
        if (after != nullptr)
          after[k] = before[k] + factor * at.relative[k];
      }
    if (after != nullptr)
      after[6] = before[6] + root_of_two_thirds * at.flow;
  }

  void
  Plasticity::tangent(const V (&h)[3][3], const V *before, V *moduli) const
  {
    // a flow that is rounding, as at the end of the last step, is none: there
    // the elastic tangent is safe
    constexpr double rounding = 1e-10;
    const Return     at       = return_from(h, before);
    const auto       flows    = 2. * G * at.flow > rounding * at.size;
    const V          drop     = flows ? 2. * G * at.flow / at.size : V{};
    V                theta_bar =
      1. / (1. + (at.slope + hardening.kinematic_modulus) / (3. * G)) - drop;
    theta_bar    = flows & (theta_bar > 0.) ? theta_bar : V{};
    moduli[0]    = G * (1. - drop);
    moduli[1]    = K - 2. / 3. * moduli[0];
    const V root = flows ? sqrt(2. * G * theta_bar) / at.size : V{};
    for (unsigned int k = 0; k < 6; ++k)
      moduli[2 + k] = root * at.relative[k];
  }

  namespace
  {
    /// Q a Q^T, or Q^T a Q if @p back.
    void
    turn(const V (&axes)[3][3],
         const bool back,
         const V (&a)[3][3],
         V (&b)[3][3])
    {
      V half[3][3];
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            half[i][j] = V{};
            for (unsigned int k = 0; k < 3; ++k)
              half[i][j] += (back ? axes[k][i] : axes[i][k]) * a[k][j];
          }
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            b[i][j] = V{};
            for (unsigned int k = 0; k < 3; ++k)
              b[i][j] += half[i][k] * (back ? axes[k][j] : axes[j][k]);
          }
    }

    /// The tensor with these eigenvalues.
    void
    tensor_of(const V (&values)[3], const V (&axes)[3][3], V (&E)[3][3])
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            E[i][j] = V{};
            for (unsigned int a = 0; a < 3; ++a)
              E[i][j] += values[a] * axes[i][a] * axes[j][a];
          }
    }
  } // namespace

  void
  FinitePlasticity::stress_in_axes(const Strain &strain,
                                   const V      *before,
                                   V            *after,
                                   V (&T)[3][3]) const
  {
    V E[3][3], s[3][3];
    tensor_of(strain.logarithms, strain.axes, E);
    law.stress(E, before, after, s);
    turn(strain.axes, true, s, T);
  }

  void
  FinitePlasticity::moduli_in_axes(const Strain &strain,
                                   const V      *before,
                                   V (&T)[3][3],
                                   V (&D)[6][6]) const
  {
    stress_in_axes(strain, before, nullptr, T);
    V E[3][3], moduli[8];
    tensor_of(strain.logarithms, strain.axes, E);
    law.tangent(E, before, moduli);
    V n[3][3], turned[3][3];
    for (unsigned int k = 0; k < 6; ++k)
      n[voigt_pairs[k][0]][voigt_pairs[k][1]] =
        n[voigt_pairs[k][1]][voigt_pairs[k][0]] = moduli[2 + k];
    turn(strain.axes, true, n, turned);
    for (unsigned int I = 0; I < 6; ++I)
      for (unsigned int J = 0; J < 6; ++J)
        {
          D[I][J] = -turned[voigt_pairs[I][0]][voigt_pairs[I][1]] *
                    turned[voigt_pairs[J][0]][voigt_pairs[J][1]];
          if (I < 3 && J < 3)
            D[I][J] += moduli[1];
          if (I == J)
            D[I][J] += (I < 3 ? 2. : 1.) * moduli[0];
        }
  }
} // namespace mortise
