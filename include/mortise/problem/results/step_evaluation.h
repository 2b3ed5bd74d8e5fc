// What a step that was solved comes to: each of it is computed when somebody
// asks, and once.
#pragma once

#include <mortise/mortar/violation.h>
#include <mortise/problem/results/boundary_forces.h>
#include <mortise/problem/results/solved_step.h>
#include <mortise/problem/scene/discretisation.h>

#include <optional>
#include <utility>
#include <vector>

namespace mortise
{
  class StepEvaluation
  {
  public:
    /// By interface, slave face and coefficient.
    using OnFaces = std::vector<std::vector<std::vector<double>>>;

    /// All must live on.
    StepEvaluation(const RunContext     &run,
                   const Discretisation &discretisation,
                   SolvedStep            solved)
      : run(run)
      , discretisation(discretisation)
      , solved(std::move(solved))
      , of_points(discretisation.interfaces().all().size())
    {}

    const RunContext     &run;
    const Discretisation &discretisation;
    const SolvedStep      solved;

    /// By body. Collective, as all that follows: not to be asked for within a loop
    /// over what a rank owns.
    const std::vector<BodySolution> &
    solutions() const;

    /// See multiplier_coefficients().
    const OnFaces &
    multipliers() const;

    /// See multiplier_on_faces().
    const OnFaces &
    tractions() const;

    /// See Discretisation::gaps().
    const Vector &
    gaps() const;

    const BoundaryForces &
    forces() const;

    /// Of interface @p i.
    const Violations &
    violation(unsigned int i) const;

    /// Of interface @p i: of the points of violation(), if that was asked for before.
    double
    penetration(unsigned int i) const;

  private:
    const TraceDisplacement &
    traces() const;
    /// Left between the bodies of interface @p i, with what a preload takes.
    Offset
    offset(unsigned int i) const;

    mutable std::optional<std::vector<BodySolution>> by_body;
    mutable std::optional<OnFaces>                   coefficients, on_faces;
    mutable std::optional<Vector>                    all_gaps;
    mutable std::optional<TraceDisplacement>         on_traces;
    mutable std::optional<BoundaryForces>            at_boundaries;
    mutable std::vector<std::optional<Violations>>   of_points;
  };
} // namespace mortise
