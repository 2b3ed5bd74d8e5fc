// Choice between displacement and mixed form of bodies, and its conditions on
// other parameters.
#pragma once

#include <mortise/problem/input/parameters.h>

#include <functional>
#include <set>

namespace mortise
{
  /// All degrees that the parameters give to cells of @p body.
  std::set<unsigned int>
  given_degrees(const BodyParameters &body);

  void
  change_degrees(
    BodyParameters                                         &body,
    const std::function<unsigned int(unsigned int degree)> &changed);

  /// Pressures are continuous and of one degree less.
  constexpr unsigned int least_mixed_degree = 2;

  /// Raise degrees of one in a body that would otherwise be in mixed form.
  void
  raise_to_mixed_form(BodyParameters &body);

  /// Is the body in mixed form? Automatically from nu = 0.49 on, below 0.5 only
  /// if all its degrees are above one.
  bool
  is_mixed(const BodyParameters &body);

  /// Does the body lock: automatic displacement form with nu = 0.49 or more?
  bool
  locks(const BodyParameters &body);

  /// Throws InputError for a form that is impossible with the material,
  /// degrees, solver or exact solution.
  void
  check_formulations(const Parameters &parameters);
} // namespace mortise
