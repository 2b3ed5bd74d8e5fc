#include <mortise/interface/clipping.h>

#include <algorithm>

namespace mortise
{
  namespace
  {
    // A curved piece whose middle is this close to the side on which both of its ends lie
    // runs along that side.
    constexpr double along_side = 1e-12;

    inline double
    inside_by(const double (&xi)[2], const unsigned int side)
    {
      return side % 2 == 0 ? xi[side / 2] : 1. - xi[side / 2];
    }

    inline bool
    same_point(const double (&a)[2], const double (&b)[2])
    {
      return a[0] == b[0] && a[1] == b[1];
    }
  } // namespace



  void
  LoopClipper::build_pieces()
  {
    std::sort(crossings.begin(), crossings.end(), [](const auto &a, const auto &b) {
      return a.segment != b.segment ? a.segment < b.segment : a.tau < b.tau;
    });
    whole_master      = true;
    unsigned int next = 0;
    for (unsigned int s = 0; s < segments.size(); ++s)
      {
        const Breakpoint &a = breakpoints[segments[s].first];
        const Breakpoint &b = breakpoints[segments[s].last];
        LoopPiece         piece;
        piece.edge    = a.edge;
        piece.has_mid = segments[s].checked &&
                        (next == crossings.size() || crossings[next].segment != s);
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



  // Pieces do not cross a side any more: an end outside makes the whole piece outside, and its
  // chord serves as well.
  void
  LoopClipper::add_piece(const Segment &segment, LoopPiece piece)
  {
    for (unsigned int side = 0; side < 4; ++side)
      if (segment.far || inside_by(piece.p, side) < 0 || inside_by(piece.q, side) < 0)
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



  // A piece with both ends on one side is inside or outside as its middle is; along the side
  // and outside, the side takes its place.
  void
  LoopClipper::settle(LoopPiece &piece)
  {
    for (unsigned int side = 0; side < 4; ++side)
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



  // One step of Sutherland and Hodgman's walk. Curved pieces are inside of all sides.
  void
  LoopClipper::clip_straight(const unsigned int side)
  {
    scratch.clear();
    for (const auto &piece : loop)
      {
        const double f_p = inside_by(piece.p, side), f_q = inside_by(piece.q, side);
        if (piece.edge >= 0 || (f_p >= 0 && f_q >= 0))
          scratch.push_back(piece);
        else if (f_p > 0 || f_q > 0)
          {
            LoopPiece    part = piece;
            const double t    = f_p / (f_p - f_q);
            double       cut[2];
            for (unsigned int i = 0; i < 2; ++i)
              cut[i] = (1 - t) * piece.p[i] + t * piece.q[i];
            cut[side / 2] = side % 2;
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
    // Moments about the first corner, so that slivers far from zero keep their digits.
    const double base[2]   = {loop[0].p[0], loop[0].p[1]};
    double       moment[2] = {0, 0};
    bool         straight  = true;
    const auto   add       = [&](const double(&a)[2], const double(&b)[2]) {
      const double x[2] = {a[0] - base[0], a[1] - base[1]}, y[2] = {b[0] - base[0], b[1] - base[1]};
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
    const bool inside_box = [&]() {
      for (unsigned int i = 0; i < 2; ++i)
        {
          centroid[i] = base[i] + moment[i] / area;
          if (!(centroid[i] >= 0 && centroid[i] <= 1))
            return false;
        }
      return true;
    }();
    if (!inside_box) // a loop whose area is rounding only
      std::copy(base, base + 2, centroid);
    whole_slave = straight && std::abs(std::abs(area) - 1.) <= 1e-13;
  }



  void
  clip_to_unit_square(ConvexPolygon &polygon)
  {
    ConvexPolygon result;
    for (unsigned int side = 0; side < 4 && polygon.n > 0; ++side)
      {
        result.n = 0;
        for (unsigned int i = 0; i < polygon.n; ++i)
          {
            const double(&p)[2] = polygon.x[i];
            const double(&q)[2] = polygon.x[i + 1 < polygon.n ? i + 1 : 0];
            const double f_p = inside_by(p, side), f_q = inside_by(q, side);
            if (f_p >= 0)
              {
                result.x[result.n][0]   = p[0];
                result.x[result.n++][1] = p[1];
              }
            if ((f_p > 0 && f_q < 0) || (f_p < 0 && f_q > 0))
              {
                // From the inner to the outer end, whichever way the edge is run through.
                const double(&in)[2] = f_p > 0 ? p : q, (&out)[2] = f_p > 0 ? q : p;
                const double f_in = std::max(f_p, f_q), f_out = std::min(f_p, f_q);
                const double t     = f_in / (f_in - f_out);
                const unsigned int o = 1 - side / 2;
                result.x[result.n][side / 2] = side % 2;
                result.x[result.n++][o]      = in[o] + t * (out[o] - in[o]);
              }
          }
        polygon = result;
      }
  }
} // namespace mortise
