#include <mortise/interface/clipping.h>

#include <algorithm>

namespace mortise
{
  namespace
  {
    // A curved piece whose middle is this close to the side on which both of
    // its ends lie runs along that side.
    constexpr double along_side = 1e-12;

    inline bool
    same_point(const double (&a)[2], const double (&b)[2])
    {
      return a[0] == b[0] && a[1] == b[1];
    }
  } // namespace



  void
  LoopClipper::solve_crossings()
  {
    for (unsigned int begin = 0; begin < crossings.size(); begin += n_lanes)
      solve_batch(begin,
                  std::min<unsigned int>(n_lanes, crossings.size() - begin));
    for (auto &crossing : crossings)
      {
        if (!(crossing.tau >= crossing.tau_0 && crossing.tau <= crossing.tau_1))
          solve_by_sections(crossing);
        put_on_side(crossing.xi, crossing.side);
        snap_to_sides(shape, crossing.xi);
      }
  }



  // Newton's method for x_m(tau) = x_s(xi) + alpha n(xi) with xi held on its
  // side: unknowns are tau, the way along the side and alpha. What
  // leaves its bracket or does not converge keeps a tau that is not a number.
  void
  LoopClipper::solve_batch(const unsigned int begin, const unsigned int n)
  {
    Lanes        tau, xi[2], alpha, along[2], low, high;
    unsigned int edge[n_lanes];
    for (unsigned int l = 0; l < n_lanes; ++l)
      {
        const Crossing   &crossing = crossings[begin + std::min(l, n - 1)];
        const Breakpoint &a = breakpoints[segments[crossing.segment].first];
        const Breakpoint &b = breakpoints[segments[crossing.segment].last];
        const double      weight = crossing.f_0 / (crossing.f_0 - crossing.f_1);
        edge[l]                  = a.edge;
        low[l]                   = crossing.tau_0;
        high[l]                  = crossing.tau_1;
        tau[l] = crossing.tau_0 + weight * (crossing.tau_1 - crossing.tau_0);
        const double t = (tau[l] - a.tau) / (b.tau - a.tau);
        double       guess[2];
        for (unsigned int i = 0; i < 2; ++i)
          guess[i] = (1 - t) * a.xi[i] + t * b.xi[i];
        put_on_side(guess, crossing.side);
        for (unsigned int i = 0; i < 2; ++i)
          {
            xi[i][l]    = guess[i];
            along[i][l] = side_direction(crossing.side, i);
          }
      }
    Vec3<Lanes> x_m, dx_m;
    evaluate_edges(master->edges, edge, tau, x_m, dx_m);
    Lanes ignored[2];
    slave->chart(x_m, ignored, alpha);
    const Lanes  slack  = 1e-12 * (high - low);
    unsigned int active = (1u << n_lanes) - 1;
    for (unsigned int iteration = 0; active != 0 && iteration < 12; ++iteration)
      {
        Vec3<Lanes> x_s, dx[2], normal;
        slave->evaluate_extended(xi, alpha, x_s, dx, normal);
        const Vec3<Lanes> free = along[0] * dx[0] + along[1] * dx[1];
        Lanes             step[3];
        // The residual is small: where the edge runs along the side and the
        // matrix is nearly singular, the rounding of both steps still agrees.
        solve_3x3(dx_m, free, normal, x_s + alpha * normal - x_m, step);
        tau += step[0];
        xi[0] -= along[0] * step[1];
        xi[1] -= along[1] * step[1];
        alpha -= step[2];
        tau = minimum(maximum(tau, low - 0.5 * (high - low)),
                      high + 0.5 * (high - low));
        const Lanes change =
          maximum(absolute(step[0]) / (high - low), absolute(step[1]));
        if (iteration > 0)
          active &= lanes_above(change, broadcast(3e-8));
        evaluate_edges(master->edges, edge, tau, x_m, dx_m);
      }
    for (unsigned int l = 0; l < n; ++l)
      {
        Crossing  &crossing = crossings[begin + l];
        const bool good     = (active & (1u << l)) == 0 &&
                          tau[l] >= low[l] - slack[l] &&
                          tau[l] <= high[l] + slack[l];
        crossing.tau =
          good ? std::min(std::max(tau[l], low[l]), high[l]) : std::nan("");
        crossing.xi[0] = xi[0][l];
        crossing.xi[1] = xi[1][l];
      }
  }



