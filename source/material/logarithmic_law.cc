#include <mortise/material/kinematics.h>
#include <mortise/material/logarithmic_law.h>
#include <mortise/material/voigt.h>

namespace mortise
{
  namespace
  {
    using V = DoubleBatch;

    /// (ln a - ln b) / (a - b) for a = 1 + x, b = 1 + y.
    V
    first_difference(const V &x, const V &y, const V &ln_a, const V &ln_b)
    {
      constexpr double near = 0.1;
      const V          sum = 2. + x + y, ratio = (x - y) / sum;
      // 2 artanh(ratio) / (a - b)
      const V square = ratio * ratio;
      V       series = {};
      for (int i = 17; i >= 3; i -= 2)
        series = (series + 1. / i) * square;
      const V close = 2. * (1. + series) / sum;
      const V other = (ln_a - ln_b) / (x - y);
      return fabs(ratio) < near ? close : other;
    }

    /// ln[a, b, c], the second divided difference of the logarithm. @p x:
    /// eigenvalues less one; @p first: first differences by pair.
    V
    second_difference(const V (&x)[3],
                      const V (&first)[3][3],
                      const unsigned int (&which)[3])
    {
      constexpr double near = 0.03;
      const V          a = x[which[0]], b = x[which[1]], c = x[which[2]];
      const V          mean = (a + b + c) / 3., centre = 1. + mean;
      // with complete homogeneous polynomials of the distances from the mean
      const V u = (a - mean) / centre, v = (b - mean) / centre,
              w  = (c - mean) / centre;
      const V e2 = u * v + v * w + w * u, e3 = u * v * w;
      V       h[10] = {V{} + 1., V{}, -e2, e3};
      for (unsigned int k = 4; k < 10; ++k)
        h[k] = -e2 * h[k - 2] + e3 * h[k - 3];
      V series = {};
      for (int k = 9; k >= 0; --k)
        series += (k % 2 == 0 ? -1. : 1.) / (k + 2.) * h[k];
      V result = series / (centre * centre);
      // of the pair that is farthest apart
      const V distance[3] = {fabs(a - b), fabs(b - c), fabs(c - a)};
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int p = which[i], q = which[(i + 1) % 3],
                             r   = which[(i + 2) % 3];
          const V    far         = (first[p][r] - first[r][q]) / (x[p] - x[q]);
          const auto is_farthest = (distance[i] > near * centre) &
                                   (distance[i] >= distance[(i + 1) % 3]) &
                                   (distance[i] >= distance[(i + 2) % 3]);
          result = is_farthest ? far : result;
        }
      return result;
    }

    /// P_L in the axes: first differences of all pairs.
    void
    first_differences(const V (&x)[3], const V (&ln)[3], V (&result)[3][3])
    {
      for (unsigned int a = 0; a < 3; ++a)
        {
          result[a][a] = 1. / (1. + x[a]);
          for (unsigned int b = 0; b < a; ++b)
            result[a][b] = result[b][a] =
              first_difference(x[a], x[b], 2. * ln[a], 2. * ln[b]);
        }
    }

