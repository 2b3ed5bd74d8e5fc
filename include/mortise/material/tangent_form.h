// The forms of tangents that kernels are compiled for.
#pragma once

#include <mortise/base/batch.h>

#include <type_traits>

namespace mortise
{
  enum class TangentForm
  {
    /// s = lambda' tr(e) I + 2 mu' e + grad du tau at finite strain: mu',
    /// lambda'.
    isotropic_finite,
    /// s = lambda' tr(e) I + 2 mu' e - (n : e) n at small strain: mu', lambda',
    /// n as xx, yy, zz, yz, zx, xy.
    rank_one,
    /// s = C e + grad du tau at finite strain: the upper triangle of C as that
    /// of AnisotropicLaw, row by row.
    full_finite
  };

  constexpr bool
  is_finite(const TangentForm form)
  {
    return form != TangentForm::rank_one;
  }

  constexpr unsigned int
  n_moduli(const TangentForm form)
  {
    return form == TangentForm::isotropic_finite ? 2 :
           form == TangentForm::rank_one         ? 8 :
                                                   21;
  }

  /// Numbers that a kernel needs of a point beside the metric: the moduli, and
  /// at finite strain tau as xx, yy, zz, yz, zx, xy.
  constexpr unsigned int
  n_tangent(const TangentForm form)
  {
    return n_moduli(form) + (is_finite(form) ? 6 : 0);
  }

  /// @p visit(form) with the form as a constant.
  template <typename Visit>
  void
  with_form(const TangentForm form, const Visit &visit)
  {
    switch (form)
      {
        case TangentForm::isotropic_finite:
          return visit(std::integral_constant<TangentForm,
                                              TangentForm::isotropic_finite>());
        case TangentForm::rank_one:
          return visit(
            std::integral_constant<TangentForm, TangentForm::rank_one>());
        case TangentForm::full_finite:
          return visit(
            std::integral_constant<TangentForm, TangentForm::full_finite>());
      }
  }

  /// The type in which kernels keep the numbers of a tangent. At finite strain
  /// single precision is enough, since residuals are exact, and products take
  /// the time that these numbers need from memory. At small strain the tangent
  /// of an elastic step is exact. Metrics are exact, too, so that rigid motions
  /// have no forces and constant pressures of bodies that are held all around
  /// none. Preconditioners, which multiply in single precision, need a few
  /// digits.
  template <typename Number, TangentForm form>
  using StoredTangent = std::conditional_t<
    !is_finite(form),
    Number,
    std::conditional_t<std::is_same_v<Number, double>, float, UpperHalf>>;

  /// Are the moduli kept in two parts, as what is left of those of an isotropic
  /// law and, behind the numbers of the tangent, its mu' and lambda'? What few
  /// digits leave of a volumetric modulus would be as large as that of shear.
  template <typename Stored>
  constexpr bool
  in_two_parts(const TangentForm form)
  {
    return form == TangentForm::full_finite &&
           std::is_same_v<Stored, UpperHalf>;
  }

  /// visit(k, C_k) for the numbers of full_finite that are not zero for the law
  /// with mu' and lambda'.
  template <typename V, typename Visit>
  inline void
  for_isotropic_moduli(const V &mu, const V &lambda, const Visit &visit)
  {
    for (unsigned int i = 0, k = 0; i < 6; ++i)
      for (unsigned int j = i; j < 6; ++j, ++k)
        if (j < 3)
          visit(k, i == j ? lambda + mu + mu : lambda);
        else if (i == j)
          visit(k, mu);
  }

  /// Numbers that are kept of a point.
  template <typename Stored>
  constexpr unsigned int
  n_stored(const TangentForm form)
  {
    return n_tangent(form) + (in_two_parts<Stored>(form) ? 2 : 0);
  }

  /// A tangent at one point of several cells. @p Stored: what numbers are kept
  /// as.
  template <typename Number, TangentForm form, typename Stored = Number>
  struct TangentAt
  {
    const typename BatchAs<Number, Stored>::Vector *data;

    /// Number @p k of the tangent.
    inline __attribute__((always_inline)) typename Batch<Number>::Vector
    number(const unsigned int k) const
    {
      return unpacked<Number, Stored>(data[k]);
    }

    /// @p h: the gradient of du, with respect to deformed coordinates at finite
    /// strain.
    template <typename State, typename V>
    inline __attribute__((always_inline)) void
    tangent(const State &, const V (&h)[3][3], V (&s)[3][3]) const
    {
      constexpr bool two_parts = in_two_parts<Stored>(form);
      if constexpr (form == TangentForm::full_finite)
        full_product(h, s);
      if constexpr (form != TangentForm::full_finite || two_parts)
        {
          constexpr unsigned int first = two_parts ? n_tangent(form) : 0;
          const V mean = number(first + 1) * (h[0][0] + h[1][1] + h[2][2]);
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int e = c; e < 3; ++e)
              {
                V shear = number(first) * (h[c][e] + h[e][c]);
                if (c == e)
                  shear += mean;
                if (two_parts)
                  shear += s[c][e];
                s[c][e] = s[e][c] = shear;
              }
        }
      if constexpr (form == TangentForm::rank_one)
        subtract_rank_one(h, s);
      if constexpr (is_finite(form))
        {
          constexpr unsigned int n = n_moduli(form);
          const V tau[3][3]        = {{number(n), number(n + 5), number(n + 4)},
                                      {number(n + 5), number(n + 1), number(n + 3)},
                                      {number(n + 4), number(n + 3), number(n + 2)}};
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int e = 0; e < 3; ++e)
              s[c][e] +=
                h[c][0] * tau[0][e] + h[c][1] * tau[1][e] + h[c][2] * tau[2][e];
        }
    }

  private:
    template <typename V>
    inline __attribute__((always_inline)) void
    subtract_rank_one(const V (&h)[3][3], V (&s)[3][3]) const
    {
      const V *n     = data + 2;
      const V  along = n[0] * h[0][0] + n[1] * h[1][1] + n[2] * h[2][2] +
                      n[3] * (h[1][2] + h[2][1]) + n[4] * (h[2][0] + h[0][2]) +
                      n[5] * (h[0][1] + h[1][0]);
      for (unsigned int c = 0; c < 3; ++c)
        {
          const unsigned int a = (c + 1) % 3, b = (c + 2) % 3;
          s[c][c] -= along * n[c];
          s[a][b] -= along * n[3 + c];
          s[b][a] = s[a][b];
        }
    }

    template <typename V>
    inline __attribute__((always_inline)) void
    full_product(const V (&h)[3][3], V (&s)[3][3]) const
    {
      const V  strain[6] = {h[0][0],
                            h[1][1],
                            h[2][2],
                            h[1][2] + h[2][1],
                            h[2][0] + h[0][2],
                            h[0][1] + h[1][0]};
      V        sum[6]    = {};
      unsigned k         = 0;
#pragma GCC unroll 6
      for (unsigned int i = 0; i < 6; ++i)
#pragma GCC unroll 6
        for (unsigned int j = i; j < 6; ++j, ++k)
          {
            const V modulus = number(k);
            sum[i] += modulus * strain[j];
            if (j > i)
              sum[j] += modulus * strain[i];
          }
      for (unsigned int c = 0; c < 3; ++c)
        {
          const unsigned int a = (c + 1) % 3, b = (c + 2) % 3;
          s[c][c] = sum[c];
          s[a][b] = s[b][a] = sum[3 + c];
        }
    }
  };
} // namespace mortise
