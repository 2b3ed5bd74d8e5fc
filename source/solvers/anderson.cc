// See anderson.h.
#include <deal.II/lac/lapack_full_matrix.h>

#include <mortise/solvers/anderson.h>

namespace mortise
{
  using namespace dealii;

  std::vector<double>
  anderson_weights(const FullMatrix<double> &products)
  {
    /// Of singular values, beside the largest.
    constexpr double    rounding = 1e-12;
    const unsigned int  m = products.m() - 1; // differences from the newest
    std::vector<double> weights(m + 1, 0.);
    weights[m] = 1.;
    if (m == 0)
      return weights;
    LAPACKFullMatrix<double> of_differences(m, m);
    dealii::Vector<double>   rhs(m), solved(m);
    for (unsigned int a = 0; a < m; ++a)
      {
        rhs(a) = products(m, m) - products(a, m);
        for (unsigned int b = 0; b < m; ++b)
          of_differences(a, b) =
            products(m, m) - products(a, m) - products(m, b) + products(a, b);
      }
    of_differences.compute_inverse_svd(rounding);
    of_differences.vmult(solved, rhs);
    for (unsigned int a = 0; a < m; ++a)
      {
        weights[a] = solved(a);
        weights[m] -= solved(a);
      }
    return weights;
  }
} // namespace mortise
