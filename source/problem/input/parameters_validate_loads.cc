#include <mortise/base/error.h>
#include <mortise/base/expression.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/input/formulation.h>
#include <mortise/problem/input/parameter_file.h>

#include <cmath>
#include <sstream>

#include "parameter_checks.h"

namespace mortise
{
  void
  check_expression(const std::string &where,
                   const std::string &text,
                   const double       time)
  {
    const Expression expression(text, where, time);
    if (!expression.is_constant() || expression.depends_on_time())
      return;
    const double value = expression.value(dealii::Point<3>());
    const double size  = std::fabs(value);
    if (value == 0. || (size >= smallest_number && size <= largest_number))
      return;
    std::ostringstream message;
    message << where << ": got " << in_quotes(text) << ", which is " << value
            << "; allowed: " << allowed_numbers();
    throw InputError(message.str());
  }

  void
  check_number(const Parameters  &parameters,
               const std::string &path,
               const std::string &text,
               const std::string &component)
  {
    const std::string where = parameters.where(path) + component;
    const double      time  = parameters.steps.first_time();
    if (text == "-" || text == "exact" || text.empty() ||
        !Expression(text, where, time).is_constant())
      throw InputError(where + ": got " + in_quotes(text) +
                       "; allowed: an expression in t; 0 for nothing");
    check_expression(where, text, time);
  }

  namespace
  {
    /// @p text is "exact" in a scene with an exact solution, or an expression.
    /// @p component: ", component x" or "".
    void
    check_field(const Parameters  &parameters,
                const std::string &path,
                const std::string &text,
                const std::string &component = "")
    {
      if (text != "exact")
        check_expression(parameters.where(path) + component,
                         text,
                         parameters.steps.first_time());
      else if (parameters.exact_solution.kind == ExactKind::none)
        parameters.fail(path,
                        "\"exact\" in a scene without an exact solution",
                        "an expression, or give Exact solution/Displacement");
    }

    /// Components, if there are any, are fields, or "-" if @p may_be_free.
    void
    check_components(const Parameters                &parameters,
                     const std::string               &path,
                     const std::optional<Components> &components,
                     const bool                       may_be_free = false)
    {
      static const char *const names[] = {"x", "y", "z"};
      for (unsigned int d = 0; components && d < 3; ++d)
        {
          const std::string &text = (*components)[d];
          if (text == "-" && may_be_free)
            continue;
          if (text == "-" || text.empty())
            parameters.fail(
              path,
              in_quotes(text) + " as component " + names[d],
              may_be_free ?
                "an expression in x, y, z, - (free), or exact" :
                "an expression in x, y, z, or exact; 0 for nothing");
          check_field(parameters,
                      path,
                      text,
                      std::string(", component ") + names[d]);
        }
    }

    void
    check_total(const Parameters                &parameters,
                const std::string               &path,
                const std::optional<Components> &total,
                const bool                       may_be_free = false)
    {
      for (unsigned int d = 0; total && d < 3; ++d)
        if (!may_be_free || (*total)[d] != "-")
          check_number(parameters,
                       path,
                       (*total)[d],
                       std::string(", component ") + "xyz"[d]);
    }

    /// The named exact solutions take the pressures of the scene: they cannot
    /// give them.
    void
    check_loads_of_named_solution(const Parameters         &parameters,
                                  const std::string        &section,
                                  const BoundaryParameters &boundary)
    {
      const std::string allowed =
        "a constant Pressure, from which the named exact solution follows";
      if (boundary.pressure == "exact")
        parameters.fail(section + "/Pressure", "\"exact\"", allowed);
      if (boundary.traction)
        parameters.fail(section + "/Traction",
                        in_quotes(joined(*boundary.traction)),
                        allowed);
      if (boundary.force)
        parameters.fail(section + "/Force",
                        in_quotes(joined(*boundary.force)),
                        allowed);
      if (boundary.moment)
        parameters.fail(section + "/Moment",
                        in_quotes(joined(*boundary.moment)),
                        allowed);
    }

