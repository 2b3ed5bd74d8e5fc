// Checks of the values of parameters that several sections share.
#pragma once

#include <mortise/problem/input/parameters.h>

#include <string>

namespace mortise
{
  /// @p text parses at the first @p time; if it is the same everywhere, a run can use the number.
  /// What varies is watched while it is evaluated (FieldChecks).
  void
  check_expression(const std::string &where,
                   const std::string &text,
                   double             time);

  /// @p text is a number at any time. @p component: ", component x" or "".
  void
  check_number(const Parameters  &parameters,
               const std::string &path,
               const std::string &text,
               const std::string &component = "");

  /// Materials, loads, temperatures and displacements of bodies, gravity, and
  /// the exact solution.
  void
  check_loads(const Parameters &parameters);

  /// Set which interfaces follow the bodies.
  void
  choose_sliding(Parameters &parameters);

  /// What goes together with laws of material that are not linear.
  void
  check_nonlinear_laws(const Parameters &parameters);
} // namespace mortise
