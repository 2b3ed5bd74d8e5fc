// Roots, logarithms and powers of numbers that the processor computes together:
// calls of the C library, number by number, take longer than a product with the
// stiffness of the same cells.
#pragma once

#include <immintrin.h>
#include <mortise/base/batch.h>

#include <cmath>
#include <cstdint>
#include <cstring>

namespace mortise
{
  using DoubleBatch = Batch<double>::Vector;
  typedef std::int64_t IntegerBatch
    __attribute__((vector_size(register_width), may_alias));

  inline DoubleBatch
  sqrt(const DoubleBatch &x)
  {
#if defined(__AVX512F__)
    return (DoubleBatch)_mm512_maskz_sqrt_pd(0xff, (__m512d)x);
#elif defined(__AVX__)
    return (DoubleBatch)_mm256_sqrt_pd((__m256d)x);
#else
    return (DoubleBatch)_mm_sqrt_pd((__m128d)x);
#endif
  }

  inline DoubleBatch
  fabs(const DoubleBatch &x)
  {
    return x < 0. ? -x : x;
  }

  /// ln(1 + x), exact to rounding also of small x; not a number for x <= -1.
  inline DoubleBatch
  log1p(const DoubleBatch &x)
  {
    constexpr std::int64_t mantissa = 0xfffffffffffff, bias = 1023,
                           one = std::int64_t(bias) << 52;
    const DoubleBatch y        = 1. + x;
    IntegerBatch      bits     = (IntegerBatch)y;
    IntegerBatch      k        = (bits >> 52) - bias;
    IntegerBatch      m        = (bits & mantissa) | one;
    DoubleBatch       f        = (DoubleBatch)m; // in [1, 2)
    // then in [1/sqrt(2), sqrt(2))
    const IntegerBatch large = f > 1.4142135623730951;
    f                        = large ? 0.5 * f : f;
    k                        = large ? k + 1 : k;
    const DoubleBatch n      = __builtin_convertvector(k, DoubleBatch);
    // ln f = 2 artanh(s), s = (f - 1) / (f + 1); f - 1 is x where y is f
    const DoubleBatch above  = k == 0 ? x : f - 1.;
    const DoubleBatch s      = above / (2. + above);
    const DoubleBatch square = s * s;
    DoubleBatch       sum    = {};
    for (int i = 21; i >= 3; i -= 2)
      sum = (sum + 1. / i) * square;
    constexpr double high    = 6.93147180369123816490e-01,
                     low     = 1.90821492927058770002e-10;
    const DoubleBatch result = n * high + (2. * (s + s * sum) + n * low);
    return (y > 0.) & (y < 1e300) ? result : result * std::nan("");
  }

  /// exp(x) - 1 of numbers between -700 and 700, exact to rounding also of
  /// small x.
  inline DoubleBatch
  expm1(const DoubleBatch &x)
  {
    constexpr double inverse  = 1.44269504088896338700,
                     high     = 6.93147180369123816490e-01,
                     low      = 1.90821492927058770002e-10;
    constexpr double   rounds = 6755399441055744.; // 1.5 2^52
    const DoubleBatch  n      = (x * inverse + rounds) - rounds;
    const IntegerBatch k      = __builtin_convertvector(n, IntegerBatch);
    const DoubleBatch  r      = (x - n * high) - n * low; // |r| <= ln(2) / 2
    DoubleBatch        sum    = 1. + r / 15.;
    for (int i = 14; i >= 2; --i)
      sum = 1. + sum * r / double(i);
    sum *= r;
    const DoubleBatch power = (DoubleBatch)((k + 1023) << 52);
    return power * sum + (power - 1.);
  }

  inline DoubleBatch
  exp(const DoubleBatch &x)
  {
    return 1. + expm1(x);
  }
} // namespace mortise
