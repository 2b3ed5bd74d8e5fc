// What scenes with laws of material that are not linear, and contact that
// follows the bodies, do not have yet.
#include <mortise/base/quotes.h>
#include <mortise/base/run_log.h>
#include <mortise/problem/input/formulation.h>
#include <mortise/problem/input/interface_law.h>
#include <mortise/problem/input/periodic_cell.h>

#include <algorithm>

#include "parameter_checks.h"

namespace mortise
{
  namespace
  {
    /// Of a scene with nonlinear laws: its dual problem needs a tangent that is
    /// that of the whole way, without contact.
    void
    check_quantity(const Parameters &parameters)
    {
      const std::string what =
                          in_quotes(parameters.adaptivity.quantity) + " with ",
                        instead = "nothing, which means the energy norm";
      for (const BodyParameters &body : parameters.bodies)
        if (body.material.law == "J2 plasticity")
          parameters.fail("Adaptivity/Quantity",
                          what + "Law = J2 plasticity of body " + body.name,
                          instead);
      for (const InterfaceParameters &interface : parameters.interfaces)
        if (is_one_sided(interface.law))
          parameters.fail("Adaptivity/Quantity",
                          what + "Law = " + name_of(interface.law) +
                            " of interface " + interface.name +
                            " and nonlinear laws of bodies",
                          instead);
    }
  } // namespace

  namespace
  {
    /// What keeps @p interface from following the bodies; empty: nothing.
    std::string
    obstacle_to_following(const Parameters          &parameters,
                          const InterfaceParameters &interface)
    {
      if (!is_one_sided(interface.law) && interface.law != Law::slide)
        return "Law = " + name_of(interface.law);
      if (interface.ignores_mesh_gap)
        return "Mesh gap = ignored";
      if (parameters.steps.by_arc_length)
        return "Steps/Control = arc length";
      return "";
    }
  } // namespace

  void
  choose_sliding(Parameters &parameters)
  {
    for (InterfaceParameters &interface : parameters.interfaces)
      {
        // a tie keeps its pairs
        if (interface.sliding == "small" || interface.is_support ||
            interface.law == Law::tie)
          continue;
        const auto finite = [&](const SideParameters &side) {
          return side.body < parameters.bodies.size() &&
                 is_finite(parameters.bodies[side.body].material);
        };
        const std::string obstacle =
          obstacle_to_following(parameters, interface);
        if (interface.sliding == "finite" && !obstacle.empty())
          parameters.fail("Interface " + interface.name + "/Sliding",
                          "finite with " + obstacle,
                          "auto or small");
        interface.follows_bodies =
          obstacle.empty() &&
          (interface.sliding == "finite" || finite(interface.slave) ||
           finite(interface.master));
      }
  }

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
    const auto        body      = std::find_if(parameters.bodies.begin(),
                                   parameters.bodies.end(),
                                   [](const BodyParameters &any) {
                                     return !is_linear(any.material);
                                   });
    const std::string control   = "Steps/Control";
    const bool        by_length = parameters.steps.by_arc_length;
    if (by_length && parameters.adaptivity.target_error)
      parameters.fail(control,
                      "arc length with Adaptivity/Target error",
                      "load: cycles begin at given loads");
    if (by_length && body == parameters.bodies.end())
      parameters.fail(control,
                      "arc length with bodies of linear laws alone",
                      "load: their loads have no maximum");
    if (body == parameters.bodies.end())
      return;
    for (const BodyParameters &any : parameters.bodies)
      if (by_length && (is_rigid(any.material) ||
                        std::any_of(any.boundaries.begin(),
                                    any.boundaries.end(),
                                    [](const auto &entry) {
                                      return entry.second.is_rigid();
                                    })))
        parameters.fail(control,
                        "arc length with a rigid part of body " + any.name,
                        "load: motions of rigid parts follow from given "
                        "forces");
    for (const InterfaceParameters &interface : parameters.interfaces)
      {
        if (by_length && is_one_sided(interface.law))
          parameters.fail(control,
                          "arc length with Law = " + name_of(interface.law) +
                            " of interface " + interface.name,
                          "load: arc length knows no contact");
        if (by_length && has_free_strain(parameters))
          parameters.fail(control,
                          "arc length with free components of the Mean strain",
                          "load: they follow from given stresses");
        if (by_length && interface.preload)
          parameters.fail(control,
                          "arc length with the Preload of interface " +
                            interface.name,
                          "load: shortenings follow from given forces");
      }
    if (!parameters.adaptivity.quantity.empty())
      check_quantity(parameters);
    const BodyParameters *mixed = nullptr;
    for (const BodyParameters &any : parameters.bodies)
      if (!is_linear(any.material) && is_mixed(any) &&
          any.material.poisson_ratio != 0.5)
        mixed = &any;
    if (mixed && parameters.exact_solution.kind == ExactKind::expressions)
      parameters.fail("Exact solution/Displacement",
                      "expressions with Law = " + mixed->material.law +
                        " in mixed form with Poisson ratio " +
                        RunLog::number(mixed->material.poisson_ratio) +
                        " of body " + mixed->name,
                      "such a body with Formulation = displacement, or with "
                      "Poisson ratio 0.5 and an exact Pressure");
  }
} // namespace mortise
