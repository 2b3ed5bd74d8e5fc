// Lazy evaluation of a solved step: each result is computed once, on demand.
#pragma once

#include <mortise/mortar/interface_evaluation.h>
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

    /// By body. Collective, as all functions below, hence not for loops over
    /// owned objects.
    const std::vector<BodySolution> &
    solutions() const;

    /// See multiplier_coefficients().
    const OnFaces &
    multipliers() const;

    /// See multiplier_on_faces().
    const OnFaces &
    tractions() const;

    /// By owned node of contact, a length, see Discretisation::gaps().
    const std::vector<double> &
    gaps() const;

    const BoundaryForces &
    forces() const;

    /// Of interface @p i.
    const InterfaceEvaluation &
    evaluation_of(unsigned int i) const;

    /// Of interface @p i, from evaluation_of() if that is known.
    double
    penetration(unsigned int i) const;

  private:
    const TraceDisplacement &
    traces() const;
    /// Offset of interface @p i with its shortening.
    Offset
    offset(unsigned int i) const;

    mutable std::optional<std::vector<BodySolution>> by_body;
    mutable std::optional<OnFaces>                   coefficients, on_faces;
    mutable std::optional<std::vector<double>>       all_gaps;
    mutable std::optional<TraceDisplacement>         on_traces;
    mutable std::optional<BoundaryForces>            at_boundaries;
    mutable std::vector<std::optional<InterfaceEvaluation>> of_points;
  };
} // namespace mortise
