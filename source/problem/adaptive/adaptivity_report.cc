#include <mortise/problem/adaptive/adaptivity.h>
#include <mortise/problem/adaptive/dual_solution.h>

#include <cmath>

namespace mortise
{
  namespace
  {
    /// That the error may be larger, in words.
    std::string
    upper_text(const EstimateMemory &memory)
    {
      constexpr double noticeable = 1.1; // less is not worth saying
      return *memory.upper_estimate > noticeable * *memory.estimate ?
               ", perhaps " + RunLog::number(*memory.upper_estimate) :
               "";
    }

    /// Body or interface with most of the error, in words; nothing where it is
    /// not known, of a quantity and of a cycle before a restart.
    std::string
    worst_part(const CycleErrors &errors, const Bodies &bodies)
    {
      const ErrorSums &sums = errors.sums;
      if (!(sums.all > 0.))
        return "";
      std::string  name;
      double       worst = 0.;
      const double bulk  = std::pow(errors.of_bulk(), 2);
      for (unsigned int b = 0; b < sums.by_body.size(); ++b)
        if (const double part = bulk * sums.by_body[b] / sums.all; part > worst)
          {
            worst = part;
            name  = "body " + bodies[b]->name;
          }
      for (const InterfaceResidual &of : errors.interface_residuals)
        if (const double part = of.size * of.size; part > worst)
          {
            worst = part;
            name  = "interface " + of.interface + ", whose sides are apart";
          }
      return name.empty() ?
               "" :
               " (the worst part " + RunLog::number(std::sqrt(worst)) + ": " +
                 name + ")";
    }
  } // namespace

  AdaptivitySummary
  summary_of(const Adaptivity                  &adaptivity,
             const Bodies                      &bodies,
             const ExactSolution               *exact,
             const std::optional<ErrorSummary> &errors)
  {
    const CycleErrors    &of_cycle = adaptivity.errors();
    const auto           &goal     = adaptivity.quantity();
    const auto           &estimate = of_cycle.memory.estimate;
    AdaptivitySummary     result;
    std::optional<double> error;
    result.target   = adaptivity.target();
    result.estimate = estimate;
    if (errors && !goal)
      error = errors->energy;
    if (goal)
      {
        const double value = of_cycle.memory.value;
        result.quantity    = goal->name;
        result.value       = value;
        result.correction  = of_cycle.correction;
        if (exact)
          error = std::fabs(exact_value(*goal, bodies, *exact) - value) /
                  (value != 0. ? std::fabs(value) : 1.);
      }
    if (estimate && error && *error > 0.)
      result.effectivity = *estimate / *error;
    if (estimate && !goal)
      {
        result.estimate_interface = of_cycle.of_interfaces();
        result.estimate_bulk      = of_cycle.of_bulk();
      }
    return result;
  }

  std::string
  found(const Adaptivity &adaptivity, const Bodies &bodies)
  {
    const EstimateMemory &memory = adaptivity.errors().memory;
    const auto           &goal   = adaptivity.quantity();
    return (goal ? goal->name + " = " + RunLog::number(memory.value) + ", " :
                   std::string()) +
           "estimated error " + RunLog::number(*memory.estimate) +
           upper_text(memory) +
           (goal ? "" : worst_part(adaptivity.errors(), bodies)) + ", target " +
           RunLog::number(adaptivity.target()) +
           (adaptivity.reached() ?
              "" :
              ", met at " + RunLog::number(adaptivity.met_at()));
  }

  std::string
  missed(const Adaptivity &adaptivity)
  {
    const EstimateMemory &memory = adaptivity.errors().memory;
    return "The error is " +
           (memory.estimate ?
              "estimated as " + RunLog::number(*memory.estimate) +
                upper_text(memory) :
              std::string("not known")) +
           "; Adaptivity/Target error is " +
           RunLog::number(adaptivity.target()) + ", and Adaptivity/" +
           adaptivity.limit() + ". The last result is written";
  }
} // namespace mortise
