// Differences between the versions of deal.II from 9.4 on; the only file that
// tests a version.
#pragma once

#include <deal.II/base/config.h>

#if DEAL_II_VERSION_GTE(9, 6, 0)
#  include <optional>
#else
#  include <deal.II/base/std_cxx17/optional.h>
#endif

namespace mortise::compatibility
{
#if DEAL_II_VERSION_GTE(9, 6, 0)
  using std::optional;
#else
  using dealii::std_cxx17::optional;
#endif

  /// True if FESystem asks an element of tetrahedra for its degrees of freedom
  /// on a face in all orientations of a triangle; before, it knew those of a
  /// quadrilateral only.
  constexpr bool system_orders_triangles = DEAL_II_VERSION_GTE(9, 5, 0);
} // namespace mortise::compatibility
