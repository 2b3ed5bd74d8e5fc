// The kernels behind MatrixFreeElasticity in mixed form on hexahedra.
#include <mortise/operators/matrix_free/hexahedra.h>
#include <mortise/operators/matrix_free/nonlinear_kernel_on.h>

namespace mortise
{
  template <typename Number>
  std::unique_ptr<typename MatrixFreeElasticity<Number>::Kernel>
  MatrixFreeElasticity<Number>::make_mixed_kernel(
    const CellBatches<Number> &cells)
  {
    return with_degree<2>(cells.degree, [&](const auto degree) {
      constexpr int n = degree + 1;
      return make_mixed_kernel_on<Hexahedra<Number, n>,
                                  HexahedralPressures<Number, n>>(cells);
    });
  }

  template std::unique_ptr<MatrixFreeElasticity<double>::Kernel>
  MatrixFreeElasticity<double>::make_mixed_kernel(const CellBatches<double> &);
} // namespace mortise
