// Matrices along one direction of a three-dimensional array, for what is done
// once per cell. It never vectorises over cells (see
// operators/tensor_kernel.h).
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
    out.values.assign(std::size_t(n_blocks) * m * step, 0.);
    for (unsigned int block = 0; block < n_blocks; ++block)
      for (unsigned int i = 0; i < m; ++i)
        {
          double *to = &out.values[(std::size_t(block) * m + i) * step];
          for (unsigned int j = 0; j < n; ++j)
            {
              const double  factor = matrix(i, j);
              const double *from =
                &in.values[(std::size_t(block) * n + j) * step];
              for (unsigned int k = 0; k < step; ++k)
                to[k] += factor * from[k];
            }
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
