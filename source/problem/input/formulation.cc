#include <mortise/base/expression.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/input/formulation.h>

#include <algorithm>
#include <sstream>

namespace mortise
{
  namespace
  {
    /// From here on the displacement form locks visibly at low degrees, and its
    /// solvers slow down at all.
    constexpr double nearly_incompressible = 0.49;

    unsigned int
    least_degree(const BodyParameters &body)
    {
      return *given_degrees(body).begin();
    }

    /// Is it to be in mixed form, if its degrees allow that?
    bool
    wants_mixed_form(const BodyParameters &body)
    {
      return has_mixed_form(body.material.law) &&
             (body.formulation == Formulation::mixed ||
              (body.formulation == Formulation::automatic &&
               body.material.poisson_ratio >= nearly_incompressible));
    }

    void
    check_form_of_other_laws(const Parameters     &parameters,
                             const BodyParameters &body)
    {
      // in the mean over directions, from the average that yields most
      const double nu =
        make_material(body.material,
                      false,
                      [](const std::string &name) { return name; })
          .averages()
          .reuss.poisson_ratio;
      std::ostringstream got;
      got << (body.formulation == Formulation::mixed ? "\"mixed\"" : "\"auto\"")
          << " with Law = " << body.material.law;
      const std::string path = "Body " + body.name + "/Formulation";
      if (body.formulation == Formulation::mixed)
        parameters.fail(path,
                        got.str(),
                        "displacement or auto: the law has no mixed form");
      if (body.formulation == Formulation::automatic &&
          nu >= nearly_incompressible)
        {
          got << " and constants that are nearly incompressible (in the mean "
                 "over directions Poisson ratio "
              << nu << ")";
          parameters.fail(
            path,
            got.str(),
            "displacement, which locks at low degrees: the law has no mixed form");
        }
    }

    void
    check_form(const Parameters &parameters, const BodyParameters &body)
    {
      if (!has_mixed_form(body.material.law))
        return check_form_of_other_laws(parameters, body);
      const double       nu      = body.material.poisson_ratio;
      const std::string  section = "Body " + body.name;
      std::ostringstream with_nu;
      with_nu << " with Poisson ratio " << nu;
      if (nu == 0.5 && body.formulation == Formulation::displacement)
        parameters.fail(section + "/Formulation",
                        "\"displacement\"" + with_nu.str() +
                          ", where a displacement form does not exist",
                        "mixed or auto");
      if (!is_mixed(body))
        return;
      if (!(nu > 0.))
        parameters.fail(
          section + "/Formulation",
          "\"mixed\"" + with_nu.str() + ", where no pressure is needed",
          "displacement or auto for a Poisson ratio of 0 or less");
      if (least_degree(body) < least_mixed_degree)
        parameters.fail(section +
                          (body.degree < least_mixed_degree ? "/Degree" :
                           body.degree_near.empty() ? "/Degree by region" :
                                                      "/Degree near"),
                        "degree 1 in mixed form" + with_nu.str(),
                        "degrees from " + std::to_string(least_mixed_degree) +
                          " to " + std::to_string(max_degree) +
                          " (the pressure has one less, and is continuous)");
      if (parameters.solver.method == SolverMethod::condensed)
        parameters.fail(
          "Solver/Method",
          "\"condensed\" with body " + in_quotes(body.name) +
            " in mixed form, which conjugate gradients cannot solve",
          "auto, saddle point, direct");
    }
  } // namespace

  std::set<unsigned int>
  given_degrees(const BodyParameters &body)
  {
    std::set<unsigned int> degrees = {body.degree};
    for (const auto &region : body.degree_by_region)
      degrees.insert(region.second);
    for (const Ball &ball : body.degree_near)
      degrees.insert(ball.number);
    return degrees;
  }

  void
  change_degrees(
    BodyParameters                                         &body,
    const std::function<unsigned int(unsigned int degree)> &changed)
  {
    body.degree = changed(body.degree);
    for (auto &region : body.degree_by_region)
      region.second = changed(region.second);
    for (Ball &ball : body.degree_near)
      ball.number = changed(ball.number);
  }

  void
  raise_to_mixed_form(BodyParameters &body)
  {
    if (wants_mixed_form(body))
      change_degrees(body, [](const unsigned int degree) {
        return std::max(degree, least_mixed_degree);
      });
  }

  bool
  is_mixed(const BodyParameters &body)
  {
    return wants_mixed_form(body) && (body.formulation == Formulation::mixed ||
                                      body.material.poisson_ratio == 0.5 ||
                                      least_degree(body) >= least_mixed_degree);
  }

  bool
  locks(const BodyParameters &body)
  {
    return wants_mixed_form(body) && !is_mixed(body);
  }

  void
  check_formulations(const Parameters &parameters)
  {
    bool incompressible = false;
    for (const BodyParameters &body : parameters.bodies)
      {
        check_form(parameters, body);
        incompressible = incompressible || (has_mixed_form(body.material.law) &&
                                            body.material.poisson_ratio == 0.5);
      }
    const ExactSolutionParameters &exact = parameters.exact_solution;
    const std::string              path  = "Exact solution/Pressure";
    const bool by_expressions            = exact.kind == ExactKind::expressions;
    if (exact.pressure && !(by_expressions && incompressible))
      parameters.fail(
        path,
        in_quotes(*exact.pressure),
        "nothing, unless Displacement holds expressions and a body has "
        "Poisson ratio 0.5: it follows from the rest");
    if (!exact.pressure && by_expressions && incompressible)
      parameters.fail(path,
                      "nothing in a scene with Poisson ratio 0.5",
                      "an expression in x, y, z for the mean pressure");
    if (exact.pressure)
      Expression(*exact.pressure,
                 parameters.where(path),
                 parameters.steps.first_time());
  }
} // namespace mortise
