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
    shape  = slave_map.shape();
    failed = false;
    breakpoints.clear();
    segments.clear();
    crossings.clear();
    loop.clear();
    for (unsigned int edge = 0; edge < n_vertices(master->shape); ++edge)
      subdivide_edge(edge);
    locate_breakpoints();
    check_segments();
    for (unsigned int s = 0; s < segments.size(); ++s)
      if (!segments[s].far)
        for (const unsigned int side : sides_of(shape))
          find_crossings(s, side);
    solve_crossings();
    build_pieces();
    for (const unsigned int side : sides_of(shape))
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
      snap_to_sides(shape, point.xi);
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
                    snap_to_sides(shape, breakpoints[middle].xi);
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
    for (const unsigned int side : sides_of(shape))
      {
        if (segment.checked)
          break;
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
    const double      d_0   = (b.tau - a.tau) * inside_rate(a.dxi, side);
    const double      d_1   = (b.tau - a.tau) * inside_rate(b.dxi, side);
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
  // where the curve comes closest to changing its side next to the slave face.
  void
  LoopClipper::sample_segment(const unsigned int segment,
                              const unsigned int side,
                              const unsigned int rounds)
  {
    constexpr unsigned int last = n_lanes + 1;

    const Breakpoint &a = breakpoints[segments[segment].first];
    const Breakpoint &b = breakpoints[segments[segment].last];
    double            f[last + 1], tau[last + 1], x[last + 1][2];
    std::copy(a.xi, a.xi + 2, x[0]);
    std::copy(b.xi, b.xi + 2, x[last]);
    tau[0]            = a.tau;
    tau[last]         = b.tau;
    f[0]              = snapped(inside_by(x[0], side));
    f[last]           = snapped(inside_by(x[last], side));
    const double sign = f[0] + f[last] >= 0 ? 1. : -1.;
    double       low = a.tau, high = b.tau;
    for (unsigned int round = 0; round < rounds; ++round)
      {
        const double width = (high - low) / last;
        Lanes        samples, xi[2];
        for (unsigned int l = 0; l < n_lanes; ++l)
          samples[l] = low + width * (l + 1.);
        pull_back_segment(segments[segment], samples, xi);
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            x[l + 1][0] = xi[0][l];
            x[l + 1][1] = xi[1][l];
            tau[l + 1]  = samples[l];
            f[l + 1]    = snapped(inside_by(x[l + 1], side));
          }
        unsigned int n_found = 0, best = 0, before = 0;
        bool         beside = both_beside(shape, x[0], x[1], side);
        for (unsigned int i = 1; i <= last; ++i)
          {
            if (f[i] * f[before] < 0 &&
                !both_beside(shape, x[before], x[i], side))
              {
                ++n_found;
                crossings.push_back({segment,
                                     side,
                                     tau[before],
                                     tau[i],
                                     f[before],
                                     f[i],
                                     0.,
                                     {0., 0.}});
              }
            if (f[i] != 0.)
              before = i;
            if (i == last)
              break;
            const bool was_beside = beside;
            beside                = both_beside(shape, x[i], x[i + 1], side);
            if (!(was_beside && beside) &&
                (best == 0 || sign * f[i] < sign * f[best]))
              best = i;
          }
        if (n_found > 0 || best == 0 || (f[0] == 0. && f[last] == 0.))
          return;
        low  = tau[best] - width;
        high = tau[best] + width;
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
