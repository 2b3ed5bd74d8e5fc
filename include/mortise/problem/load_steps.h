// Control of load steps.
#pragma once

#include <mortise/problem/input/step_parameters.h>

#include <vector>

namespace mortise
{
  /// The planned times with steps between them: a step that fails is halved,
  /// after an easy one the length is doubled. With arc-length control all of
  /// them are lengths along the path.
  class LoadSteps
  {
  public:
    /// @p divisible: may a step be halved? That is useless in linear scenes.
    LoadSteps(const StepParameters &parameters, bool divisible);

    /// Steps, which may be halved, up to @p end, one of the planned times.
    LoadSteps(const StepParameters &parameters, double end);

    bool
    finished() const
    {
      return n_planned == times.size();
    }

    /// Reached so far; 0 at the start.
    double
    time() const
    {
      return reached;
    }

    /// The time at the end of the next step.
    double
    next() const;

    /// Accepted so far.
    unsigned int
    n_done() const
    {
      return n_accepted;
    }

    /// Are fields to be written at the time that was reached?
    bool
    output_due() const
    {
      return at_planned && (n_planned % output_every == 0 || finished());
    }

    /// Fraction of the last of the times that was reached.
    double
    fraction() const
    {
      return finished() ? 1. : reached / times.back();
    }

    /// The step that was accepted last ends the run.
    void
    finish()
    {
      n_planned  = times.size();
      at_planned = true;
    }

    /// The step to next() has converged, with few iterations if @p easy.
    void
    accept(bool easy);

    /// Halve the step. False if it is not allowed.
    bool
    halve();

    /// Go on from @p time after @p n_steps, with steps of at most @p length. Planned times at or
    /// before it count as done.
    void
    resume(double time, unsigned int n_steps, double length);

    /// The present limit of steps, for resume().
    double
    longest() const
    {
      return length;
    }

  private:
    std::vector<double> times;
    unsigned int        output_every;
    double              smallest_fraction;
    bool                divisible;

    unsigned int n_planned  = 0; ///< times that were reached
    unsigned int n_accepted = 0;
    double       reached    = 0.;
    double       largest; ///< of lengths
    double       length;  ///< the largest until a step is halved
    bool         at_planned = false;
  };
} // namespace mortise
