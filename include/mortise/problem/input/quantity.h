// The goal of an adaptive run: a component of a displacement or force whose
// error the target limits.
#pragma once

#include <mortise/problem/input/parameters.h>

#include <optional>
#include <string>
#include <variant>

namespace mortise
{
  /// A component of an entry of Output/Points or Output/Resultants.
  struct Quantity
  {
    const Parameters *parameters;
    std::string       name;          ///< "tip, z"
    unsigned int      component = 0; ///< of the displacement or the force
    std::variant<PointQuantity, ResultantQuantity> of;

    /// Index into Parameters::bodies.
    unsigned int
    body() const
    {
      return std::visit([](const auto &any) { return any.body; }, of);
    }
  };

  /// Nothing if Adaptivity/Quantity is empty; throws InputError for an unknown
  /// name. @p parameters must live on.
  std::optional<Quantity>
  given_quantity(const Parameters &parameters);

  /// Throws InputError for parameters that are impossible with a target.
  void
  check_adaptivity(const Parameters &parameters);

  /// @p parameters with the tolerance of linear solves that the target
  /// requires.
  Parameters
  with_tolerance(Parameters parameters);

  /// In a scene with nonlinear laws and without steps: one step in which loads
  /// grow from zero, and which may be cut.
  Parameters
  with_ramp(Parameters parameters);
} // namespace mortise
