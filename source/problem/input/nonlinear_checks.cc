// What scenes with laws of material that are not linear do not have yet.
#include <mortise/problem/input/interface_law.h>

#include <algorithm>

#include "parameter_checks.h"

namespace mortise
{
  void
  check_nonlinear_laws(const Parameters &parameters)
  {
    for (const BodyParameters &any : parameters.bodies)
      for (const auto &[name, boundary] : any.boundaries)
        if (boundary.pressure_follows.value_or(false) &&
            !is_finite(any.material))
          parameters.fail("Body " + any.name + "/Boundary " + name +
                            "/Pressure follows",
                          "true with Law = " + any.material.law +
                            " at small strain",
                          "auto or false, or a law of finite strain");
    const auto body = std::find_if(parameters.bodies.begin(),
                                   parameters.bodies.end(),
                                   [](const BodyParameters &any) {
                                     return !is_linear(any.material);
                                   });
    if (body == parameters.bodies.end())
      return;
    const std::string got =
      "with Law = " + body->material.law +
      (is_finite(body->material) ? " at finite strain" : "") + " of body " +
      body->name;
    for (const InterfaceParameters &interface : parameters.interfaces)
      {
        const std::string section = "Interface " + interface.name;
        if (interface.law == Law::tresca || interface.friction_coefficient)
          parameters.fail(section + "/Law",
                          name_of(interface.law) + " with friction " + got,
                          "tie, slide, spring, or contact without friction: "
                          "friction knows bodies of linear laws alone");
        if (interface.preload)
          parameters.fail(section + "/Preload",
                          "one " + got,
                          "none: preloads know bodies of linear laws alone");
      }
    if (parameters.adaptivity.target_error)
      parameters.fail("Adaptivity/Target error",
                      "one " + got,
                      "none: estimates know linear laws alone");
    if (parameters.exact_solution.kind != ExactKind::none)
      parameters.fail("Exact solution/Displacement",
                      "one " + got,
                      "none: exact solutions know linear laws alone");
  }
} // namespace mortise
