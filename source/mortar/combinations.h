// Linear combinations of multipliers, which are known by their dofs; only
// sources of this room include it.
#pragma once

#include <deal.II/base/types.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace mortise
{
  using Combination =
    std::vector<std::pair<dealii::types::global_dof_index, double>>;

  /// to += factor * other
  inline void
  add(Combination &to, const double factor, const Combination &other)
  {
    for (const auto &[dof, weight] : other)
      {
        const auto found =
          std::find_if(to.begin(), to.end(), [dof = dof](const auto &entry) {
            return entry.first == dof;
          });
        if (found == to.end())
          to.emplace_back(dof, factor * weight);
        else
          found->second += factor * weight;
      }
  }
} // namespace mortise
