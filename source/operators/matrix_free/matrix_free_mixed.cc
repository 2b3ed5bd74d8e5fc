#include <mortise/operators/matrix_free/matrix_free_mixed_kernel_of_size.h>

namespace mortise
{
  using namespace dealii;

  template <typename Number>
  std::unique_ptr<typename MatrixFreeElasticity<Number>::Kernel>
  MatrixFreeElasticity<Number>::make_mixed_kernel(const unsigned int degree)
  {
    switch (degree)
      {
        case 2:
          return std::make_unique<MixedKernelOfSize<3>>();
        case 3:
          return std::make_unique<MixedKernelOfSize<4>>();
        case 4:
          return std::make_unique<MixedKernelOfSize<5>>();
        case 5:
          return std::make_unique<MixedKernelOfSize<6>>();
        case 6:
          return std::make_unique<MixedKernelOfSize<7>>();
        case 7:
          return std::make_unique<MixedKernelOfSize<8>>();
        default:
          AssertThrow(degree == 8, ExcInternalError());
          return std::make_unique<MixedKernelOfSize<9>>();
      }
  }

  template std::unique_ptr<MatrixFreeElasticity<double>::Kernel>
  MatrixFreeElasticity<double>::make_mixed_kernel(unsigned int degree);
} // namespace mortise
