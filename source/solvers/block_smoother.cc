// See block_smoother.h.
#include <mortise/solvers/block_smoother.h>
#include <mortise/solvers/epetra_tools.h>

#include <Teuchos_LAPACK.hpp>

#include <algorithm>

namespace mortise
{
  bool
  BlockSmoother::initialize(const Epetra_CrsMatrix &matrix, const std::vector<std::vector<int>> &rows)
  {
    this->matrix = &matrix;
    blocks.clear();
    Teuchos::LAPACK<int, double> lapack;
    std::vector<int>             position(matrix.NumMyCols(), -1);
    int                          failures = 0;
    for (const auto &block_rows : rows)
      {
        Block     block;
        const int n = static_cast<int>(block_rows.size());
        block.rows  = block_rows;
        block.cholesky.assign(n * n, 0.);
        for (int i = 0; i < n; ++i)
          position[block_rows[i]] = i;
        for (int i = 0; i < n; ++i)
          {
            const EpetraRow row(matrix, block_rows[i]);
            for (int k = 0; k < row.length; ++k)
              if (const int j = position[row.columns[k]]; j >= 0)
                block.cholesky[i + j * n] = row.values[k];
          }
        for (int i = 0; i < n; ++i)
          position[block_rows[i]] = -1;
        int info = 0;
        lapack.POTRF('L', n, block.cholesky.data(), n, &info);
        failures += info == 0 ? 0 : 1;
        blocks.push_back(std::move(block));
      }
    workspace.resize(largest_block());
    return failures == 0;
  }

  unsigned int
  BlockSmoother::largest_block() const
  {
    std::size_t n = 0;
    for (const auto &block : blocks)
      n = std::max(n, block.rows.size());
    return static_cast<unsigned int>(n);
  }

  void
  BlockSmoother::relax(const Block &block, double *x, const double *r) const
  {
    const int n       = static_cast<int>(block.rows.size());
    const int n_local = matrix->NumMyRows();
    for (int i = 0; i < n; ++i)
      {
        const EpetraRow row(*matrix, block.rows[i]);
        double          sum = r[block.rows[i]];
        for (int k = 0; k < row.length && row.columns[k] < n_local; ++k)
          sum -= row.values[k] * x[row.columns[k]];
        workspace[i] = sum;
      }
    Teuchos::LAPACK<int, double> lapack;
    int                          info = 0;
    lapack.POTRS('L', n, 1, block.cholesky.data(), n, workspace.data(), n, &info);
    for (int i = 0; i < n; ++i)
      x[block.rows[i]] += workspace[i];
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
