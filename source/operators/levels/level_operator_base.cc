// See level_operator_base.h.
#include <mortise/base/types.h>
#include <mortise/operators/levels/level_operator_base.h>

#include <algorithm>
#include <numeric>

namespace mortise
{
  template <typename Number>
  void
  LevelOperatorBase<Number>::average_components(
    LevelVector<Number> &diagonal) const
  {
    for (const unsigned int index : constrained())
      diagonal.local_element(index) = 0;
    for (unsigned int k = 0; k < diagonal.locally_owned_size(); k += dim)
      {
        Number *node = &diagonal.local_element(k);
        if (const auto n = dim - std::count(node, node + dim, Number()); n > 0)
          std::fill_n(node,
                      dim,
                      std::accumulate(node, node + dim, Number()) / n);
      }
    for (const unsigned int index : constrained())
      diagonal.local_element(index) = 1;
  }

  template class LevelOperatorBase<float>;
  template class LevelOperatorBase<double>;
} // namespace mortise
