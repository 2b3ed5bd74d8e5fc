// How the clipper finds where the edges of the master cross the sides of the
// slave, see clipping.h.
#include <mortise/interface/clipping.h>

#include <algorithm>

namespace mortise
{
  namespace
  {
    inline double
    snapped(const double f)
    {
      return std::abs(f) <= on_side ? 0. : f;
    }

    // Cubic on [0,1] with values f and slopes d at the ends.
    inline double
    cubic(const double f_0,
          const double f_1,
          const double d_0,
          const double d_1,
          const double t)
    {
      const double s = 1. - t;
      return s * s * (1. + 2. * t) * f_0 + t * t * (1. + 2. * s) * f_1 +
             s * t * (s * d_0 - t * d_1);
    }

    // How many rounds of samples it takes to find out whether a curve crosses
    // zero more often than its ends say, judged by the cubic through its ends
    // and
    // slopes from which its middle deviates by @p deviation. What the cubic
    // leaves out vanishes with its slope at the ends, like 16 deviation t^2
    // (1-t)^2; three times that is allowed for.
    unsigned int
    rounds_needed(const double f_0,
                  const double f_1,
                  const double d_0,
                  const double d_1,
                  const double deviation)
    {
      constexpr unsigned int few = 1, many = 5;

      const double rise = f_1 - f_0, slope = std::abs(d_0) + std::abs(d_1);
      if (f_0 == 0. && f_1 == 0.)
        return slope + deviation > on_side ? few : 0;
      // An edge that runs along the side, as on two polynomial pictures of one
      // smooth surface, may cross it several times.
      const bool along =
        std::abs(f_0) + std::abs(f_1) + slope < 0.1 && slope > on_side;
      if (f_0 * f_1 < 0)
        {
          // Monotone curves cross once: slopes at both ends, at the middle and
          // where t^2 (1-t)^2 has its largest slope, 0.192.
          const double first  = 1.125 * rise + 0.1875 * d_0 - 0.3125 * d_1;
          const double middle = 1.5 * rise - 0.25 * (d_0 + d_1);
          const double second = 1.125 * rise + 0.1875 * d_1 - 0.3125 * d_0;
          const double least  = 10. * deviation * std::abs(rise);
          const bool   once   = d_0 * rise > 0 && d_1 * rise > 0 &&
                            middle * rise > 0 && first * rise > least &&
                            second * rise > least;
          return !once || along ? few : 0;
        }
      const double sign    = f_0 + f_1 >= 0 ? 1. : -1.;
      const bool   touches = f_0 == 0. || f_1 == 0.;
      if (touches && sign * (f_0 == 0. ? d_0 : -d_1) < 0)
        return many;
      double nearest = std::min(sign * f_0, sign * f_1);
      bool   clear   = true;
      for (unsigned int i = 1; i < 8; ++i)
        {
          const double t    = i / 8.;
          const double here = sign * cubic(f_0, f_1, d_0, d_1, t);
          nearest           = std::min(nearest, here);
          clear = clear && here > 48. * deviation * t * t * (1. - t) * (1. - t);
        }
      return !touches && nearest < 3. * deviation ? many :
             along || (touches && !clear)         ? few :
                                                    0;
    }
  } // namespace



  double
  LoopClipper::on_cubic(const Breakpoint  &a,
                        const Breakpoint  &b,
                        const unsigned int i,
                        const double       t)
  {
    const double length = b.tau - a.tau;
    return cubic(a.xi[i], b.xi[i], length * a.dxi[i], length * b.dxi[i], t);
  }



  void
  LoopClipper::find_crossings(const unsigned int segment,
                              const unsigned int side)
  {
    const Breakpoint &a   = breakpoints[segments[segment].first];
    const Breakpoint &b   = breakpoints[segments[segment].last];
    const double      f_0 = snapped(inside_by(a.xi, side));
    const double      f_1 = snapped(inside_by(b.xi, side));
    const double      d_0 = (b.tau - a.tau) * inside_rate(a.dxi, side);
    const double      d_1 = (b.tau - a.tau) * inside_rate(b.dxi, side);
    // Across the side the cubic may describe the curve much better than along
    // it.
    const double deviation = segments[segment].deviation;
    const double across    = std::abs(inside_by(segments[segment].mid, side) -
                                   cubic(f_0, f_1, d_0, d_1, 0.5));
    const unsigned int rounds =
      rounds_needed(f_0,
                    f_1,
                    d_0,
                    d_1,
                    f_0 * f_1 > 0 ? deviation :
                                    std::max(across, 0.125 * deviation));
    if (rounds > 0)
      sample_segment(segment, side, rounds);
    else if (f_0 * f_1 < 0)
      crossings.push_back(
        {segment, side, a.tau, b.tau, f_0, f_1, 0., {0., 0.}});
  }



