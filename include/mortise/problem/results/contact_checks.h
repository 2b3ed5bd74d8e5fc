// What a user should know of the motion of bodies in contact.
#pragma once

#include <mortise/problem/results/step_evaluation.h>

namespace mortise
{
  /// How far the sides of interface @p i move against each other at most.
  /// Collective.
  double
  relative_motion(const StepEvaluation &step, unsigned int i);

  /// Warn of @p slip beyond a face of interface @p i where pairs and normals stay: on a
  /// plane slip changes neither normals nor gaps. Collective.
  void
  warn_of_large_slip(const StepEvaluation &step, unsigned int i, double slip);

  /// The same of bodies at finite strain, where sides have @p moved so far against
  /// each other: once for each doubling. Collective.
  void
  warn_of_large_motion(const StepEvaluation &step,
                       unsigned int          i,
                       double                moved);

  /// Throws InputError where a face without a partner could have met one, since
  /// sides have @p moved so far. Collective.
  void
  check_partners(const StepEvaluation &step, unsigned int i, double moved);
} // namespace mortise
