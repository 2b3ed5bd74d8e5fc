#include <mortise/interface/clipping.h>

#include <algorithm>

namespace mortise
{
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
    // Outside on one side by more than the description may be wrong? The
    // cubic's control points contain it.
    for (const unsigned int side : sides_of(shape))
      {
        const double f_0 = inside_by(a.xi, side), f_1 = inside_by(b.xi, side);
        const double third = (b.tau - a.tau) / 3.;
        const double nearest =
          std::max({f_0,
                    f_1,
                    f_0 + third * inside_rate(a.dxi, side),
                    f_1 - third * inside_rate(b.dxi, side)});
        segment.far = segment.far || nearest < -3. * segment.deviation;
      }
    segment.checked = segment.checked || segment.far;
    return segment.checked;
  }
} // namespace mortise
