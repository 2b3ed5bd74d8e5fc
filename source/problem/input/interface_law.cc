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

  std::function<Stiffness(const Point<dim> &)>
  spring_stiffness(const Parameters          &parameters,
                   const InterfaceParameters &interface)
  {
    if (!interface.normal_stiffness || !interface.tangential_stiffness)
      return {};
    const auto evaluator = [&](const std::string &name,
                               const std::string &text) {
      const std::string where =
        parameters.where("Interface " + interface.name + "/" + name);
      return [expression = Expression(text, where), where, text](
               const Point<dim> &x) {
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
    };
    return [normal = evaluator("Normal stiffness", *interface.normal_stiffness),
            tangential =
              evaluator("Tangential stiffness",
                        *interface.tangential_stiffness)](const Point<dim> &x) {
      return Stiffness{normal(x), tangential(x)};
    };
  }

  TiedDirections
  tied_directions(const Parameters          &parameters,
                  const InterfaceParameters &interface)
  {
    if (interface.law == "slide" || interface.law == "contact")
      return TiedDirections::normal;
    if (!interface.tangential_stiffness)
      return TiedDirections::all;
    const Expression tangential(*interface.tangential_stiffness,
                                parameters.where("Interface " + interface.name +
                                                 "/Tangential stiffness"));
    return tangential.is_constant() && tangential.value(Point<dim>()) == 0. ?
             TiedDirections::normal :
             TiedDirections::all;
  }
} // namespace mortise
