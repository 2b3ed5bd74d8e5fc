// See condensed_interiors.h.
#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>
#include <mortise/operators/assembled/condensed_interiors.h>

namespace mortise
{
  bool
  CondensedInteriors::eliminate(dealii::FullMatrix<double> &matrix,
                                const unsigned int          n_boundary)
  {
    const Teuchos::LAPACK<int, double> lapack;
    const Teuchos::BLAS<int, double>   blas;

    const int N   = static_cast<int>(matrix.m()),
              n_b = static_cast<int>(n_boundary), n_i = N - n_b;
    Cell cell{n_b, n_i, {}, {}};
    // Symmetric, so that rows are columns: below, all is column major.
    double *bb = &matrix(0, 0), *bi = bb + static_cast<std::size_t>(n_b) * N,
           *ii = bi + n_b;
    int info   = 0;
    lapack.POTRF('L', n_i, ii, N, &info);
    if (info != 0)
      return false;

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
    const auto copy = [N](const double *from, const int rows, const int n) {
      std::vector<double> to;
      to.reserve(static_cast<std::size_t>(rows) * n);
      for (int k = 0; k < n; ++k)
        to.insert(to.end(),
                  from + static_cast<std::size_t>(k) * N,
                  from + static_cast<std::size_t>(k) * N + rows);
      return to;
    };
    cell.extension = copy(bi, n_b, n_i);
    if (loaded)
      cell.factor = copy(ii, n_i, n_i);
    cells.push_back(std::move(cell));
    return true;
  }

  std::vector<double>
  CondensedInteriors::condense(const unsigned int      cell,
                               dealii::Vector<double> &load) const
  {
    Assert(loaded, dealii::ExcInternalError());
    const Teuchos::LAPACK<int, double> lapack;
    const Teuchos::BLAS<int, double>   blas;
    const Cell                        &own = cells[cell];
    std::vector<double> particular(load.begin() + own.n_b, load.end());
    blas.GEMV(Teuchos::NO_TRANS,
              own.n_b,
              own.n_i,
              -1.,
              own.extension.data(),
              own.n_b,
              particular.data(),
              1,
              1.,
              load.begin(),
              1);
    int info = 0;
    lapack.POTRS('L',
                 own.n_i,
                 1,
                 own.factor.data(),
                 own.n_i,
                 particular.data(),
                 own.n_i,
                 &info);
    return particular;
  }

  std::vector<double>
  CondensedInteriors::recover(const unsigned int         cell,
                              const std::vector<double> &boundary_values,
                              const std::vector<double> &particular) const
  {
    const Teuchos::BLAS<int, double> blas;
    const Cell                      &own    = cells[cell];
    std::vector<double>              values = particular;
    values.resize(own.n_i);
    blas.GEMV(Teuchos::TRANS,
              own.n_b,
              own.n_i,
              -1.,
              own.extension.data(),
              own.n_b,
              boundary_values.data(),
              1,
              1.,
              values.data(),
              1);
    return values;
  }
} // namespace mortise
