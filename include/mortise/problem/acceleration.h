// Iterations that go on from the ones before.
#pragma once

#include <mortise/problem/iterate.h>

#include <deque>

namespace mortise
{
  /// Anderson's acceleration of iterations that contract slowly, since the
  /// tangent lacks terms: of friction, and where sides are apart.
  class Acceleration
  {
  public:
    /// @p weights: of the squares of displacements; must live on.
    explicit Acceleration(const Vector &weights)
      : weights(weights)
    {}

    /// An iteration led from the displacement @p given to @p result. Collective.
    void
    add(const Vector &given, const Iterate &result);

    /// The next iterate. Collective.
    Iterate
    next() const;

  private:
    struct Step
    {
      Iterate result;
      Vector  way;
    };

    const Vector    &weights;
    std::deque<Step> steps;
  };

  /// The last states of load steps, which go on as a polynomial in time.
  class Extrapolation
  {
  public:
    void
    add(Iterate state);

    unsigned int
    n_states() const
    {
      return states.size();
    }

    /// The polynomial through the last @p n states at @p time; the time that it
    /// has is that of the last state.
    Iterate
    at(double time, unsigned int n) const;

  private:
    std::deque<Iterate> states;
  };
} // namespace mortise
