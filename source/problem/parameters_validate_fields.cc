#include <mortise/base/expression.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>

#include <cmath>

#include "parameters_validate.h"

namespace mortise
{
  namespace
  {
    /// @p text parses; if it is the same everywhere, a run can use the number.
    /// What varies is watched while it is evaluated (FieldChecks).
    void
    check_expression(const std::string &where, const std::string &text)
    {
      const Expression expression(text, where);
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

    /// Components are "-" (if @p may_be_free), "exact" (if there is an exact solution), or parse.
    void
    check_components(const Parameters  &parameters,
                     const std::string &path,
                     const Components  &components,
                     const bool         may_be_free)
    {
      static const char *const names[] = {"x", "y", "z"};
      for (unsigned int d = 0; d < 3; ++d)
        {
          const std::string &text = components[d];
          if (text == "-" && may_be_free)
            continue;
          if (text == "-" || text.empty())
            fail(parameters,
                 path,
                 in_quotes(text) + " as component " + names[d],
                 may_be_free ?
                   "an expression in x, y, z, - (free), or exact" :
                   "an expression in x, y, z, or exact; 0 for nothing");
          if (text != "exact")
            check_expression(parameters.where(path) + ", component " + names[d],
                             text);
          else if (parameters.exact_solution.kind == ExactKind::none)
            fail(parameters,
                 path,
                 "\"exact\" in a scene without an exact solution",
                 "an expression, or give Exact solution/Displacement");
        }
    }

    void
    check_boundary(const Parameters         &parameters,
                   const std::string        &section,
                   const BoundaryParameters &boundary)
    {
      if (boundary.traction)
        check_components(parameters,
                         section + "/Traction",
                         *boundary.traction,
                         false);
      if (boundary.displacement)
        check_components(parameters,
                         section + "/Displacement",
                         *boundary.displacement,
                         true);
      if (!boundary.pressure)
        return;
      const std::string path = section + "/Pressure";
      if (*boundary.pressure != "exact")
        check_expression(parameters.where(path), *boundary.pressure);
      else if (parameters.exact_solution.kind == ExactKind::none)
        fail(parameters,
             path,
             "\"exact\" in a scene without an exact solution",
             "an expression, or give Exact solution/Displacement");
    }

    /// The named exact solutions take the pressures of the scene: they cannot
    /// give them.
    void
    check_loads_of_named_solution(const Parameters         &parameters,
                                  const std::string        &section,
                                  const std::string        &name,
                                  const BoundaryParameters &boundary)
    {
      const ExactKind kind = parameters.exact_solution.kind;
      if ((kind != ExactKind::thick_sphere &&
           kind != ExactKind::thick_cylinder) ||
          (name != "inside" && name != "outside"))
        return;
      const char *const allowed =
        "a constant Pressure, from which the named exact solution follows";
      if (boundary.pressure == "exact")
        fail(parameters, section + "/Pressure", "\"exact\"", allowed);
      if (boundary.traction)
        fail(parameters,
             section + "/Traction",
             in_quotes(joined(*boundary.traction)),
             allowed);
    }
  } // namespace

  void
  check_fields(const Parameters &parameters, const BodyParameters &body)
  {
    const std::string section = "Body " + body.name;
    if (body.body_force)
      check_components(parameters,
                       section + "/Body force",
                       *body.body_force,
                       false);
    for (const auto &[name, boundary] : body.boundaries)
      {
        check_boundary(parameters, section + "/Boundary " + name, boundary);
        check_loads_of_named_solution(parameters,
                                      section + "/Boundary " + name,
                                      name,
                                      boundary);
      }
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
        fail(parameters, path, in_quotes(text), "an expression in x, y, z");
    check_components(parameters, path, exact.displacement, false);
  }
} // namespace mortise
