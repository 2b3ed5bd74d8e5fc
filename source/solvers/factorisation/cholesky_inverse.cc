// See cholesky_inverse.h.
#include <mortise/solvers/factorisation/cholesky_inverse.h>
#include <mortise/solvers/pseudo_random.h>

#include <cmath>

namespace mortise
{
  namespace
  {
    /// The largest relative correction by which a solution may be wrong. For
    /// vertices it is 2e-7 to 6e-7 with moduli that are 1e6 apart. For C it is
    /// 4e-7 to 9e-6 (p = 2..8) where no side is much stiffer, and 2e-5, 7e-5,
    /// 4e-4, 8e-3 with a slave 10, 100, 1e3, 1e6 times stiffer than a coarser
    /// master: none, one, two, three or four iterations more.
    constexpr double largest_correction = 1e-4;

    /// By how much a second solve corrects a first one, in the norm of the
    /// matrix.
    template <typename Inverse, typename Product>
    double
    relative_correction(const Inverse &inverse,
                        const Product &product,
                        const Vector  &zero)
    {
      Vector b(zero), x(zero), y(zero);
      for (const auto i : y.locally_owned_elements())
        y(i) = pseudo_random(i);
      product(b, y);
      inverse.solve(x.begin(), b.begin());
      product(y, x);
      b -= y;
      inverse.solve(y.begin(), b.begin());
      product(b, x);
      const double energy_x = b * x;
      product(b, y);
      const double energy_y = b * y;
      return energy_x == 0. ? 0. : std::sqrt(std::abs(energy_y) / energy_x);
    }
  } // namespace

  template <typename Work>
  bool
  CholeskyInverse<Work>::initialize(const RowsByNode &rows,
                                    const Product    &product,
                                    const Vector     &zero,
                                    const bool        allow_single)
  {
    const MPI_Comm comm = zero.get_mpi_communicator();
    if (allow_single)
      {
        single_precision = std::make_unique<SparseCholesky<float, Work>>();
        if (single_precision->initialize(rows, comm) &&
            relative_correction(*single_precision, product, zero) <
              largest_correction)
          return true;
        single_precision.reset();
      }
    double_precision = std::make_unique<SparseCholesky<double>>();
    return double_precision->initialize(rows, comm);
  }

  template class CholeskyInverse<float>;
  template class CholeskyInverse<double>;
} // namespace mortise
