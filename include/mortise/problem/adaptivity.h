// How accurate a solution is, and which degrees to take next: from how much it
// has changed, cell by cell, when degrees rose. Source: Szabo and Babuska,
// Finite Element Analysis (1991), chapter 4, for whole meshes.
#pragma once

#include <mortise/output/solution_change.h>
#include <mortise/problem/run_context.h>
#include <mortise/problem/scene_spaces.h>

#include <optional>
#include <string>

namespace mortise
{
  /// Throws InputError where a target goes together with what it cannot.
  void
  check_adaptivity(const Parameters &parameters);

  /// With a target linear solves need no more digits than leave it what it is.
  Parameters
  with_tolerance(Parameters parameters);

  /// What is left of the square of the error on a cell of degree @p p when the first rise of the
  /// degree, to p, changed a solution of the square @p energy by the square @p change, as a multiple of it: errors are taken
  /// to fall by the same factor from degree to degree.
  double
  tail_of_first_change(unsigned int p, double change, double energy);

  /// Likewise, of a later rise, @p before that of the rise before it: changes are taken to go on as a
  /// power of the degree, at least as its square, which they do beside edges
  /// and corners.
  double
  tail_of_changes(unsigned int p, double last, double before);

  class Adaptivity
  {
  public:
    /// @p run must live on; it has a target.
    explicit Adaptivity(const RunContext &run);

    /// The next cycle has been solved on @p bodies, which still have its spaces. Collective.
    void
    add(const Bodies &bodies, const std::vector<BodySolution> &solutions);

    /// Energy norm of the error beside that of the solution; nothing in the
    /// first cycle.
    const std::optional<double> &
    estimate() const
    {
      return estimated;
    }

    bool
    reached() const
    {
      return estimated && *estimated <= *run.parameters.adaptivity.target_error;
    }

    /// Why there is no next cycle, although the target is not reached, in
    /// words; else empty.
    const std::string &
    limit() const
    {
      return stopped_by;
    }

    /// That the target is not reached, why, and what was.
    std::string
    missed() const;

    /// Of the next cycle; empty for the first one.
    const CellDegrees &
    degrees() const
    {
      return next;
    }

  private:
    /// The next degrees from those of @p now; @p allowed: energy norm of the error.
    void
    choose(const Bodies &bodies, const CellDegrees &now, double allowed);
    /// One more where the square of the error is above @p least, up to the
    /// largest degree, and on cells around with less.
    CellDegrees
    risen(const Bodies &bodies, const CellDegrees &now, double least) const;

    const RunContext &run;
    unsigned int      cycle = 0;
    CellDegrees       next;
    CellNumbers
      changes; ///< squares, by the last rise; first those of the solution
    CellNumbers                    errors; ///< squares of estimates
    std::optional<SampledSolution> sample;
    std::optional<double>          estimated;
    std::string                    stopped_by;
  };
} // namespace mortise