    /// f[i][a] = F_ij N_ja.
    void
    deform(const V (&h)[3][3], const V (&axes)[3][3], V (&f)[3][3])
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int a = 0; a < 3; ++a)
          f[i][a] = axes[i][a] + h[i][0] * axes[0][a] + h[i][1] * axes[1][a] +
                    h[i][2] * axes[2][a];
    }

    /// T : L_L as a form on strains, in Voigt's notation, joins C.
    void
    add_curvature(const V (&x)[3],
                  const V (&first)[3][3],
                  const V (&T)[3][3],
                  V (&C)[6][6])
    {
      V second[3][3][3];
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = a; b < 3; ++b)
          for (unsigned int c = b; c < 3; ++c)
            second[a][b][c] = second[a][c][b] = second[b][a][c] =
              second[b][c][a] = second[c][a][b] = second[c][b][a] =
                second_difference(x, first, {a, b, c});
      // 4 sum_abc T_ab ln[a, c, b] X_ac Y_cb for unit strains X, Y
      constexpr unsigned int number[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
      V                      form[6][6]   = {};
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          for (unsigned int c = 0; c < 3; ++c)
            form[number[a][c]][number[c][b]] += (a == c ? 1. : 0.5) *
                                                (c == b ? 4. : 2.) * T[a][b] *
                                                second[a][c][b];
      for (unsigned int I = 0; I < 6; ++I)
        for (unsigned int J = I; J < 6; ++J)
          C[I][J] += 0.5 * (form[I][J] + form[J][I]);
    }

    /// M C M^T with what carries stresses from the axes to space by @p f; the
    /// upper triangle row by row.
    void
    push_forward(const V (&f)[3][3], const V (&C)[6][6], V *moduli)
    {
      V M[6][6], MC[6][6];
      for (unsigned int I = 0; I < 6; ++I)
        for (unsigned int K = 0; K < 6; ++K)
          {
            const unsigned int i = voigt_pairs[I][0], j = voigt_pairs[I][1],
                               a = voigt_pairs[K][0], b = voigt_pairs[K][1];
            M[I][K] = f[i][a] * f[j][b];
            if (K > 2)
              M[I][K] += f[i][b] * f[j][a];
          }
      for (unsigned int I = 0; I < 6; ++I)
        for (unsigned int K = 0; K < 6; ++K)
          {
            MC[I][K] = V{};
            for (unsigned int L = 0; L < 6; ++L)
              MC[I][K] += M[I][L] * C[L < K ? L : K][L < K ? K : L];
          }
      for (unsigned int I = 0; I < 6; ++I)
        for (unsigned int J = I; J < 6; ++J, ++moduli)
          {
            *moduli = V{};
            for (unsigned int K = 0; K < 6; ++K)
              *moduli += MC[I][K] * M[J][K];
          }
    }
  } // namespace

  LogarithmicLaw::Strain
  LogarithmicLaw::strain_of(const V (&h)[3][3])
  {
    Strain result;
    V      C[3][3];
    right_strain(h, C);
    eigensystem(C, result.squares, result.axes);
    for (unsigned int a = 0; a < 3; ++a)
      result.logarithms[a] = 0.5 * log1p(result.squares[a]);
    return result;
  }

  void
  LogarithmicLaw::stress(const V (&h)[3][3],
                         const V *before,
                         V       *after,
                         V (&tau)[3][3]) const
  {
    const Strain strain = strain_of(h);
    V            T[3][3], first[3][3], f[3][3];
    stress_in_axes(strain, before, after, T);
    first_differences(strain.squares, strain.logarithms, first);
    deform(h, strain.axes, f);
    V fS[3][3];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int b = 0; b < 3; ++b)
        fS[i][b] = f[i][0] * (first[0][b] * T[0][b]) +
                   f[i][1] * (first[1][b] * T[1][b]) +
                   f[i][2] * (first[2][b] * T[2][b]);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        tau[i][j] = tau[j][i] =
          fS[i][0] * f[j][0] + fS[i][1] * f[j][1] + fS[i][2] * f[j][2];
  }

  void
  LogarithmicLaw::tangent(const V (&h)[3][3], const V *before, V *moduli) const
  {
    const Strain strain = strain_of(h);
    V            T[3][3], C[6][6], first[3][3], f[3][3];
    moduli_in_axes(strain, before, T, C);
    first_differences(strain.squares, strain.logarithms, first);
    for (unsigned int I = 0; I < 6; ++I)
      for (unsigned int J = I; J < 6; ++J)
        C[I][J] *= first[voigt_pairs[I][0]][voigt_pairs[I][1]] *
                   first[voigt_pairs[J][0]][voigt_pairs[J][1]];
    add_curvature(strain.squares, first, T, C);
    deform(h, strain.axes, f);
    push_forward(f, C, moduli);
  }
} // namespace mortise
