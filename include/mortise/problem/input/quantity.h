// What parameters say of a run with a target: the number whose error is to
// become small.
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

  /// Nothing where Adaptivity/Quantity is empty; throws InputError where it
  /// names nothing. @p parameters must live on.
  std::optional<Quantity>
  given_quantity(const Parameters &parameters);

  /// Throws InputError where a target goes together with what it cannot.
  void
  check_adaptivity(const Parameters &parameters);

  /// With a target linear solves need no more digits than leave it what it is.
  Parameters
  with_tolerance(Parameters parameters);
} // namespace mortise
