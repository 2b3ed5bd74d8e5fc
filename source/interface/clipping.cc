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

    // The value nearest to zero of the cubic with these ends and slopes at
    // seven inner points, with the sign of the ends (both of one sign).
    double
    nearest_of_cubic(const double f_0,
                     const double f_1,
                     const double d_0,
                     const double d_1)
    {
      const double sign   = f_0 + f_1 >= 0 ? 1. : -1.;
      double       result = std::min(sign * f_0, sign * f_1);
      for (unsigned int i = 1; i < 8; ++i)
        result = std::min(result, sign * cubic(f_0, f_1, d_0, d_1, i / 8.));
      return result;
    }
  } // namespace



  bool
  LoopClipper::clip(const SlaveMap &slave_map, const MasterMap &master_map)
  {
    slave  = &slave_map;
    master = &master_map;
    failed = false;
    breakpoints.clear();
    segments.clear();
    crossings.clear();
    loop.clear();
    for (unsigned int edge = 0; edge < 4; ++edge)
      subdivide_edge(edge);
    locate_breakpoints();
    check_segments();
    for (unsigned int s = 0; s < segments.size(); ++s)
      if (!segments[s].far)
        for (unsigned int side = 0; side < 4; ++side)
          find_crossings(s, side);
    solve_crossings();
    build_pieces();
    for (unsigned int side = 0; side < 4; ++side)
      clip_straight(side);
    measure();
    return !failed;
  }



  // Pull back the breakpoints from @p first on, with their velocities; their xi may be a guess.
  void
  LoopClipper::locate(const unsigned int first, const bool has_guess)
  {
    for (unsigned int begin = first; begin < breakpoints.size();
         begin += n_lanes)
      {
        const unsigned int count =
          std::min<unsigned int>(n_lanes, breakpoints.size() - begin);
        unsigned int edge[n_lanes];
        Lanes        tau, xi[2], dxi[2], alpha{};
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            const Breakpoint &point =
              breakpoints[begin + std::min(l, count - 1)];
            edge[l]  = point.edge;
            tau[l]   = point.tau;
            xi[0][l] = point.xi[0];
            xi[1][l] = point.xi[1];
          }
        Vec3<Lanes> x, dx;
        evaluate_edges(master->edges, edge, tau, x, dx);
        if (slave->pull_back(x, has_guess, xi, alpha) != 0)
          failed = true;
        slave->pull_back_derivative(dx, xi, alpha, dxi);
        for (unsigned int l = 0; l < count; ++l)
          for (unsigned int i = 0; i < 2; ++i)
            {
              breakpoints[begin + l].xi[i]  = xi[i][l];
              breakpoints[begin + l].dxi[i] = dxi[i][l];
            }
      }
  }



  void
  LoopClipper::locate_breakpoints()
  {
    locate(0, false);
    for (auto &point : breakpoints)
      snap_to_sides(point.xi);
    // The end of an edge is the beginning of the next one.
    for (unsigned int b = 0; b < breakpoints.size(); ++b)
      if (breakpoints[b].tau == 0.)
        {
          const Breakpoint &before =
            breakpoints[b == 0 ? breakpoints.size() - 1 : b - 1];
          std::copy(before.xi, before.xi + 2, breakpoints[b].xi);
        }
  }



  // Compare the middle of each segment with the cubic through its ends and
  // slopes, and halve those that the cubic does not describe, so that the
  // search for crossings can rely on it.
  void
  LoopClipper::check_segments()
  {
    constexpr unsigned int max_rounds = 8;
    for (unsigned int round = 0; round < max_rounds; ++round)
      {
        const unsigned int begin = breakpoints.size();
        for (const auto &segment : segments)
          if (!segment.far && !segment.checked)
            {
              const Breakpoint &a = breakpoints[segment.first],
                               &b = breakpoints[segment.last];
              breakpoints.push_back(
                {a.edge,
                 0.5 * (a.tau + b.tau),
                 {on_cubic(a, b, 0, 0.5), on_cubic(a, b, 1, 0.5)},
                 {0., 0.}});
            }
        if (begin == breakpoints.size())
          return;
        locate(begin, true);
        unsigned int middle = begin;
        new_segments.clear();
        for (auto &segment : segments)
          {
            if (segment.far || segment.checked)
              new_segments.push_back(segment);
            else
              {
                if (check_segment(segment, breakpoints[middle]) ||
                    round + 1 == max_rounds)
                  new_segments.push_back(segment);
                else
                  {
                    snap_to_sides(breakpoints[middle].xi);
                    new_segments.push_back(
                      {segment.first, middle, false, false, 0., {0., 0.}});
                    new_segments.push_back(
                      {middle, segment.last, false, false, 0., {0., 0.}});
                  }
                ++middle;
              }
          }
        segments.swap(new_segments);
      }
  }



  double
  LoopClipper::on_cubic(const Breakpoint  &a,
                        const Breakpoint  &b,
                        const unsigned int i,
                        const double       t)
  {
    const double length = b.tau - a.tau;
    return cubic(a.xi[i], b.xi[i], length * a.dxi[i], length * b.dxi[i], t);
  }



  bool
  LoopClipper::check_segment(Segment &segment, const Breakpoint &middle) const
  {
    constexpr double small = 0.03;

    const Breakpoint &a      = breakpoints[segment.first],
                     &b      = breakpoints[segment.last];
    const double expected[2] = {on_cubic(a, b, 0, 0.5), on_cubic(a, b, 1, 0.5)};
    segment.deviation        = 0;
    for (unsigned int i = 0; i < 2; ++i)
      {
        segment.mid[i] = middle.xi[i];
        segment.deviation =
          std::max(segment.deviation, std::abs(middle.xi[i] - expected[i]));
      }
    segment.checked = segment.deviation <= small;
    // Not well described, but outside by more than the description may be
    // wrong?
    for (unsigned int side = 0; side < 4 && !segment.checked; ++side)
      {
        const double f_0 = inside_by(a.xi, side), f_1 = inside_by(b.xi, side);
        const double nearest = std::max(
          {f_0, f_1, inside_by(expected, side), inside_by(segment.mid, side)});
        segment.checked = nearest < -2. * segment.deviation;
      }
    return segment.checked;
  }



  void
  LoopClipper::find_crossings(const unsigned int segment,
                              const unsigned int side)
  {
    const Breakpoint &a     = breakpoints[segments[segment].first];
    const Breakpoint &b     = breakpoints[segments[segment].last];
    const double      f_0   = snapped(inside_by(a.xi, side));
    const double      f_1   = snapped(inside_by(b.xi, side));
    const double      scale = (side % 2 == 0 ? 1. : -1.) * (b.tau - a.tau);
    const double      d_0   = scale * a.dxi[side / 2];
    const double      d_1   = scale * b.dxi[side / 2];
    const double      slope = std::abs(d_0) + std::abs(d_1);
    bool              doubtful;
    if (f_0 * f_1 > 0)
      doubtful =
        nearest_of_cubic(f_0, f_1, d_0, d_1) < 3. * segments[segment].deviation;
    else if (f_0 * f_1 < 0)
      {
        // The cubic and its slope at the middle: monotone curves cross once.
        const double rise      = f_1 - f_0,
                     slope_mid = 1.5 * rise - 0.25 * (d_0 + d_1);
        doubtful = d_0 * rise <= 0 || d_1 * rise <= 0 || slope_mid * rise <= 0;
      }
    else
      doubtful = (f_0 == 0. && f_1 * d_0 < 0) || (f_1 == 0. && f_0 * d_1 > 0);
    // An edge that runs along the side, as on two polynomial pictures of one
    // smooth surface, may cross it several times.
    const bool along =
      std::abs(f_0) + std::abs(f_1) + slope < 0.1 && slope > on_side;
    if (doubtful || along)
      sample_segment(segment, side, doubtful ? 5 : 1);
    else if (f_0 * f_1 < 0)
      crossings.push_back(
        {segment, side, a.tau, b.tau, f_0, f_1, 0., {0., 0.}});
  }



  // Look for changes of sign inside of a segment, ever finer around the point
  // where the curve comes closest to changing its side.
  void
  LoopClipper::sample_segment(const unsigned int segment,
                              const unsigned int side,
                              const unsigned int rounds)
  {
    const Breakpoint &a    = breakpoints[segments[segment].first];
    const Breakpoint &b    = breakpoints[segments[segment].last];
    const double      f_a  = snapped(inside_by(a.xi, side));
    const double      f_b  = snapped(inside_by(b.xi, side));
    const double      sign = f_a + f_b >= 0 ? 1. : -1.;
    double            low = a.tau, high = b.tau;
    for (unsigned int round = 0; round < rounds; ++round)
      {
        Lanes tau, xi[2];
        for (unsigned int l = 0; l < n_lanes; ++l)
          tau[l] = low + (high - low) * (l + 1.) / (n_lanes + 1.);
        pull_back_segment(segments[segment], tau, xi);
        double       previous_tau = a.tau, previous = f_a, least = 1e300;
        double       previous_xi[2] = {a.xi[0], a.xi[1]};
        unsigned int n_found = 0, best = 0;
        for (unsigned int l = 0; l <= n_lanes; ++l)
          {
            const bool   last = l == n_lanes;
            const double x[2] = {last ? b.xi[0] : xi[0][l],
                                 last ? b.xi[1] : xi[1][l]};
            const double f    = last ? f_b : snapped(inside_by(x, side));
            const double here = last ? b.tau : tau[l];
            if (f * previous < 0)
              {
                ++n_found;
                if (!both_beside(previous_xi, x, side))
                  crossings.push_back({segment,
                                       side,
                                       previous_tau,
                                       here,
                                       previous,
                                       f,
                                       0.,
                                       {0., 0.}});
              }
            if (!last && sign * f < least)
              {
                least = sign * f;
                best  = l;
              }
            if (f != 0.)
              {
                previous     = f;
                previous_tau = here;
                std::copy(x, x + 2, previous_xi);
              }
          }
        if (n_found > 0 || (f_a == 0. && f_b == 0.))
          return;
        const double width = (high - low) / (n_lanes + 1.);
        low                = tau[best] - width;
        high               = tau[best] + width;
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
