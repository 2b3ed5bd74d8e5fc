// Matrices along one direction of a three-dimensional array, for what is done
// once per cell.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <vector>

namespace mortise
{
  /// n[0] x n[1] x n[2] numbers, the first index fastest.
  struct TensorArray
  {
    std::array<unsigned int, 3> n;
    std::vector<double>         values;
  };

  /// out = matrix in for arrays of rows of @p step numbers; the matrix has
  /// @p n columns, or any number if that is zero.
  template <unsigned int n>
  inline void
  combine_rows(const dealii::FullMatrix<double> &matrix,
               const unsigned int                step,
               const double *__restrict in,
               double *__restrict out)
  {
    const unsigned int n_columns = n > 0 ? n : matrix.n();
    for (unsigned int i = 0; i < matrix.m(); ++i)
      {
        const double *factors = &matrix(i, 0);
        for (unsigned int k = 0; k < step; ++k)
          {
            double sum = 0.;
#pragma GCC unroll 16
            for (unsigned int j = 0; j < n_columns; ++j)
              sum += factors[j] * in[j * step + k];
            out[i * step + k] = sum;
          }
      }
  }

  /// The same with a number of columns that the compiler knows, up to @p n.
  template <unsigned int n = 9>
  inline void
  combine_rows_of_number(const dealii::FullMatrix<double> &matrix,
                         const unsigned int                step,
                         const double                     *in,
                         double                           *out)
  {
    if (n == 0 || matrix.n() == n)
      combine_rows<n>(matrix, step, in, out);
    else if constexpr (n > 0)
      combine_rows_of_number<n - 1>(matrix, step, in, out);
  }

  /// The array with @p matrix (m x n[d]) applied along direction @p d.
  inline TensorArray
  apply_along_direction(const dealii::FullMatrix<double> &matrix,
                        const unsigned int                d,
                        const TensorArray                &in)
  {
    TensorArray out{in.n, {}};
    out.n[d]             = matrix.m();
    const unsigned int n = in.n[d], m = out.n[d];
    unsigned int       step = 1; // between neighbours along d
    for (unsigned int e = 0; e < d; ++e)
      step *= in.n[e];
    const unsigned int n_blocks = in.values.size() / (step * n);
    out.values.resize(std::size_t(n_blocks) * m * step);
    for (unsigned int block = 0; block < n_blocks; ++block)
      {
        const double *from = &in.values[std::size_t(block) * n * step];
        double       *to   = &out.values[std::size_t(block) * m * step];
        combine_rows_of_number(matrix, step, from, to);
      }
    return out;
  }

  inline dealii::FullMatrix<double>
  transposed(const dealii::FullMatrix<double> &matrix)
  {
    dealii::FullMatrix<double> result(matrix.n(), matrix.m());
    result.copy_transposed(matrix);
    return result;
  }

  /// One matrix per direction.
  inline TensorArray
  apply_product(const dealii::FullMatrix<double> &first,
                const dealii::FullMatrix<double> &second,
                const dealii::FullMatrix<double> &third,
                const TensorArray                &in)
  {
    return apply_along_direction(
      third,
      2,
      apply_along_direction(second, 1, apply_along_direction(first, 0, in)));
  }

  /// Functions of one direction at the points of a rule: (point, function).
  struct LineTable
  {
    dealii::FullMatrix<double> values, slopes;
  };

  /// The derivative in direction @p d, from tables of all directions; the
  /// function itself for d = 3.
  inline TensorArray
  apply_derivative(const std::array<LineTable, 3> &lines,
                   const unsigned int              d,
                   const TensorArray              &in)
  {
    return apply_product(d == 0 ? lines[0].slopes : lines[0].values,
                         d == 1 ? lines[1].slopes : lines[1].values,
                         d == 2 ? lines[2].slopes : lines[2].values,
                         in);
  }
} // namespace mortise
