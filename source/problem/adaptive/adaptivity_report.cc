// What Adaptivity tells of an error: numbers for the summary, words for the
// log.
#include <mortise/problem/adaptive/adaptivity.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  namespace
  {
    /// Less is not worth saying.
    constexpr double noticeable = 1.1;
  } // namespace

  std::vector<std::vector<double>>
  Adaptivity::cell_estimates() const
  {
    std::vector<std::vector<double>> result;
    if (!estimated)
      return result;
    const auto part = [&](const double error) {
      return goal ? error : std::sqrt(error);
    };
    const double factor = sums.all > 0. ? *estimated / part(sums.all) : 0.;
    for (const auto &of_body : states)
      {
        result.emplace_back();
        for (const CellState &state : of_body)
          result.back().push_back(factor * part(state.history.error));
      }
    return result;
  }

  AdaptivitySummary
  Adaptivity::summary(const Bodies                      &bodies,
                      const ExactSolution               *exact,
                      const std::optional<ErrorSummary> &errors) const
  {
    AdaptivitySummary result;
    result.target   = *run.parameters.adaptivity.target_error;
    result.estimate = estimated;
    std::optional<double> error;
    if (errors && !goal)
      error = errors->energy;
    if (goal)
      {
        result.quantity   = goal->name();
        result.value      = last_value;
        result.correction = signed_error;
        if (exact)
          error = std::fabs(goal->value(bodies, *exact) - last_value) /
                  (last_value != 0. ? std::fabs(last_value) : 1.);
      }
    if (estimated && error && *error > 0.)
      result.effectivity = *estimated / *error;
    if (estimated && !goal)
      {
        const double of_interfaces = interface_error();
        result.estimate_interface  = of_interfaces;
        result.estimate_bulk       = std::sqrt(square_of_bulk());
      }
    return result;
  }

  double
  Adaptivity::square_of_bulk() const
  {
    return std::max(0.,
                    *estimated * *estimated - std::pow(interface_error(), 2));
  }

  std::string
  Adaptivity::worst_part() const
  {
    if (goal || !(sums.all > 0.))
      return "";
    std::string  name;
    double       worst = 0.;
    const double bulk  = square_of_bulk();
    for (unsigned int b = 0; b < sums.by_body.size(); ++b)
      if (const double part = bulk * sums.by_body[b] / sums.all; part > worst)
        {
          worst = part;
          name  = "body " + run.parameters.bodies[b].name;
        }
    for (const InterfaceViolation &of : interfaces)
      if (const double part = of.size * of.size; part > worst)
        {
          worst = part;
          name  = "interface " + of.interface + ", whose sides are apart";
        }
    if (name.empty()) // not known of a cycle before a restart
      return "";
    return " (the worst part " + RunLog::number(std::sqrt(worst)) + ": " +
           name + ")";
  }

  std::string
  Adaptivity::doubt() const
  {
    return *at_most > noticeable * *estimated ?
             ", perhaps " + RunLog::number(*at_most) :
             "";
  }

  std::string
  Adaptivity::found() const
  {
    return (goal ? goal->name() + " = " + RunLog::number(last_value) + ", " :
                   std::string()) +
           "estimated error " + RunLog::number(*estimated) + doubt() +
           worst_part() + ", target " +
           RunLog::number(*run.parameters.adaptivity.target_error) +
           (reached() ? "" : ", met at " + RunLog::number(met_at()));
  }

  std::string
  Adaptivity::missed() const
  {
    return "The error is " +
           (estimated ? "estimated as " + RunLog::number(*estimated) + doubt() :
                        std::string("not known")) +
           "; Adaptivity/Target error is " +
           RunLog::number(*run.parameters.adaptivity.target_error) +
           ", and Adaptivity/" + stopped_by + ". The last result is written";
  }

} // namespace mortise
