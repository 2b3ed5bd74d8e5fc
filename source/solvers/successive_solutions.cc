#include <mortise/solvers/successive_solutions.h>

#include <cmath>

namespace mortise
{
  SystemVector
  SuccessiveSolutions::start(const SystemVector   &rhs,
                             const ScaledResidual &residual) const
  {
    SystemVector x = basis.front().x;
    scale(x, 0.);
    for (const Pair &pair : basis)
      add_scaled(x, residual.product(pair.rhs, rhs), pair.x);
    return x;
  }

  void
  SuccessiveSolutions::add(const SystemVector   &rhs,
                           const SystemVector   &x,
                           const ScaledResidual &residual)
  {
    // less than this would make much of what the solver left
    constexpr double least_new = 1e-3;
    const double     norm      = residual.norm(rhs);
    if (capacity == 0 || !(norm > 0.) || !std::isfinite(norm))
      return;
    if (basis.size() == capacity)
      basis.clear();
    Pair pair{rhs, x};
    for (const Pair &other : basis)
      {
        const double factor = residual.product(other.rhs, pair.rhs);
        add_scaled(pair.rhs, -factor, other.rhs);
        add_scaled(pair.x, -factor, other.x);
      }
    const double rest = residual.norm(pair.rhs);
    if (rest <= least_new * norm)
      return;
    scale(pair.rhs, 1. / rest);
    scale(pair.x, 1. / rest);
    basis.push_back(std::move(pair));
  }
} // namespace mortise