  // Inner samples between low and high, whose ends are the first and the last
  // one.
  void
  LoopClipper::take_samples(const Segment     &segment,
                            const unsigned int side,
                            const double       low,
                            const double       high,
                            Samples           &samples)
  {
    Lanes tau, xi[2];
    for (unsigned int l = 0; l < n_lanes; ++l)
      tau[l] = low + (high - low) * (l + 1.) / Samples::last;
    pull_back_segment(segment, tau, xi);
    for (unsigned int l = 0; l < n_lanes; ++l)
      {
        samples.tau[l + 1]  = tau[l];
        samples.x[l + 1][0] = xi[0][l];
        samples.x[l + 1][1] = xi[1][l];
      }
    for (unsigned int i = 0; i <= Samples::last; ++i)
      {
        samples.f[i] = snapped(inside_by(samples.x[i], side));
        samples.beside[i] =
          i < Samples::last &&
          both_beside(shape, samples.x[i], samples.x[i + 1], side);
      }
  }



  // Samples of the part of a segment that is not beside the slave face; the
  // segment may reach far beyond. False: there is no such part.
  bool
  LoopClipper::sample_near_part(const Segment     &segment,
                                const unsigned int side,
                                Samples           &samples)
  {
    constexpr unsigned int max_rounds = 4, last = Samples::last;

    const Breakpoint *ends[2] = {&breakpoints[segment.first],
                                 &breakpoints[segment.last]};
    for (unsigned int e = 0; e < 2; ++e)
      {
        samples.tau[e * last] = ends[e]->tau;
        std::copy(ends[e]->xi, ends[e]->xi + 2, samples.x[e * last]);
      }
    for (unsigned int round = 0; round < max_rounds; ++round)
      {
        take_samples(segment, side, samples.tau[0], samples.tau[last], samples);
        unsigned int first = 0, end = last;
        while (first < last && samples.beside[first])
          ++first;
        if (first == last)
          return false;
        while (samples.beside[end - 1])
          --end;
        if (2 * (end - first) > last || round + 1 == max_rounds)
          break;
        samples.tau[0]    = samples.tau[first];
        samples.tau[last] = samples.tau[end];
        std::copy(samples.x[first], samples.x[first] + 2, samples.x[0]);
        std::copy(samples.x[end], samples.x[end] + 2, samples.x[last]);
      }
    return true;
  }



  // Look for changes of sign inside of a segment, ever finer around the point
  // where the curve comes closest to changing its side.
  void
  LoopClipper::sample_segment(const unsigned int segment,
                              const unsigned int side,
                              const unsigned int rounds)
  {
    constexpr unsigned int last = Samples::last;

    Samples samples;
    if (!sample_near_part(segments[segment], side, samples))
      return;
    const auto  &f    = samples.f;
    const double sign = f[0] + f[last] >= 0 ? 1. : -1.;
    double       low = samples.tau[0], high = samples.tau[last];
    for (unsigned int round = 0; round < rounds; ++round)
      {
        if (round > 0)
          take_samples(segments[segment], side, low, high, samples);
        unsigned int n_found = 0, best = 0, before = 0;
        for (unsigned int i = 1; i <= last; ++i)
          {
            if (f[i] * f[before] < 0 &&
                !both_beside(shape, samples.x[before], samples.x[i], side))
              {
                ++n_found;
                crossings.push_back({segment,
                                     side,
                                     samples.tau[before],
                                     samples.tau[i],
                                     f[before],
                                     f[i],
                                     0.,
                                     {0., 0.}});
              }
            if (f[i] != 0.)
              before = i;
            if (i < last && !(samples.beside[i - 1] && samples.beside[i]) &&
                (best == 0 || sign * f[i] < sign * f[best]))
              best = i;
          }
        if (n_found > 0 || best == 0 || (f[0] == 0. && f[last] == 0.))
          return;
        const double width = (high - low) / last;
        low                = samples.tau[best] - width;
        high               = samples.tau[best] + width;
      }
  }



  void
  LoopClipper::pull_back_segment(const Segment &segment,
                                 const Lanes   &tau,
                                 Lanes (&xi)[2])
  {
    const Breakpoint &a = breakpoints[segment.first],
                     &b = breakpoints[segment.last];
    unsigned int edge_of_lane[n_lanes];
    for (unsigned int l = 0; l < n_lanes; ++l)
      {
        const double t  = (tau[l] - a.tau) / (b.tau - a.tau);
        edge_of_lane[l] = a.edge;
        xi[0][l]        = on_cubic(a, b, 0, t);
        xi[1][l]        = on_cubic(a, b, 1, t);
      }
    Vec3<Lanes> x, dx;
    evaluate_edges(master->edges, edge_of_lane, tau, x, dx);
    Lanes alpha{};
    if (slave->pull_back(x, true, xi, alpha) != 0)
      failed = true;
  }
} // namespace mortise
