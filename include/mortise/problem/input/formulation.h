// Which bodies have a pressure of their own, and what that asks of the other
// parameters.
#pragma once

#include <mortise/problem/input/parameters.h>

#include <functional>
#include <set>

namespace mortise
{
  /// All that the parameters name for cells of @p body.
  std::set<unsigned int>
  given_degrees(const BodyParameters &body);

  void
  change_degrees(
    BodyParameters                                         &body,
    const std::function<unsigned int(unsigned int degree)> &changed);

  /// The pressure has one less, and is continuous.
  constexpr unsigned int least_mixed_degree = 2;

  /// Raise degrees of one where they keep a body from the mixed form, in which
  /// it is to be otherwise.
  void
  raise_to_mixed_form(BodyParameters &body);

  /// Is the body in mixed form? As asked; by itself from nu = 0.49 on, but
  /// below 0.5 only if all its degrees are above one, which the form needs.
  bool
  is_mixed(const BodyParameters &body);

  /// Does the body lock: displacement form, of its own choice, with nu = 0.49
  /// or more?
  bool
  locks(const BodyParameters &body);

  /// Throws InputError for a form that does not exist with the material, the
  /// degrees, the solver or the exact solution of the scene.
  void
  check_formulations(const Parameters &parameters);
} // namespace mortise
