#include <mortise/base/error.h>
#include <mortise/base/expression.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/input/interface_law.h>

#include <sstream>
#include <string>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::function<double(const Point<3> &)>
    positive_stiffness(const std::string &where, const std::string &text)
    {
      return
        [expression = Expression(text, where), where, text](const Point<3> &x) {
          const double value = expression.value(x);
          if (!(value > 0. && value <= largest_number) &&
              !(value == 0. && expression.is_constant()))
            {
              std::ostringstream message;
              message << where << ": got " << in_quotes(text) << ", which is "
                      << value << " at " << x << "; allowed: positive values";
              throw InputError(message.str());
            }
          return value;
        };
    }
  } // namespace

  bool
  has_friction(const InterfaceParameters &interface)
  {
    if (interface.law == Law::tresca)
      return true;
    if (!interface.friction_coefficient)
      return false;
    const auto is_zero = [](const std::optional<std::string> &text) {
      if (!text)
        return true;
      const Expression coefficient(*text);
      return coefficient.is_constant() && !coefficient.depends_on_time() &&
             coefficient.value(Point<3>()) == 0.;
    };
    return !is_zero(interface.friction_coefficient) ||
           !is_zero(interface.static_friction_coefficient);
  }

  bool
  has_mesh_gap(const InterfaceParameters &interface)
  {
    return (is_one_sided(interface.law) ||
            (interface.law == Law::slide && interface.follows_bodies)) &&
           !interface.ignores_mesh_gap;
  }

  InterfaceLaw
  interface_law(const Parameters          &parameters,
                const InterfaceParameters &interface)
  {
    InterfaceLaw law;
    law.law = interface.law;
    if (interface.law == Law::slide ||
        (is_one_sided(interface.law) && !has_friction(interface)))
      law.constrained = ConstrainedDirections::normal;
    law.has_mesh_gap = has_mesh_gap(interface);
    if (interface.law != Law::spring)
      return law;
    const auto where = [&](const std::string &name) {
      return parameters.where(interface.path() + "/" + name);
    };
    const std::string across = where("Tangential stiffness");
    law.stiffness =
      [normal = positive_stiffness(where("Normal stiffness"),
                                   *interface.normal_stiffness),
       tangential =
         positive_stiffness(across, *interface.tangential_stiffness)](
        const Point<3> &x) {
        return InterfaceStiffness{normal(x), tangential(x)};
      };
    const Expression tangential(*interface.tangential_stiffness, across);
    if (tangential.is_constant() && tangential.value(Point<3>()) == 0.)
      law.constrained = ConstrainedDirections::normal;
    return law;
  }
} // namespace mortise