  // The safe way: nine-fold sections of the bracket.
  void
  LoopClipper::solve_by_sections(Crossing &crossing)
  {
    double low = crossing.tau_0, high = crossing.tau_1;
    double ends[2][2];
    bool   known[2] = {false, false};
    for (unsigned int round = 0; round < 17; ++round)
      {
        Lanes tau, xi[2];
        for (unsigned int l = 0; l < n_lanes; ++l)
          tau[l] = low + (high - low) * (l + 1.) / (n_lanes + 1.);
        pull_back_segment(segments[crossing.segment], tau, xi);
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            const double here[2]  = {xi[0][l], xi[1][l]};
            const double f        = inside_by(here, crossing.side);
            const bool   beyond   = f * crossing.f_0 <= 0;
            (beyond ? high : low) = tau[l];
            known[beyond]         = true;
            std::copy(here, here + 2, ends[beyond]);
            if (std::abs(f) <= on_side)
              {
                std::copy(here, here + 2, crossing.xi);
                crossing.tau = tau[l];
                return;
              }
            if (beyond)
              break;
          }
        if (known[0] && known[1] &&
            both_beside(shape, ends[0], ends[1], crossing.side))
          break;
      }
    // Of no interest, or a jump of the continuation far away: its place does
    // not matter.
    std::copy(ends[known[1]], ends[known[1]] + 2, crossing.xi);
    crossing.tau = 0.5 * (low + high);
  }



  void
  LoopClipper::build_pieces()
  {
    std::sort(crossings.begin(),
              crossings.end(),
              [](const auto &a, const auto &b) {
                return a.segment != b.segment ? a.segment < b.segment :
                                                a.tau < b.tau;
              });
    whole_master      = true;
    unsigned int next = 0;
    for (unsigned int s = 0; s < segments.size(); ++s)
      {
        const Breakpoint &a = breakpoints[segments[s].first];
        const Breakpoint &b = breakpoints[segments[s].last];
        LoopPiece         piece;
        piece.edge    = a.edge;
        piece.has_mid = segments[s].checked && (next == crossings.size() ||
                                                crossings[next].segment != s);
        std::copy(segments[s].mid, segments[s].mid + 2, piece.mid);
        piece.tau_p = a.tau;
        std::copy(a.xi, a.xi + 2, piece.p);
        for (; next < crossings.size() && crossings[next].segment == s; ++next)
          {
            piece.tau_q = crossings[next].tau;
            std::copy(crossings[next].xi, crossings[next].xi + 2, piece.q);
            add_piece(segments[s], piece);
            piece.tau_p = piece.tau_q;
            std::copy(piece.q, piece.q + 2, piece.p);
          }
        piece.tau_q = b.tau;
        std::copy(b.xi, b.xi + 2, piece.q);
        add_piece(segments[s], piece);
      }
    locate_middles();
    for (auto &piece : loop)
      if (piece.edge >= 0)
        settle(piece);
  }



  // Pieces do not cross a side any more: an end outside makes the whole piece
  // outside, and its chord serves as well.
  void
  LoopClipper::add_piece(const Segment &segment, LoopPiece piece)
  {
    for (const unsigned int side : sides_of(shape))
      if (segment.far || inside_by(piece.p, side) < 0 ||
          inside_by(piece.q, side) < 0)
        {
          piece.edge   = -1;
          whole_master = false;
          break;
        }
    if (piece.edge < 0 || piece.tau_q > piece.tau_p)
      loop.push_back(piece);
  }



  void
  LoopClipper::locate_middles()
  {
    unsigned int member[n_lanes], edge[n_lanes], count = 0;
    for (unsigned int i = 0; i < loop.size(); ++i)
      {
        if (loop[i].edge >= 0 && !loop[i].has_mid)
          member[count++] = i;
        if (count == 0 || (count < n_lanes && i + 1 < loop.size()))
          continue;
        Lanes tau, xi[2], alpha{};
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            const LoopPiece &piece = loop[member[std::min(l, count - 1)]];
            edge[l]                = piece.edge;
            tau[l]                 = 0.5 * (piece.tau_p + piece.tau_q);
            for (unsigned int i = 0; i < 2; ++i)
              xi[i][l] = 0.5 * (piece.p[i] + piece.q[i]);
          }
        Vec3<Lanes> x, dx;
        evaluate_edges(master->edges, edge, tau, x, dx);
        if (slave->pull_back(x, true, xi, alpha) != 0)
          failed = true;
        for (unsigned int l = 0; l < count; ++l)
          {
            loop[member[l]].mid[0] = xi[0][l];
            loop[member[l]].mid[1] = xi[1][l];
          }
        count = 0;
      }
  }



  // A piece with both ends on one side is inside or outside as its middle is;
  // along the side and outside, the side takes its place.
  void
  LoopClipper::settle(LoopPiece &piece)
  {
    for (const unsigned int side : sides_of(shape))
      if (inside_by(piece.p, side) == 0. && inside_by(piece.q, side) == 0.)
        {
          const double f = inside_by(piece.mid, side);
          if (f <= along_side)
            {
              piece.edge   = -1;
              whole_master = whole_master && f >= -along_side;
              return;
            }
        }
  }



  // One step of Sutherland and Hodgman's walk. Curved pieces are inside of all
  // sides.
  void
  LoopClipper::clip_straight(const unsigned int side)
  {
    scratch.clear();
    for (const auto &piece : loop)
      {
        const double f_p = inside_by(piece.p, side),
                     f_q = inside_by(piece.q, side);
        if (piece.edge >= 0 || (f_p >= 0 && f_q >= 0))
          scratch.push_back(piece);
        else if (f_p > 0 || f_q > 0)
          {
            LoopPiece    part = piece;
            const double t    = f_p / (f_p - f_q);
            double       cut[2];
            for (unsigned int i = 0; i < 2; ++i)
              cut[i] = (1 - t) * piece.p[i] + t * piece.q[i];
            put_on_side(cut, side);
            if (shape == FaceShape::triangle)
              snap_to_sides(shape, cut);
            std::copy(cut, cut + 2, f_p > 0 ? part.q : part.p);
            scratch.push_back(part);
          }
      }
    // Close the gaps along the side.
    loop.clear();
    for (unsigned int i = 0; i < scratch.size(); ++i)
      {
        const LoopPiece &piece = scratch[i];
        if (piece.edge >= 0 || !same_point(piece.p, piece.q))
          loop.push_back(piece);
        const LoopPiece &next = scratch[i + 1 < scratch.size() ? i + 1 : 0];
        if (!same_point(piece.q, next.p))
          {
            LoopPiece bridge;
            std::copy(piece.q, piece.q + 2, bridge.p);
            std::copy(next.p, next.p + 2, bridge.q);
            loop.push_back(bridge);
          }
      }
  }



  void
  LoopClipper::measure()
  {
    area = centroid[0] = centroid[1] = 0;
    whole_slave                      = false;
    if (loop.empty())
      return;
    // Moments about the first corner, so that slivers far from zero keep their
    // digits.
    const double base[2]   = {loop[0].p[0], loop[0].p[1]};
    double       moment[2] = {0, 0};
    bool         straight  = true;
    const auto   add       = [&](const double(&a)[2], const double(&b)[2]) {
      const double x[2]  = {a[0] - base[0], a[1] - base[1]},
                   y[2]  = {b[0] - base[0], b[1] - base[1]};
      const double twice = x[0] * y[1] - x[1] * y[0];
      area += 0.5 * twice;
      for (unsigned int i = 0; i < 2; ++i)
        moment[i] += twice * (x[i] + y[i]) / 6.;
    };
    for (const auto &piece : loop)
      if (piece.edge >= 0)
        {
          straight = false;
          add(piece.p, piece.mid);
          add(piece.mid, piece.q);
        }
      else
        add(piece.p, piece.q);
    for (unsigned int i = 0; i < 2; ++i)
      centroid[i] = base[i] + moment[i] / area;
    for (const unsigned int side : sides_of(shape))
      if (!(inside_by(centroid, side) >= 0))
        {
          // a loop whose area is rounding only
          std::copy(base, base + 2, centroid);
          break;
        }
    whole_slave =
      straight && std::abs(std::abs(area) - reference_area(shape)) <= 1e-13;
  }
} // namespace mortise
