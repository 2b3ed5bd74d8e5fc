// What a step has computed, as users see it: fields, errors, quantities.
#pragma once

#include <mortise/adapt/residuals.h>
#include <mortise/mortar/violation.h>
#include <mortise/output/errors.h>
#include <mortise/output/summary.h>
#include <mortise/problem/results/solved_step.h>
#include <mortise/problem/scene/discretisation.h>

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

  /// Collective.
  StepFields
  step_fields(const RunContext     &run,
              const Discretisation &discretisation,
              const SolvedStep     &solved);

  /// Of all interfaces. Collective.
  std::vector<InterfaceViolation>
  violations(const RunContext     &run,
             const Discretisation &discretisation,
             const SolvedStep     &solved,
             const StepFields     &fields);

  /// Of the bodies, with what acts on them at @p interfaces. Collective.
  Residuals
  residuals(const Discretisation                  &discretisation,
            const SolvedStep                      &solved,
            const StepFields                      &fields,
            const std::vector<InterfaceViolation> &interfaces);

  /// Add to @p summary the largest values in bodies, the balance of interfaces, errors against the exact solution, and the
  /// Points that were asked for. Collective.
  void
  evaluate_step(const RunContext     &run,
                const Discretisation &discretisation,
                const SolvedStep     &solved,
                const StepFields     &fields,
                StepSummary          &summary);

  /// Add the equilibrium, and the Resultants that were asked for. Collective.
  void
  add_forces(const RunContext     &run,
             const Bodies         &bodies,
             const BoundaryForces &forces,
             StepSummary          &summary);
} // namespace mortise
