// A dense matrix that acts on the components of several cells at once, one cell
// per lane of a vector of the compiler. Only sources of kernels include it.
#pragma once

#include <deal.II/base/aligned_vector.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/operators/matrix_free/tensor_kernel.h>

namespace mortise
{
  template <typename Number>
  class DenseMatrix
  {
  public:
    using V = typename Batch<Number>::Vector;

    DenseMatrix() = default;

    explicit DenseMatrix(const dealii::FullMatrix<double> &matrix)
      : n_rows(matrix.m())
      , n_columns(matrix.n())
    {
      entries.reserve(std::size_t(n_rows) * n_columns);
      for (int first = 0; first < n_rows; first += block)
        for (int k = 0; k < n_columns; ++k)
          for (int i = first; i < std::min(first + block, n_rows); ++i)
            entries.push_back(matrix(i, k));
    }

    /// out_c = A in_c, the components of @p in and @p out one after another.
    template <int n_components = 3>
    void
    apply(const V *in, V *out) const
    {
      const Number *a     = entries.data();
      int           first = 0;
      for (; first + block <= n_rows; first += block, a += block * n_columns)
        rows<block, n_components>(a, in, out + first);
      switch (n_rows - first)
        {
          case 1:
            return rows<1, n_components>(a, in, out + first);
          case 2:
            return rows<2, n_components>(a, in, out + first);
          case 3:
            return rows<3, n_components>(a, in, out + first);
        }
    }

  private:
    static constexpr int block = n_register_rows;

    template <int n, int n_components>
    void
    rows(const Number *a, const V *in, V *out) const
    {
      V sum[n_components][n] = {};
      for (int k = 0; k < n_columns; ++k, a += n)
        for (int c = 0; c < n_components; ++c)
          {
            const V u = in[c * n_columns + k];
            for (int i = 0; i < n; ++i)
              sum[c][i] += a[i] * u;
          }
      for (int c = 0; c < n_components; ++c)
        for (int i = 0; i < n; ++i)
          out[c * n_rows + i] = sum[c][i];
    }

    int n_rows = 0, n_columns = 0;
    /// By blocks of rows, these column by column.
    dealii::AlignedVector<Number> entries;
  };
} // namespace mortise
