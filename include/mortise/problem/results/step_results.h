// Results of a load step for the summary: fields, errors, quantities.
#pragma once

#include <mortise/adapt/residuals.h>
#include <mortise/output/errors.h>
#include <mortise/output/summary.h>
#include <mortise/problem/results/boundary_forces.h>
#include <mortise/problem/results/step_evaluation.h>

#include <vector>

namespace mortise
{
  /// Of all interfaces. Collective.
  std::vector<InterfaceResidual>
  interface_residuals(const StepEvaluation &step);

  /// Of the bodies, with tractions at @p interfaces. Collective.
  Residuals
  residuals(const StepEvaluation                 &step,
            const std::vector<InterfaceResidual> &interfaces);

  /// Add to @p summary the largest values in bodies, the balance of interfaces,
  /// errors against the exact solution, Points, equilibrium and Resultants.
  /// Collective.
  void
  evaluate_step(const StepEvaluation &step, StepSummary &summary);
} // namespace mortise
