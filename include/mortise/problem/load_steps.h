// Which time a run goes to next.
#pragma once

#include <mortise/problem/input/step_parameters.h>

#include <vector>

namespace mortise
{
  /// The planned times, and smaller steps to them where one fails: a step that
  /// fails is halved, after an easy one the next is twice as long.
  class LoadSteps
  {
  public:
    /// @p divisible: may a step be halved? A linear scene gains nothing by it.
    LoadSteps(const StepParameters &parameters, bool divisible);

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

    /// Where the next step goes.
    double
    next() const;

    /// Accepted so far.
    unsigned int
    n_done() const
    {
      return n_accepted;
    }

    /// Is the time that was reached one of those to write fields at?
    bool
    output_due() const
    {
      return at_planned && (n_planned % output_every == 0 || finished());
    }

    /// Reached so far, of the whole; between 0 and 1.
    double
    share() const
    {
      return reached / times.back();
    }

    /// The step to next() is done, without trouble if @p easy.
    void
    accept(bool easy);

    /// Try a step of half the length instead. False if none is allowed.
    bool
    halve();

    /// Go on from @p time after @p n_steps, with steps of at most @p length. Planned times at or
    /// before it count as done.
    void
    resume(double time, unsigned int n_steps, double length);

    /// The longest step that is tried now; what resume() needs.
    double
    longest() const
    {
      return length;
    }

  private:
    std::vector<double> times;
    unsigned int        output_every;
    double              smallest_share;
    bool                divisible;

    unsigned int n_planned  = 0; ///< times that were reached
    unsigned int n_accepted = 0;
    double       reached    = 0.;
    double       length; ///< infinite until a step is halved
    bool         at_planned = false;
  };
} // namespace mortise
