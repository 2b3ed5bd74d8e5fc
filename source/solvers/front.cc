#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>
#include <mortise/operators/tensor_kernel.h>
#include <mortise/solvers/front.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  Front::Front(const Supernode &supernode)
    : width(supernode.width)
    , height(supernode.height())
    , values(std::size_t(height) * height)
  {}

  bool
  Front::eliminate()
  {
    using namespace Teuchos;
    const BLAS<int, double>   blas;
    const LAPACK<int, double> lapack;
    const int                 n    = height - width;
    int                       info = 0;
    lapack.POTRF('L', width, values.data(), height, &info);
    if (info != 0)
      return false;
    if (n > 0)
      {
        double *below = &(*this)(width, 0);
        blas.TRSM(RIGHT_SIDE,
                  LOWER_TRI,
                  TRANS,
                  NON_UNIT_DIAG,
                  n,
                  width,
                  1.,
                  values.data(),
                  height,
                  below,
                  height);
        blas.SYRK(LOWER_TRI,
                  NO_TRANS,
                  n,
                  width,
                  -1.,
                  below,
                  height,
                  1.,
                  &(*this)(width, width),
                  height);
      }
    lapack.TRTRI('L', 'N', width, values.data(), height, &info);
    return info == 0;
  }

  std::vector<double>
  Front::update()
  {
    const int           n = height - width;
    std::vector<double> result(std::size_t(n) * n);
    for (int j = 0; j < n; ++j)
      std::copy_n(&(*this)(width + j, width + j),
                  n - j,
                  &result[j + std::size_t(n) * j]);
    return result;
  }

  template <typename Number>
  AlignedVector<Number>
  Front::panel()
  {
    using namespace Teuchos;
    if (height > width)
      BLAS<int, double>().TRMM(RIGHT_SIDE,
                               LOWER_TRI,
                               NO_TRANS,
                               NON_UNIT_DIAG,
                               height - width,
                               width,
                               -1.,
                               values.data(),
                               height,
                               &(*this)(width, 0),
                               height);
    const std::size_t     stride = padded<Number>(height);
    AlignedVector<Number> result(stride * width);
    for (int j = 0; j < width; ++j)
      for (int i = j; i < height; ++i)
        result[stride * j + i] = static_cast<Number>((*this)(i, j));
    return result;
  }

  template AlignedVector<float>
  Front::panel();
  template AlignedVector<double>
  Front::panel();
} // namespace mortise