    void
    check_boundary(const Parameters         &parameters,
                   const std::string        &section,
                   const BoundaryParameters &boundary,
                   const std::string        &name)
    {
      check_components(parameters, section + "/Traction", boundary.traction);
      check_total(parameters, section + "/Force", boundary.force);
      check_total(parameters, section + "/Moment", boundary.moment);
      check_total(parameters,
                  section + "/Rotation",
                  boundary.rotation,
                  boundary.is_rigid());
      if (boundary.reference_point && !boundary.force && !boundary.rotation &&
          !boundary.is_rigid())
        parameters.fail(section + "/Reference point",
                        "a point without a Force or a Rotation",
                        "nothing, a Force, a Rotation, or Coupling = rigid");
      if (boundary.is_rigid())
        check_total(parameters,
                    section + "/Displacement",
                    boundary.displacement,
                    true);
      check_components(parameters,
                       section + "/Displacement",
                       boundary.displacement,
                       true);
      if (boundary.pressure)
        check_field(parameters, section + "/Pressure", *boundary.pressure);
      if (boundary.pressure_follows && !boundary.pressure)
        parameters.fail(section + "/Pressure follows",
                        "a value without Pressure",
                        "auto, or a Pressure");
      const ExactKind kind = parameters.exact_solution.kind;
      if ((kind == ExactKind::thick_sphere ||
           kind == ExactKind::thick_cylinder) &&
          (name == "inside" || name == "outside"))
        check_loads_of_named_solution(parameters, section, boundary);
    }

    /// A temperature and what a body does with it belong together.
    void
    check_temperature(const Parameters     &parameters,
                      const std::string    &section,
                      const BodyParameters &body)
    {
      const std::string path      = section + "/Temperature",
                        expansion = section + "/Material/Thermal expansion";
      if (body.temperature && body.material.thermal_expansion == 0.)
        parameters.fail(path,
                        in_quotes(*body.temperature) +
                          " in a body without Material/Thermal expansion",
                        "none, or a Thermal expansion");
      if (!body.temperature && body.material.thermal_expansion != 0.)
        parameters.fail(expansion,
                        "one in a body without Temperature",
                        "0, or a Temperature");
      if (!body.temperature)
        return;
      check_expression(parameters.where(path),
                       *body.temperature,
                       parameters.steps.first_time());
      const ExactKind kind = parameters.exact_solution.kind;
      if (kind == ExactKind::thick_sphere || kind == ExactKind::thick_cylinder)
        parameters.fail(path,
                        in_quotes(*body.temperature),
                        "none: the named exact solutions know no temperature");
      if (kind == ExactKind::expressions && body.material.poisson_ratio == 0.5)
        parameters.fail(path,
                        in_quotes(*body.temperature) +
                          " with an exact solution and Poisson ratio 0.5",
                        "none, or a smaller ratio");
    }

    /// Body force, tractions, pressures and displacements.
    void
    check_body(const Parameters &parameters, const BodyParameters &body)
    {
      const std::string section = "Body " + body.name;
      validate(body.mesh, parameters.where(section + "/Mesh"));
      make_material(body.material,
                    is_mixed(body),
                    [&](const std::string &name) {
                      return parameters.where(section + "/Material/" + name);
                    });
      check_components(parameters, section + "/Body force", body.body_force);
      check_temperature(parameters, section, body);
      for (const PointSupport &support : body.supports)
        check_components(parameters,
                         section + "/Displacement at",
                         support.displacement,
                         true);
      for (const auto &[name, boundary] : body.boundaries)
        check_boundary(parameters,
                       section + "/Boundary " + name,
                       boundary,
                       name);
    }

    /// Gravity needs something that it acts on.
    void
    check_gravity(const Parameters &parameters)
    {
      if (!parameters.gravity)
        return;
      for (const std::string &text : *parameters.gravity)
        if (text == "exact")
          parameters.fail("Gravity", "\"exact\"", "expressions in x, y, z, t");
      check_components(parameters, "Gravity", parameters.gravity);
      for (const BodyParameters &body : parameters.bodies)
        if (body.material.density > 0.)
          return;
      parameters.fail("Gravity",
                      in_quotes(joined(*parameters.gravity)) +
                        " with no body that has a Material/Density",
                      "none, or a Density of the bodies that have a weight");
    }

    void
    check_exact_solution(const Parameters &parameters)
    {
      const ExactSolutionParameters &exact = parameters.exact_solution;
      const std::string              path  = "Exact solution/Displacement";
      if (exact.kind != ExactKind::expressions)
        return;
      for (const std::string &text : exact.displacement)
        if (text == "exact" || text == "-" || text.empty())
          parameters.fail(path, in_quotes(text), "an expression in x, y, z");
      check_components(parameters, path, exact.displacement);
    }
  } // namespace

  void
  check_loads(const Parameters &parameters)
  {
    for (const BodyParameters &body : parameters.bodies)
      check_body(parameters, body);
    check_gravity(parameters);
    check_exact_solution(parameters);
  }
} // namespace mortise
