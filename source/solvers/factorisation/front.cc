// See front.h.
#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>
#include <mortise/solvers/factorisation/front.h>

namespace mortise
{
  template <typename Number>
  Front<Number>::Front(const Supernode     &supernode,
                       Number              *columns,
                       const int            stride,
                       std::vector<Number> &rest)
    : width(supernode.width)
    , n_below(supernode.rows.size())
    , stride(stride)
    , columns(columns)
    , rest(rest)
  {
    rest.assign(std::size_t(n_below) * n_below, Number());
  }

  template <typename Number>
  bool
  Front<Number>::eliminate()
  {
    using namespace Teuchos;
    const BLAS<int, Number>   blas;
    const LAPACK<int, Number> lapack;
    Number                   *below = columns + width;
    const Number              one   = 1;
    int                       info  = 0;
    lapack.POTRF('L', width, columns, stride, &info);
    if (info != 0)
      return false;
    if (n_below > 0)
      {
        blas.TRSM(RIGHT_SIDE,
                  LOWER_TRI,
                  TRANS,
                  NON_UNIT_DIAG,
                  n_below,
                  width,
                  one,
                  columns,
                  stride,
                  below,
                  stride);
        blas.SYRK(LOWER_TRI,
                  NO_TRANS,
                  n_below,
                  width,
                  -one,
                  below,
                  stride,
                  one,
                  rest.data(),
                  n_below);
      }
    lapack.TRTRI('L', 'N', width, columns, stride, &info);
    if (n_below > 0)
      blas.TRMM(RIGHT_SIDE,
                LOWER_TRI,
                NO_TRANS,
                NON_UNIT_DIAG,
                n_below,
                width,
                -one,
                columns,
                stride,
                below,
                stride);
    return info == 0;
  }

  template class Front<float>;
  template class Front<double>;
} // namespace mortise
