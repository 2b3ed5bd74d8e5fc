// Arc-length control: the time t of the loads joins the unknowns, and the
// increment Du of the displacement lies on a sphere around the start of the
// step:
//
//     Du . D Du = s^2,    linearised: Du . D du = (s^2 - Du . D Du) / 2
//
// D = diag(K) of the undeformed bodies makes squares of displacements energies,
// so that units do not matter. Sources: Riks (1979); Crisfield (1981);
// Schweizerhof, Wriggers (1986).
#pragma once

#include <mortise/problem/state.h>

#include <vector>

namespace mortise
{
  class ArcLength
  {
  public:
    /// @p diagonal: D; @p constrained components do not count.
    ArcLength(const Vector                    &diagonal,
              const std::vector<unsigned int> &constrained);

    /// The next step begins at @p last. @p length is a time: with the first
    /// tangent of the run t would grow by so much.
    void
    begin(const State &last, double length);

    /// Is the first tangent known, whose size all lengths depend on?
    bool
    has_tangent() const
    {
      return tangent > 0.;
    }

    /// Distance of @p displacement from the sphere, as a fraction of its radius.
    /// Collective.
    double
    rest(const Vector &displacement) const;

    /// The increment of t that brings @p displacement to the sphere, with those
    /// of the displacement @p at_rest while t does not change and @p per_time.
    /// From the start of the step it leads on along the last one; at first t
    /// increases. Collective.
    double
    increment_of_time(const Vector &displacement,
                      const Vector &at_rest,
                      const Vector &per_time);

    /// To be kept for the next step, which begins at @p displacement.
    PathState
    path(const Vector &displacement) const;

  private:
    double
    product(const Vector &a, const Vector &b) const;
    /// From the start of the step.
    Vector
    increment(const Vector &displacement) const;

    Vector weights;      ///< D
    Vector start;        ///< of the step
    Vector last;         ///< increment of the last step, or empty
    double length  = 0.; ///< a time
    double tangent = 0.; ///< size of the first, per time
  };
} // namespace mortise
