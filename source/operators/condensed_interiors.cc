// See condensed_interiors.h.
#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>
#include <mortise/operators/condensed_interiors.h>

namespace mortise
{
  bool
  CondensedInteriors::eliminate(dealii::FullMatrix<double> &matrix,
                                dealii::Vector<double>     &load,
                                const unsigned int          n_boundary)
  {
    const Teuchos::LAPACK<int, double> lapack;
    const Teuchos::BLAS<int, double>   blas;

    const int N   = static_cast<int>(matrix.m()),
              n_b = static_cast<int>(n_boundary), n_i = N - n_b;
    Cell cell;
    cell.particular.assign(load.begin() + n_b, load.end());
    // Symmetric, so that rows are columns: below, all is column major.
    double *bb = &matrix(0, 0), *bi = bb + static_cast<std::size_t>(n_b) * N,
           *ii = bi + n_b;
    int info   = 0;
    lapack.POTRF('L', n_i, ii, N, &info);
    if (info != 0)
      return false;
    lapack.POTRS('L', n_i, 1, ii, N, cell.particular.data(), n_i, &info);

    // with K_ii = L L^T and Z = K_bi L^{-T}: S = K_bb - Z Z^T, X^T = Z L^{-1}
    using namespace Teuchos;
    blas.TRSM(
      RIGHT_SIDE, LOWER_TRI, TRANS, NON_UNIT_DIAG, n_b, n_i, 1., ii, N, bi, N);
    blas.SYRK(LOWER_TRI, NO_TRANS, n_b, n_i, -1., bi, N, 1., bb, N);
    blas.TRSM(RIGHT_SIDE,
              LOWER_TRI,
              NO_TRANS,
              NON_UNIT_DIAG,
              n_b,
              n_i,
              1.,
              ii,
              N,
              bi,
              N);
    for (int j = 0; j < n_b; ++j)
      for (int i = j + 1; i < n_b; ++i)
        bb[j + static_cast<std::size_t>(i) * N] =
          bb[i + static_cast<std::size_t>(j) * N];
    blas.GEMV(NO_TRANS,
              n_b,
              n_i,
              -1.,
              bi,
              N,
              load.begin() + n_b,
              1,
              1.,
              load.begin(),
              1);

    cell.extension.reserve(static_cast<std::size_t>(n_b) * n_i);
    for (int k = 0; k < n_i; ++k)
      cell.extension.insert(cell.extension.end(),
                            bi + static_cast<std::size_t>(k) * N,
                            bi + static_cast<std::size_t>(k) * N + n_b);
    cells.push_back(std::move(cell));
    return true;
  }

  std::vector<double>
  CondensedInteriors::recover(const unsigned int         cell,
                              const std::vector<double> &boundary_values) const
  {
    const Teuchos::BLAS<int, double> blas;

    std::vector<double> values = cells[cell].particular;
    const int           n_b    = static_cast<int>(boundary_values.size());
    blas.GEMV(Teuchos::TRANS,
              n_b,
              static_cast<int>(values.size()),
              -1.,
              cells[cell].extension.data(),
              n_b,
              boundary_values.data(),
              1,
              1.,
              values.data(),
              1);
    return values;
  }
} // namespace mortise
