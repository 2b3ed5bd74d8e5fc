#include <deal.II/base/utilities.h>

#include <mortise/base/quotes.h>
#include <mortise/problem/input/formulation.h>
#include <mortise/problem/input/quantity.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    const std::string components_of_quantities = "xyz";

    template <typename Quantities>
    std::string
    add_names(const Quantities &quantities, std::string names)
    {
      for (const auto &quantity : quantities)
        names += (names.empty() ? "" : ", ") + quantity.name;
      return names;
    }
  } // namespace

  std::optional<Quantity>
  given_quantity(const Parameters &parameters)
  {
    const std::string &name = parameters.adaptivity.quantity;
    if (name.empty())
      return {};
    const OutputParameters &output = parameters.output;
    const auto              fail   = [&](const std::string &got) {
      const std::string names =
        add_names(output.resultants, add_names(output.points, ""));
      parameters.fail(
        "Adaptivity/Quantity",
        got,
        names.empty() ?
                         "an entry of Output/Points or Output/Resultants, of which there is "
                         "none, with a component: \"NAME, x\"" :
                         "one of " + names +
            " (entries of Output/Points and Output/Resultants), with "
                           "a component: \"NAME, x\", y or z");
    };
    const std::size_t comma = name.rfind(',');
    if (comma == std::string::npos)
      fail(in_quotes(name) + ", without a component");
    const std::string of = Utilities::trim(name.substr(0, comma)),
                      c  = Utilities::trim(name.substr(comma + 1));
    if (c.size() != 1 || components_of_quantities.find(c) == std::string::npos)
      fail(in_quotes(name) + " with component " + in_quotes(c));
    Quantity quantity{&parameters, of + ", " + c, 0, {}};
    quantity.component = components_of_quantities.find(c);
    bool       found   = false;
    const auto take    = [&](const auto &quantities) {
      for (const auto &any : quantities)
        if (any.name == of)
          {
            quantity.of = any;
            found       = true;
          }
    };
    take(output.points);
    take(output.resultants);
    if (!found)
      fail(in_quotes(of));
    return quantity;
  }

  Parameters
  with_tolerance(Parameters parameters)
  {
    if (const auto &target = parameters.adaptivity.target_error)
      parameters.solver.tolerance =
        std::max(parameters.solver.tolerance, 1e-3 * *target);
    return parameters;
  }

  Parameters
  with_ramp(Parameters parameters)
  {
    if (!parameters.steps.given() &&
        std::any_of(parameters.bodies.begin(),
                    parameters.bodies.end(),
                    [](const BodyParameters &body) {
                      return !is_linear(body.material);
                    }))
      {
        parameters.steps.ramp = true;
        if (!parameters.adaptivity.target_error) // whose results have cycles
          parameters.steps.end_time = 1.;
      }
    return parameters;
  }

  void
  check_adaptivity(const Parameters &parameters)
  {
    const auto &fields = parameters.output.fields;
    given_quantity(parameters);
    if (!parameters.adaptivity.target_error)
      {
        if (!parameters.adaptivity.quantity.empty())
          parameters.fail("Adaptivity/Quantity",
                          in_quotes(parameters.adaptivity.quantity) +
                            " without Adaptivity/Target error",
                          "nothing, or give a target");
        if (std::find(fields.begin(), fields.end(), "estimate") != fields.end())
          parameters.fail("Output/Fields",
                          "estimate without Adaptivity/Target error",
                          "estimate in a run with a target");
        return;
      }
    // the first rise tells the first error
    for (const BodyParameters &body : parameters.bodies)
      {
        const unsigned int most = *given_degrees(body).rbegin();
        if (most >= parameters.adaptivity.largest_degree)
          parameters.fail(
            "Adaptivity/Largest degree",
            std::to_string(parameters.adaptivity.largest_degree) +
              " with body " + in_quotes(body.name) + " of degree " +
              std::to_string(most),
            "above all degrees that are given, from which cycles begin");
      }
  }
} // namespace mortise
