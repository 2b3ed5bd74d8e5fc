#include <algorithm>
#include <cmath>
#include <cstring>

#include "pair_scratch.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Scratch = PairIntegrator::Scratch;

    void
    clear_points(Scratch &scratch)
    {
      scratch.xi[0].clear();
      scratch.xi[1].clear();
      scratch.reference_weight.clear();
    }

    void
    add_point(Scratch     &scratch,
              const double xi_1,
              const double xi_2,
              const double weight)
    {
      scratch.xi[0].push_back(xi_1);
      scratch.xi[1].push_back(xi_2);
      scratch.reference_weight.push_back(weight);
    }

    // The slave face is covered: its own rule.
    void
    place_in_slave(Scratch &scratch, const ReferenceRule &rule)
    {
      for (unsigned int q = 0; q < rule.weight.size(); ++q)
        add_point(scratch, rule.xi_1[q], rule.xi_2[q], rule.weight[q]);
    }

    // The master face lies in the slave face: the master's rule, pulled back. d
    // xi = (d xi / d eta) d eta.
    bool
    place_in_master(Scratch &scratch, const ReferenceRule &rule)
    {
      for (unsigned int begin = 0; begin < rule.weight.size(); begin += n_lanes)
        {
          const unsigned int count =
            std::min<unsigned int>(n_lanes, rule.weight.size() - begin);
          Lanes eta[2], weight;
          for (unsigned int l = 0; l < n_lanes; ++l)
            {
              const unsigned int q = begin + std::min(l, count - 1);
              eta[0][l]            = rule.xi_1[q];
              eta[1][l]            = rule.xi_2[q];
              weight[l]            = rule.weight[q];
            }
          Vec3<Lanes> x, dx[2];
          scratch.master.polynomial.evaluate(eta[0], eta[1], x, dx);
          Lanes xi[2], alpha, rate_1[2], rate_2[2];
          if (scratch.slave.pull_back(x, false, xi, alpha) != 0)
            return false;
          scratch.slave.pull_back_derivative(dx[0], xi, alpha, rate_1);
          scratch.slave.pull_back_derivative(dx[1], xi, alpha, rate_2);
          weight *= absolute(rate_1[0] * rate_2[1] - rate_1[1] * rate_2[0]);
          for (unsigned int l = 0; l < count; ++l)
            add_point(scratch, xi[0][l], xi[1][l], weight[l]);
        }
      return true;
    }

    // gamma and gamma' at the Gauss points of all curved pieces, piece after
    // piece.
    bool
    evaluate_curves(Scratch &scratch, const GaussRule &rule)
    {
      const auto &loop = scratch.clipper.loop;
      for (unsigned int i = 0; i < 2; ++i)
        {
          scratch.gamma[i].clear();
          scratch.gamma_rate[i].clear();
        }
      unsigned int edge[n_lanes], count = 0;
      Lanes        tau, length, xi[2];
      const auto   flush = [&]() {
        for (unsigned int l = count; l < n_lanes; ++l)
          {
            edge[l]   = edge[0];
            tau[l]    = tau[0];
            length[l] = length[0];
            xi[0][l]  = xi[0][0];
            xi[1][l]  = xi[1][0];
          }
        Vec3<Lanes> x, dx;
        evaluate_edges(scratch.master.edges, edge, tau, x, dx);
        Lanes alpha{}, rate[2];
        if (scratch.slave.pull_back(x, true, xi, alpha) != 0)
          return false;
        scratch.slave.pull_back_derivative(dx, xi, alpha, rate);
        for (unsigned int l = 0; l < count; ++l)
          for (unsigned int i = 0; i < 2; ++i)
            {
              scratch.gamma[i].push_back(xi[i][l]);
              scratch.gamma_rate[i].push_back(rate[i][l] * length[l]);
            }
        count = 0;
        return true;
      };
      for (const auto &piece : loop)
        if (piece.edge >= 0)
          for (unsigned int q = 0; q < rule.n; ++q)
            {
              const double t = rule.point[q];
              edge[count]    = piece.edge;
              length[count]  = piece.tau_q - piece.tau_p;
              tau[count]     = piece.tau_p + t * length[count];
              for (unsigned int i = 0; i < 2;
                   ++i) // parabola through ends and middle
                xi[i][count] = (1 - t) * (1 - 2 * t) * piece.p[i] +
                               4 * t * (1 - t) * piece.mid[i] +
                               t * (2 * t - 1) * piece.q[i];
              if (++count == n_lanes && !flush())
                return false;
            }
      return count == 0 || flush();
    }

    // The apex of the sectors: a corner on whose lines most straight pieces lie
    // (their sectors are empty), or the centroid.
    void
    choose_apex(const LoopClipper &clipper, double (&apex)[2])
    {
      apex[0]           = clipper.centroid[0];
      apex[1]           = clipper.centroid[1];
      unsigned int most = 0;
      for (const auto &candidate : clipper.loop)
        {
          unsigned int n = 0;
          for (const auto &piece : clipper.loop)
            if (piece.edge < 0)
              n += (candidate.p[0] == piece.p[0] &&
                    candidate.p[1] == piece.p[1]) ||
                       (candidate.p[0] == piece.q[0] &&
                        candidate.p[1] == piece.q[1]) ?
                     1 :
                     0;
          if (n > most)
            {
              most    = n;
              apex[0] = candidate.p[0];
              apex[1] = candidate.p[1];
            }
        }
    }

    // Sectors (s,t) -> c + s (gamma(t) - c) with dA = s (gamma - c) x gamma' ds
    // dt, signed.
    unsigned int
    place_in_sectors(Scratch &scratch, const GaussRule &rule, const double sign)
    {
      double c[2];
      choose_apex(scratch.clipper, c);
      unsigned int n_cells = 0, next = 0;
      for (const auto &piece : scratch.clipper.loop)
        {
          const double d[2] = {piece.q[0] - piece.p[0],
                               piece.q[1] - piece.p[1]};
          const double twice =
            (piece.p[0] - c[0]) * d[1] - (piece.p[1] - c[1]) * d[0];
          if (piece.edge < 0 && std::abs(twice) <= empty_area)
            continue;
          ++n_cells;
          for (unsigned int j = 0; j < rule.n; ++j)
            {
              double r[2], determinant = twice;
              for (unsigned int i = 0; i < 2; ++i)
                r[i] = (piece.edge < 0 ? piece.p[i] + rule.point[j] * d[i] :
                                         scratch.gamma[i][next]) -
                       c[i];
              if (piece.edge >= 0)
                {
                  determinant = r[0] * scratch.gamma_rate[1][next] -
                                r[1] * scratch.gamma_rate[0][next];
                  ++next;
                }
              for (unsigned int k = 0; k < rule.n; ++k)
                {
                  const double s = rule.point[k];
                  add_point(scratch,
                            c[0] + s * r[0],
                            c[1] + s * r[1],
                            sign * determinant * s * rule.weight[k] *
                              rule.weight[j]);
                }
            }
        }
      return n_cells;
    }

    inline void
    store(const Lanes &values, const unsigned int count, double *target)
    {
      if (count == n_lanes)
        std::memcpy(target, &values, sizeof(Lanes));
      else
        for (unsigned int l = 0; l < count; ++l)
          target[l] = values[l];
    }

    // Lanes beyond @p count repeat the last value.
    inline Lanes
    load(const double *source, const unsigned int count)
    {
      Lanes result{};
      if (count == n_lanes)
        std::memcpy(&result, source, sizeof(Lanes));
      else
        for (unsigned int l = 0; l < n_lanes; ++l)
          result[l] = source[std::min(l, count - 1)];
      return result;
    }

    // Map the placed points to both faces. The status says whether the pair is
    // accepted.
    PairStatus
    map_points(Scratch &scratch, PairResult &result, IntegrationPoints &points)
    {
      const unsigned int n      = scratch.reference_weight.size();
      const Point<3>    &origin = scratch.slave.origin();
      points.resize(n);
      bool normals_agree = false;
      for (unsigned int begin = 0; begin < n; begin += n_lanes)
        {
          const unsigned int count = std::min(n_lanes, n - begin);
          Lanes              eta[2], alpha, slope;
          Lanes weight = load(&scratch.reference_weight[begin], count);
          Lanes xi[2]  = {load(&scratch.xi[0][begin], count),
                          load(&scratch.xi[1][begin], count)};
          clamp_into(scratch.slave.shape(), 0., xi);
          Vec3<Lanes> x_s, dx_s[2], x_m;
          scratch.slave.evaluate(xi, x_s, dx_s);
          const Vec3<Lanes> normal = scratch.slave.normal(xi),
                            area   = cross(dx_s[0], dx_s[1]);
          if (scratch.master.project(
                x_s, normal, false, eta, alpha, x_m, slope) != 0)
            return PairStatus::failed;
          weight *= square_root(dot(area, area));
          alpha *= square_root(dot(normal, normal));
          normals_agree  = normals_agree || !(largest(slope) < 0);
          result.max_gap = std::max(result.max_gap, largest(absolute(alpha)));
          for (unsigned int l = 0; l < count; ++l)
            result.area += weight[l];
          store(weight, count, &points.weight[begin]);
          store(alpha, count, &points.gap[begin]);
          for (unsigned int i = 0; i < 2; ++i)
            {
              store(xi[i], count, &points.slave_xi[i][begin]);
              store(eta[i], count, &points.master_eta[i][begin]);
            }
          for (unsigned int d = 0; d < 3; ++d)
            {
              store(origin[d] + x_s[d], count, &points.slave_x[d][begin]);
              store(origin[d] + x_m[d], count, &points.master_x[d][begin]);
            }
        }
      return normals_agree ? PairStatus::normals_agree :
             !(result.max_gap <= scratch.gap_limit) ? PairStatus::too_far :
                                                      PairStatus::accepted;
    }

    struct Judgement
    {
      PairStatus status;
      double     distortion;
    };

    double
    variation(const Lanes &a)
    {
      const Lanes  size = absolute(a);
      const double high = largest(size), low = -largest(-size);
      return (high - low) / (high + low);
    }

    // How far the pieces are from straight lines run through evenly. A surface
    // element that varies by d along a line moves its middle by d/4 of its
    // length.
    double
    bending(const std::vector<LoopPiece> &loop)
    {
      double result = 0;
      for (const auto &piece : loop)
        if (piece.edge >= 0)
          {
            double shift = 0, length = 0;
            for (unsigned int i = 0; i < 2; ++i)
              {
                const double d = piece.q[i] - piece.p[i];
                const double m = piece.mid[i] - piece.p[i] - 0.5 * d;
                length += d * d;
                shift += m * m;
              }
            if (shift > 0)
              result =
                std::max(result,
                         4. * std::sqrt(shift / std::max(length, shift)));
          }
      return result;
    }

    // Whether the pair can be accepted at all, judged at the middle of the
    // overlap, so that hopeless candidates cost little and are not counted as
    // failures; and how much the surface elements of both faces vary between
    // its corners.
    Judgement
    judge(const Scratch &scratch)
    {
      const LoopClipper &clipper = scratch.clipper;
      Lanes              xi[2];
      for (unsigned int i = 0; i < 2; ++i)
        {
          xi[i] = broadcast(clipper.centroid[i]);
          for (unsigned int l = 1; l < n_lanes; ++l)
            xi[i][l] =
              clipper.loop[(l - 1) * clipper.loop.size() / (n_lanes - 1)].p[i];
        }
      clamp_into(scratch.slave.shape(), 0., xi);
      Vec3<Lanes> x_s, dx_s[2], x_m;
      Lanes       eta[2], alpha, slope;
      scratch.slave.evaluate(xi, x_s, dx_s);
      const Vec3<Lanes>  n = scratch.slave.normal(xi);
      const unsigned int failed =
        scratch.master.project(x_s, n, false, eta, alpha, x_m, slope);
      const PairStatus status = (failed & 1u) != 0 ? PairStatus::failed :
                                slope[0] >= 0      ? PairStatus::normals_agree :
                                std::abs(alpha[0]) > 2 * scratch.gap_limit ?
                                                PairStatus::too_far :
                                                PairStatus::accepted;
      return {status,
              std::max({1e-10,
                        variation(dot(n, cross(dx_s[0], dx_s[1]))),
                        variation(slope),
                        bending(clipper.loop)})};
    }
  } // namespace



  PairResult
  integrate_curved_pair(Scratch           &scratch,
                        const SurfaceFace &master,
                        IntegrationPoints &points)
  {
    PairResult result;
    scratch.master.reinit(master, scratch.slave.origin());
    scratch.slave.height_limit = scratch.gap_limit;
    const bool   clipped = scratch.clipper.clip(scratch.slave, scratch.master);
    const double area    = scratch.clipper.area;
    if (std::abs(area) <= empty_area)
      {
        result.status = clipped || !scratch.samples_meet() ?
                          PairStatus::no_overlap :
                          PairStatus::failed;
        return result;
      }
    const Judgement judgement = judge(scratch);
    result.status             = judgement.status;
    if (result.status == PairStatus::accepted && !clipped)
      result.status = PairStatus::failed;
    if (result.status == PairStatus::failed && !scratch.samples_meet())
      result.status = PairStatus::no_overlap;
    if (result.status != PairStatus::accepted)
      return result;

    const GaussRule &rule = scratch.rule(judgement.distortion);
    clear_points(scratch);
    bool placed    = true;
    result.n_cells = 1;
    if (scratch.clipper.whole_slave)
      place_in_slave(scratch, rule.on(scratch.slave.shape()));
    else if (scratch.clipper.whole_master)
      placed = place_in_master(scratch, rule.on(master.shape));
    else
      {
        placed = evaluate_curves(scratch, rule);
        if (placed)
          result.n_cells = place_in_sectors(scratch, rule, area > 0 ? 1. : -1.);
      }
    result.status =
      placed ? map_points(scratch, result, points) : PairStatus::failed;
    return result;
  }
} // namespace mortise
