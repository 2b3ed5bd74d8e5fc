// Stress and tangent of materials at one point from the gradient of the
// displacement, for numbers of any type: double, VectorizedArray or vectors of
// the compiler.
//
// A law has
//
//     stress(h, s)       the stress s that belongs to h[i][j] = du_i/dx_j
//     tangent(at, h, s)  the derivative of the stress at the state `at`, in the
//                        direction h
//
// for which the state of a linear law may be anything.
#pragma once

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <variant>

namespace mortise
{
  /// The state where no displacement has a gradient: that of all operators of
  /// linear analysis.
  struct Undeformed
  {};

  /// sigma = lambda tr(strain) I + 2 mu strain (Hooke).
  template <typename Number>
  struct IsotropicLaw
  {
    Number lambda = 0, mu = 0;

    template <typename V>
    inline __attribute__((always_inline)) void
    stress(const V (&h)[3][3], V (&s)[3][3]) const
    {
      const V mean = lambda * (h[0][0] + h[1][1] + h[2][2]);
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int e = c; e < 3; ++e)
          s[c][e] = s[e][c] = mu * (h[c][e] + h[e][c]);
      for (unsigned int c = 0; c < 3; ++c)
        s[c][c] += mean;
    }

    template <typename State, typename V>
    inline __attribute__((always_inline)) void
    tangent(const State &, const V (&h)[3][3], V (&s)[3][3]) const
    {
      stress(h, s);
    }
  };

  /// sigma = C strain with any constant C.
  template <typename Number>
  struct AnisotropicLaw
  {
    /// Rows and columns xx, yy, zz, yz, zx, xy; strains in the last three are
    /// twice those of the tensor. Symmetric.
    Number C[6][6] = {};

    template <typename V>
    inline __attribute__((always_inline)) void
    stress(const V (&h)[3][3], V (&s)[3][3]) const
    {
      const V    strain[6] = {h[0][0],
                              h[1][1],
                              h[2][2],
                              h[1][2] + h[2][1],
                              h[2][0] + h[0][2],
                              h[0][1] + h[1][0]};
      const auto row       = [&](const unsigned int i) {
        V sum = C[i][0] * strain[0];
        for (unsigned int j = 1; j < 6; ++j)
          sum += C[i][j] * strain[j];
        return sum;
      };
      for (unsigned int c = 0; c < 3; ++c)
        {
          const unsigned int a = (c + 1) % 3, b = (c + 2) % 3;
          s[c][c] = row(c);
          s[a][b] = s[b][a] = row(3 + c);
        }
    }

    template <typename State, typename V>
    inline __attribute__((always_inline)) void
    tangent(const State &, const V (&h)[3][3], V (&s)[3][3]) const
    {
      stress(h, s);
    }
  };

  /// The forms that kernels are compiled for; std::visit outside of loops
  /// over points.
  template <typename Number>
  using PointLaw = std::variant<IsotropicLaw<Number>, AnisotropicLaw<Number>>;

  /// The stress at one point from @p gradient, gradient[i][j] = du_i/dx_j.
  template <typename Law>
  dealii::SymmetricTensor<2, 3>
  stress_at(const Law &law, const dealii::Tensor<2, 3> &gradient)
  {
    double h[3][3], s[3][3];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        h[i][j] = gradient[i][j];
    law.stress(h, s);
    dealii::SymmetricTensor<2, 3> result;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        result[i][j] = s[i][j];
    return result;
  }

  /// C_iajb of the tangent in the undeformed state as [i][a][j][b]: what
  /// couples du_i/dx_a with du_j/dx_b.
  using Moduli =
    std::array<std::array<std::array<std::array<double, 3>, 3>, 3>, 3>;

  template <typename Law>
  Moduli
  moduli(const Law &law)
  {
    Moduli result;
    for (unsigned int j = 0; j < 3; ++j)
      for (unsigned int b = 0; b < 3; ++b)
        {
          double h[3][3] = {}, s[3][3];
          h[j][b]        = 1.;
          law.tangent(Undeformed(), h, s);
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int a = 0; a < 3; ++a)
              result[i][a][j][b] = s[i][a];
        }
    return result;
  }
} // namespace mortise
