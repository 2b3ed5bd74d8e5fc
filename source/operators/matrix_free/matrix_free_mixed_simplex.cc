// The kernels behind MatrixFreeElasticity in mixed form on tetrahedra.
#include <mortise/operators/matrix_free/nonlinear_kernel_on.h>
#include <mortise/operators/matrix_free/simplices.h>

namespace mortise
{
  template <typename Number>
  std::unique_ptr<typename MatrixFreeElasticity<Number>::Kernel>
  MatrixFreeElasticity<Number>::make_mixed_simplex_kernel(
    const CellBatches<Number> &cells)
  {
    return with_degree<2>(cells.degree, [&](const auto degree) {
      return make_mixed_kernel_on<Simplices<Number, degree>,
                                  SimplexPressures<Number, degree>>(cells);
    });
  }

  template std::unique_ptr<MatrixFreeElasticity<double>::Kernel>
  MatrixFreeElasticity<double>::make_mixed_simplex_kernel(
    const CellBatches<double> &);
} // namespace mortise
