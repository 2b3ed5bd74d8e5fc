// See block_smoother.h.
#include <mortise/solvers/block_smoother.h>

#include <deal.II/base/exceptions.h>

#include <Teuchos_LAPACK.hpp>

#include <algorithm>

namespace mortise
{
  void
  BlockSmoother::initialize(const Epetra_CrsMatrix &matrix, const std::vector<std::vector<int>> &rows)
  {
    this->matrix = &matrix;
    blocks.clear();
    Teuchos::LAPACK<int, double> lapack;
    std::vector<int>             position(matrix.NumMyCols(), -1);
    for (const auto &block_rows : rows)
      {
        Block     block;
        const int n = block_rows.size();
        block.rows  = block_rows;
        block.cholesky.assign(n * n, 0.);
        for (int i = 0; i < n; ++i)
          position[block_rows[i]] = i;
        for (int i = 0; i < n; ++i)
          {
            int     length;
            int    *columns;
            double *values;
            matrix.ExtractMyRowView(block_rows[i], length, values, columns);
            for (int k = 0; k < length; ++k)
              if (position[columns[k]] >= 0)
                block.cholesky[i + position[columns[k]] * n] = values[k];
          }
        for (int i = 0; i < n; ++i)
          position[block_rows[i]] = -1;
        int info = 0;
        lapack.POTRF('L', n, block.cholesky.data(), n, &info);
        AssertThrow(info == 0, dealii::ExcMessage("block not positive definite"));
        blocks.push_back(std::move(block));
      }
    std::stable_sort(blocks.begin(), blocks.end(), [](const Block &a, const Block &b) {
      return a.rows.size() > b.rows.size();
    });
  }

  void
  BlockSmoother::relax(const Block &block, double *x, const double *r) const
  {
    static thread_local std::vector<double> y;
    const int                               n       = block.rows.size();
    const int                               n_local = matrix->NumMyRows();
    y.resize(n);
    for (int i = 0; i < n; ++i)
      {
        int     length;
        int    *columns;
        double *values;
        matrix->ExtractMyRowView(block.rows[i], length, values, columns);
        double sum = r[block.rows[i]];
        for (int k = 0; k < length; ++k)
          if (columns[k] < n_local)
            sum -= values[k] * x[columns[k]];
        y[i] = sum;
      }
    Teuchos::LAPACK<int, double> lapack;
    int                          info = 0;
    lapack.POTRS('L', n, 1, block.cholesky.data(), n, y.data(), n, &info);
    for (int i = 0; i < n; ++i)
      x[block.rows[i]] += y[i];
  }

  void
  BlockSmoother::vmult(double *x, const double *r) const
  {
    std::fill(x, x + matrix->NumMyRows(), 0.);
    for (const auto &block : blocks)
      relax(block, x, r);
    for (auto block = blocks.rbegin(); block != blocks.rend(); ++block)
      relax(*block, x, r);
  }
} // namespace mortise
