// What a scene says of its interfaces at one time: members of SceneData.
#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/input/periodic_cell.h>
#include <mortise/problem/scene/scene_data.h>

#include <sstream>

namespace mortise
{
  using namespace dealii;

  std::function<double(const Point<dim> &)>
  SceneData::offset(const InterfaceParameters &given) const
  {
    const std::string where = parameters.where(
      given.path() + (given.is_support ? "/Displacement" : "/Offset"));
    const Expression expression(given.offset, where, time);
    if (expression.is_constant() && !expression.depends_on_time() &&
        expression.value(Point<dim>()) == 0.)
      return {};
    const std::string what = where + ": " + in_quotes(given.offset);
    return [expression, what, factor = factor, &watch = checks](
             const Point<dim> &x) {
      return factor * watch(expression.value(x), x, what);
    };
  }

  std::optional<double>
  SceneData::preload(const InterfaceParameters &given) const
  {
    if (!given.preload || time > given.preload_until.value_or(time))
      return {};
    const std::string where =
      parameters.where("Interface " + given.name + "/Preload");
    return factor *
           checks(Expression(*given.preload, where, time).value(Point<dim>()),
                  Point<dim>(),
                  where + ": " + in_quotes(*given.preload));
  }

  namespace
  {
    double
    number_at(const std::string &text,
              const std::string &where,
              const double       time,
              FieldChecks       &checks)
    {
      return checks(Expression(text, where, time).value(Point<dim>()),
                    Point<dim>(),
                    where + ": " + in_quotes(text));
    }
  } // namespace

  std::optional<double>
  SceneData::mean_strain(const unsigned int k) const
  {
    if (is_free_strain(parameters, k))
      return {};
    return factor * number_at(parameters.mean_strain[k],
                              parameters.where("Periodic cell/Mean strain"),
                              time,
                              checks);
  }

  double
  SceneData::mean_stress(const unsigned int k) const
  {
    return factor * number_at(parameters.mean_stress[k],
                              parameters.where("Periodic cell/Mean stress"),
                              time,
                              checks);
  }

  std::function<FrictionBound(const Point<dim> &)>
  SceneData::friction(const InterfaceParameters &given) const
  {
    const auto field = [&](const std::string                &name,
                           const std::optional<std::string> &text) {
      const std::string where =
        parameters.where("Interface " + given.name + "/" + name);
      return [expression = Expression(text.value_or("0"), where, time),
              what       = where + ": " + in_quotes(text.value_or("0")),
              &watch     = checks](const Point<dim> &x) {
        const double value = watch(expression.value(x), x, what);
        if (!(value >= 0.))
          {
            std::ostringstream message;
            message << what << " is " << value << " at (" << x[0] << ", "
                    << x[1] << ", " << x[2]
                    << "); allowed: values that are not negative";
            throw InputError(message.str());
          }
        return value;
      };
    };
    return [bound   = field("Friction bound", given.friction_bound),
            kinetic = field("Friction coefficient", given.friction_coefficient),
            at_rest = field("Static friction coefficient",
                            given.static_friction_coefficient),
            has_other = given.static_friction_coefficient.has_value(),
            where     = parameters.where("Interface " + given.name +
                                     "/Static friction coefficient")](
             const Point<dim> &x) {
      FrictionBound result;
      result.coefficient        = kinetic(x);
      result.given              = bound(x);
      result.static_coefficient = has_other ? at_rest(x) : result.coefficient;
      if (result.static_coefficient < result.coefficient)
        {
          std::ostringstream message;
          message << where << " is " << result.static_coefficient << " at ("
                  << x[0] << ", " << x[1] << ", " << x[2]
                  << "); allowed: at least the Friction coefficient, there "
                  << result.coefficient;
          throw InputError(message.str());
        }
      return result;
    };
  }
} // namespace mortise
