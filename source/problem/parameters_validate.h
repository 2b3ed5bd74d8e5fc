// What the checks of parameters share. It never checks what needs a mesh.
#pragma once

#include <mortise/base/error.h>
#include <mortise/problem/parameters.h>

#include <sstream>
#include <string>

namespace mortise
{
  /// Throw InputError: what was @p got at @p path, and what is allowed.
  template <typename T>
  [[noreturn]] void
  fail(const Parameters  &parameters,
       const std::string &path,
       const T           &got,
       const std::string &allowed)
  {
    std::ostringstream text;
    text << got;
    throw InputError(parameters.where(path) + ": got " + text.str() +
                     "; allowed: " + allowed);
  }

  /// Body force, tractions, pressures and displacements of @p body.
  void
  check_fields(const Parameters &parameters, const BodyParameters &body);

  void
  check_exact_solution(const Parameters &parameters);
} // namespace mortise
