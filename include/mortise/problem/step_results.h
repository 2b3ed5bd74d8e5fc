// What a step has computed, as users see it: fields, errors, quantities.
#pragma once

#include <mortise/output/errors.h>
#include <mortise/output/summary.h>
#include <mortise/problem/adaptivity.h>
#include <mortise/problem/discretisation.h>

#include <vector>

namespace mortise
{
  struct StepFields
  {
    std::vector<BodySolution> solutions; ///< by body
    std::vector<std::vector<std::vector<double>>>
      tractions; ///< by interface and slave face, see multiplier_on_faces()
    std::vector<std::vector<std::vector<double>>>
      multipliers; ///< likewise, see multiplier_coefficients()
    /// Likewise, see contact_fields(); empty without contact, or where
    /// tractions are no field of the output.
    std::vector<std::vector<std::vector<double>>> contact;
    /// By body and active cell, see Adaptivity::cell_estimates(); empty without
    /// a target.
    std::vector<std::vector<double>> estimates;
  };

  struct SolvedStep
  {
    const SceneData    &data;
    const SceneLoad    &load;
    const SystemVector &solution;
    /// By owned multiplier: pressure and gap are zero but for rounding; empty
    /// in a scene without contact.
    const std::vector<bool> undecided;
    /// By interface, what its preload adds to its offset, a length.
    const std::vector<double> shortenings;
  };

  /// As the summary has vectors.
  inline std::vector<double>
  components(const dealii::Tensor<1, dim> &value)
  {
    return {value[0], value[1], value[2]};
  }

  /// Collective.
  StepFields
  step_fields(const RunContext     &run,
              const Discretisation &discretisation,
              const SolvedStep     &solved);

  /// Of all interfaces. Collective.
  std::vector<Violation>
  violations(const RunContext     &run,
             const Discretisation &discretisation,
             const SolvedStep     &solved,
             const StepFields     &fields);

  /// Of the bodies, with what acts on them at @p interfaces. Collective.
  Residuals
  residuals(const Discretisation         &discretisation,
            const SolvedStep             &solved,
            const StepFields             &fields,
            const std::vector<Violation> &interfaces);

  /// Add to @p summary the balance of interfaces, errors against the exact solution, and the
  /// quantities that were asked for. Collective.
  void
  evaluate_step(const RunContext     &run,
                const Discretisation &discretisation,
                const SolvedStep     &solved,
                const StepFields     &fields,
                StepSummary          &summary);
} // namespace mortise
