#include <mortise/problem/arc_length.h>

#include <cmath>

namespace mortise
{
  ArcLength::ArcLength(const Vector                    &diagonal,
                       const std::vector<unsigned int> &constrained)
    : weights(diagonal)
  {
    for (const unsigned int i : constrained)
      weights.local_element(i) = 0.;
  }

  void
  ArcLength::begin(const State &from, const double given)
  {
    start.reinit(weights);
    if (from.displacement.size() > 0)
      start = from.displacement;
    last    = from.path.increment;
    tangent = from.path.tangent;
    length  = given;
  }

  double
  ArcLength::product(const Vector &a, const Vector &b) const
  {
    Vector weighted(a);
    weighted.scale(weights);
    return weighted * b;
  }

  Vector
  ArcLength::increment(const Vector &displacement) const
  {
    Vector result(displacement);
    result -= start;
    return result;
  }

  double
  ArcLength::rest(const Vector &displacement) const
  {
    const Vector moved = increment(displacement);
    return tangent == 0. ? 1. :
                           std::fabs(1. - std::sqrt(product(moved, moved)) /
                                            (length * tangent));
  }

  double
  ArcLength::increment_of_time(const Vector &displacement,
                               const Vector &at_rest,
                               const Vector &per_time)
  {
    const Vector moved  = increment(displacement);
    const double square = product(moved, moved);
    if (square > 0.)
      return ((std::pow(length * tangent, 2) - square) / 2. -
              product(moved, at_rest)) /
             product(moved, per_time);
    const double size = std::sqrt(product(per_time, per_time));
    if (tangent == 0.)
      tangent = size;
    const bool turns = last.size() > 0 && product(last, per_time) < 0.;
    return (turns ? -length : length) * tangent / size;
  }

  PathState
  ArcLength::path(const Vector &displacement) const
  {
    PathState next{increment(displacement), tangent};
    for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
      if (weights.local_element(i) == 0.)
        next.increment.local_element(i) = 0.;
    return next;
  }
} // namespace mortise
