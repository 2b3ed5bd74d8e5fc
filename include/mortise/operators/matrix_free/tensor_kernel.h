// Sum factorisation on several hexahedra at once, one per lane of a vector of
// the compiler. Only sources of kernels include it.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/base/batch.h>

#include <array>
#include <cstring>

namespace mortise
{
  /// The least number not below @p n that fills whole batches.
  template <typename Number>
  constexpr std::size_t
  padded(const std::size_t n)
  {
    return (n + Batch<Number>::size - 1) / Batch<Number>::size *
           Batch<Number>::size;
  }

  /// The sum of a batch's numbers, by halves: a third of the time that one
  /// after the other takes.
  template <typename Number, unsigned int size = Batch<Number>::size>
  inline Number
  sum_of_batch(const Number *numbers)
  {
    if constexpr (size == 1)
      return numbers[0];
    else
      {
        constexpr unsigned int half = size / 2;
        typedef Number Half __attribute__((vector_size(half * sizeof(Number))));
        Half           lower, upper;
        std::memcpy(&lower, numbers, sizeof(Half));
        std::memcpy(&upper, numbers + half, sizeof(Half));
        lower += upper;
        return sum_of_batch<Number, half>(
          reinterpret_cast<const Number *>(&lower));
      }
  }

  /// A matrix of n_out rows and n_in columns that acts along one direction and
  /// is symmetric (+) or antisymmetric (-) under the reversal of both: S(n_out
  /// - 1 - q, n_in - 1 - i) = +-S(q, i). Its even and odd parts halve the work
  /// (Solomonoff 1992; Kronbichler and Kormann 2019).
  template <typename Number, int n_out, int n_in, bool antisymmetric = false>
  class LineMatrix
  {
  public:
    using V = typename Batch<Number>::Vector;

    static constexpr int n_rows = n_out;

    LineMatrix() = default;

    explicit LineMatrix(const dealii::FullMatrix<double> &S)
    {
      for (int q = 0; q < rows; ++q)
        {
          for (int i = 0; i < half_in; ++i)
            {
              even[q][i] = (S(q, i) + S(q, n_in - 1 - i)) / 2;
              odd[q][i]  = (S(q, i) - S(q, n_in - 1 - i)) / 2;
            }
          if (n_in % 2)
            even[q][half_in] = S(q, half_in);
        }
    }

    /// out = S in or out += S in along one line; @p out may be @p in.
    template <int in_stride, int out_stride, bool add>
    inline __attribute__((always_inline)) void
    apply(const V *in, V *out) const
    {
      V sum[half_in + 1], difference[half_in + 1];
#pragma GCC unroll 16
      for (int i = 0; i < half_in; ++i)
        {
          const V a = in[i * in_stride], b = in[(n_in - 1 - i) * in_stride];
          sum[i]        = a + b;
          difference[i] = a - b;
        }
      if (n_in % 2)
        sum[half_in] = in[half_in * in_stride];
#pragma GCC unroll 16
      for (int q = 0; q < rows; ++q)
        {
          V e = even[q][0] * sum[0], o = odd[q][0] * difference[0];
#pragma GCC unroll 16
          for (int i = 1; i < half_in; ++i)
            {
              e += even[q][i] * sum[i];
              o += odd[q][i] * difference[i];
            }
          if (n_in % 2)
            e += even[q][half_in] * sum[half_in];
          V &first = out[q * out_stride];
          if (n_out % 2 && q == half_out)
            put<add>(first, antisymmetric ? o : e);
          else
            {
              put<add>(first, e + o);
              put<add>(out[(n_out - 1 - q) * out_stride],
                       antisymmetric ? o - e : e - o);
            }
        }
    }

  private:
    static constexpr int half_in = n_in / 2, half_out = n_out / 2,
                         rows = (n_out + 1) / 2;

    template <bool add>
    static inline __attribute__((always_inline)) void
    put(V &to, const V &value)
    {
      if (add)
        to += value;
      else
        to = value;
    }

    Number even[rows][half_in + 1] = {}, odd[rows][half_in + 1] = {};
  };

  /// A matrix along direction @p d of an array of n0 x n1 x n2 numbers, of
  /// which the d-th becomes the number of its rows; first index fastest.
  template <int  d,
            bool add,
            int  n0,
            int  n1,
            int  n2,
            typename Matrix,
            typename V>
  inline __attribute__((always_inline)) void
  apply_along(const Matrix &matrix, const V *in, V *out)
  {
    constexpr int n_out = Matrix::n_rows;
    if constexpr (d == 0)
      {
        for (int l = 0; l < n1 * n2; ++l)
          matrix.template apply<1, 1, add>(in + l * n0, out + l * n_out);
      }
    else if constexpr (d == 1)
      {
        for (int k = 0; k < n2; ++k)
          for (int i = 0; i < n0; ++i)
            matrix.template apply<n0, n0, add>(in + k * n0 * n1 + i,
                                               out + k * n0 * n_out + i);
      }
    else
      {
        for (int l = 0; l < n0 * n1; ++l)
          matrix.template apply<n0 * n1, n0 * n1, add>(in + l, out + l);
      }
  }
} // namespace mortise
