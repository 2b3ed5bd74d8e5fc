#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>
#include <mortise/operators/cells/element_schur.h>

#include <stdexcept>

namespace mortise
{
  using namespace dealii;

  FullMatrix<double>
  element_schur(const FullMatrix<double>        &stiffness,
                const FullMatrix<double>        &divergence,
                const std::vector<unsigned int> &free)
  {
    const Teuchos::LAPACK<int, double> lapack;
    const Teuchos::BLAS<int, double>   blas;

    const int n = static_cast<int>(free.size()),
              m = static_cast<int>(divergence.m());
    FullMatrix<double> S(m, m);
    if (n == 0)
      return S;
    // Column major; what is added makes rigid motions regular. Any number from
    // 1e-6 to 1e-2 gives the same iterations.
    constexpr double    regularisation = 1e-4;
    std::vector<double> K(std::size_t(n) * n), X(std::size_t(n) * m);
    for (int j = 0; j < n; ++j)
      {
        for (int i = 0; i < n; ++i)
          K[j * n + i] = stiffness(free[i], free[j]);
        K[j * n + j] *= 1. + regularisation;
        for (int k = 0; k < m; ++k)
          X[k * n + j] = divergence(k, free[j]);
      }
    int info = 0;
    lapack.POTRF('L', n, K.data(), n, &info);
    if (info != 0)
      throw std::runtime_error("the stiffness of a cell is not positive");
    using namespace Teuchos;
    blas.TRSM(LEFT_SIDE,
              LOWER_TRI,
              NO_TRANS,
              NON_UNIT_DIAG,
              n,
              m,
              1.,
              K.data(),
              n,
              X.data(),
              n);
    blas.SYRK(UPPER_TRI, TRANS, m, n, 1., X.data(), n, 0., &S(0, 0), m);
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < j; ++i)
        S(i, j) = S(j, i);
    return S;
  }
} // namespace mortise
