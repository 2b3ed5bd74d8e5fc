#include <deal.II/base/exceptions.h>

#include <mortise/interface/projection.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    // Newton converges quadratically: after a step of this size (in reference
    // coordinates) the error is its square.
    constexpr double       step_tolerance = 3e-8;
    constexpr unsigned int max_iterations = 25;

    // The face's own polynomial continues it this far beyond its reference
    // domain, so that edges along its sides stay smooth at the corners; farther
    // out its tangents do.
    constexpr double margin = 0.125;
  } // namespace



  void
  SlaveMap::reinit(const SurfaceFace &slave)
  {
    reference_shape = slave.shape;
    frame           = slave.frame;
    is_linear       = slave.linear;
    polynomial.reinit(slave, frame.center);

    const Tensor<1, 3> area =
      cross_product_3d(frame.tangent[0], frame.tangent[1]);
    const double volume = area * frame.normal;
    height_dual         = to_vec3(area / volume);
    for (unsigned int i = 0; i < 2; ++i)
      center_dual[i] = to_vec3(frame.dual[i]);

    const auto &n    = slave.vertex_normals;
    vertex_normal[0] = to_vec3(n[0]);
    vertex_normal[1] = to_vec3(n[1] - n[0]);
    vertex_normal[2] = to_vec3(n[2] - n[0]);
    vertex_normal[3] = to_vec3(n[3] - n[2] - n[1] + n[0]);

    normal_twist = 0;
    for (unsigned int v = 0; v < n_vertices(slave.shape); ++v)
      for (unsigned int i = 0; i < n_chart_axes(slave.shape); ++i)
        normal_twist = std::max(normal_twist,
                                std::abs(frame.axis(i) * n[v]) /
                                  std::max(0.1, frame.normal * n[v]));
    // Outside of the face its tangents continue it, so the distance between the
    // chart and the true coordinates grows in proportion: twice the deviation
    // on the face and a half.
    const auto beyond = [&](const double deviation) {
      return is_linear ? 0. : 0.5 + 3. * std::max(0., deviation);
    };
    for (unsigned int i = 0; i < 2; ++i)
      near.lower[i] = -beyond(-frame.chart.lower[i]);
    for (unsigned int i = 0; i < 3; ++i)
      near.upper[i] = 1. + beyond(frame.chart.upper[i] - 1.);
    domain = {{{0., 0.}}, {{1., 1., 1.}}};
    if (slave.shape == FaceShape::quadrilateral)
      domain.upper[2] = near.upper[2] = frame.chart.upper[2];
    height_limit = slave.size;
  }



  void
  SlaveMap::chart(const Vec3<Lanes> &x, Lanes (&xi)[2], Lanes &height) const
  {
    xi[0]  = frame.center_xi + dot(x, center_dual[0]);
    xi[1]  = frame.center_xi + dot(x, center_dual[1]);
    height = dot(x, height_dual);
  }



  void
  SlaveMap::evaluate(const Lanes (&xi)[2],
                     Vec3<Lanes> &x,
                     Vec3<Lanes> (&dx)[2]) const
  {
    polynomial.evaluate(xi[0], xi[1], x, dx);
  }



  Vec3<Lanes>
  SlaveMap::normal(const Lanes (&xi)[2]) const
  {
    Vec3<Lanes> n;
    for (unsigned int d = 0; d < 3; ++d)
      n[d] = vertex_normal[0][d] + xi[0] * vertex_normal[1][d] +
             xi[1] * (vertex_normal[2][d] + xi[0] * vertex_normal[3][d]);
    return n;
  }



  void
  SlaveMap::evaluate_extended(const Lanes (&xi)[2],
                              const Lanes &alpha,
                              Vec3<Lanes> &x,
                              Vec3<Lanes> (&dx)[2],
                              Vec3<Lanes> &n) const
  {
    Lanes inside[2] = {xi[0], xi[1]};
    clamp_into(reference_shape, margin, inside);
    const Lanes outside[2] = {xi[0] - inside[0], xi[1] - inside[1]};
    polynomial.evaluate(inside[0], inside[1], x, dx);
    x = x + outside[0] * dx[0] + outside[1] * dx[1];
    n = normal(inside);
    if (reference_shape == FaceShape::triangle)
      {
        add_normal_rates(xi, alpha, dx);
        return;
      }
    const Lanes zero    = broadcast(0.);
    const Lanes alpha_1 = outside[0] == 0. ? alpha : zero;
    const Lanes alpha_2 = outside[1] == 0. ? alpha : zero;
    for (unsigned int d = 0; d < 3; ++d)
      {
        dx[0][d] +=
          alpha_1 * (vertex_normal[1][d] + inside[1] * vertex_normal[3][d]);
        dx[1][d] +=
          alpha_2 * (vertex_normal[2][d] + inside[0] * vertex_normal[3][d]);
      }
  }



  // A triangle's field is linear, n = n_0 + xi_1 n_1 + xi_2 n_2. With u the
  // distances from the corner (-margin, -margin), u_1 + u_2 = S > S_max beyond
  // the hypotenuse, inside = S_max/S u - margin and d inside_i / d xi_j =
  // S_max/S (delta_ij - u_i/S).
  void
  SlaveMap::add_normal_rates(const Lanes (&xi)[2],
                             const Lanes &alpha,
                             Vec3<Lanes> (&dx)[2]) const
  {
    const Lanes zero = broadcast(0.), low = broadcast(-margin);
    const Lanes u[2]   = {maximum(xi[0], low) + margin,
                          maximum(xi[1], low) + margin};
    const Lanes sum    = u[0] + u[1];
    const Lanes beyond = sum > 1. + 3. * margin ? 1. / sum : zero;
    const Lanes scale  = beyond > 0. ? (1. + 3. * margin) * beyond : zero + 1.;
    for (unsigned int j = 0; j < 2; ++j)
      {
        const Lanes rate = xi[j] > low ? alpha * scale : zero;
        for (unsigned int d = 0; d < 3; ++d)
          dx[j][d] += rate * (vertex_normal[1 + j][d] -
                              beyond * (u[0] * vertex_normal[1][d] +
                                        u[1] * vertex_normal[2][d]));
      }
  }



  unsigned int
  SlaveMap::pull_back(const Vec3<Lanes> &x,
                      const bool         has_guess,
                      Lanes (&xi)[2],
                      Lanes &alpha) const
  {
    Lanes chart_xi[2], height;
    chart(x, chart_xi, height);
    if (!has_guess || is_linear)
      {
        xi[0] = chart_xi[0];
        xi[1] = chart_xi[1];
        alpha = height;
      }
    if (is_linear)
      return 0;

    const Lanes widening =
      normal_twist * minimum(absolute(height), broadcast(height_limit));
    const unsigned int is_near =
      lanes_above(widening, near.outside_by(chart_xi));
    unsigned int active = is_near;
    for (unsigned int iteration = 0; active != 0 && iteration < max_iterations;
         ++iteration)
      {
        Vec3<Lanes> x_s, dx[2], n;
        evaluate_extended(xi, alpha, x_s, dx, n);
        Lanes step[3];
        solve_3x3(dx[0], dx[1], n, x - x_s, step);
        xi[0] += step[0];
        xi[1] += step[1];
        alpha = step[2];
        // Outside of the face only the side matters, and the second
        // derivatives of the continuation are left out: a looser tolerance,
        // continuous at its boundary.
        const Lanes outside = domain.outside_by(xi);
        const Lanes allowed =
          step_tolerance + maximum(broadcast(0.), 1e-2 * (outside - margin));
        const unsigned int moving =
          lanes_above(maximum(absolute(step[0]), absolute(step[1])), allowed);
        // alpha enters the first matrix with its guess: a second step makes it
        // quadratic.
        if (iteration > 0)
          active &= moving;
      }

    // Far away, and where the continuation folds, the chart says on which side
    // a point lies.
    const unsigned int all = (1u << n_lanes) - 1;
    if (is_near == all && active == 0)
      return 0;
    unsigned int failed = 0;
    const Lanes  beside = frame.chart.outside_by(chart_xi);
    for (unsigned int l = 0; l < n_lanes; ++l)
      {
        const unsigned int bit = 1u << l;
        if ((active & bit) != 0 && !(beside[l] > 0.05))
          failed |= bit;
        if ((is_near & bit) == 0 || (active & bit) != 0)
          {
            xi[0][l] = chart_xi[0][l];
            xi[1][l] = chart_xi[1][l];
            alpha[l] = height[l];
          }
      }
    return failed;
  }



  void
  SlaveMap::pull_back_derivative(const Vec3<Lanes> &dx,
                                 const Lanes (&xi)[2],
                                 const Lanes &alpha,
                                 Lanes (&dxi)[2]) const
  {
    if (is_linear)
      {
        dxi[0] = dot(dx, center_dual[0]);
        dxi[1] = dot(dx, center_dual[1]);
        return;
      }
    // x_m' = (dx_s/dxi + alpha dn/dxi) xi' + alpha' n; far away the chart's, as
    // in pull_back().
    Vec3<Lanes> x_s, dx_s[2], n;
    evaluate_extended(xi, alpha, x_s, dx_s, n);
    Lanes rate[3];
    solve_3x3(dx_s[0], dx_s[1], n, dx, rate);
    const Lanes beyond = near.outside_by(xi);
    for (unsigned int i = 0; i < 2; ++i)
      dxi[i] = beyond > 0. ? dot(dx, center_dual[i]) : rate[i];
  }



  void
  MasterMap::reinit(const SurfaceFace &master, const Point<3> &origin)
  {
    shape       = master.shape;
    is_affine   = master.affine;
    orientation = master.orientation;
    polynomial.reinit(master, origin);
    for (unsigned int k = 0; k < n_vertices(shape); ++k)
      edges[k].reinit(polynomial, shape, k);
    center_xi = master.frame.center_xi;
    center    = to_vec3(master.frame.center - origin);
    for (unsigned int i = 0; i < 2; ++i)
      tangent[i] = to_vec3(master.frame.tangent[i]);
  }



  unsigned int
  MasterMap::project(const Vec3<Lanes> &x,
                     const Vec3<Lanes> &n,
                     const bool         has_guess,
                     Lanes (&eta)[2],
                     Lanes       &alpha,
                     Vec3<Lanes> &x_m,
                     Lanes       &slope) const
  {
    const Vec3<Lanes> minus_n = {{-n[0], -n[1], -n[2]}};
    Lanes             step[3];
    if (!has_guess || is_affine)
      {
        const Vec3<Lanes> t_1 = broadcast(tangent[0]),
                          t_2 = broadcast(tangent[1]);
        solve_3x3(t_1, t_2, minus_n, x - broadcast(center), step);
        eta[0] = center_xi + step[0];
        eta[1] = center_xi + step[1];
        alpha  = step[2];
        if (is_affine)
          {
            x_m   = broadcast(center) + step[0] * t_1 + step[1] * t_2;
            slope = orientation * dot(n, cross(t_1, t_2));
            return 0;
          }
      }

    unsigned int       failed = iterate(x, n, eta, alpha, x_m, slope);
    const unsigned int behind = lanes_above(slope, broadcast(0.));
    if ((failed | behind) != 0)
      {
        // A strongly curved face: its linear picture was no good beginning, or
        // led to a point that looks the other way.
        nearest_samples(x, n, failed | behind, eta);
        failed = iterate(x, n, eta, alpha, x_m, slope);
      }
    return failed;
  }



  unsigned int
  MasterMap::iterate(const Vec3<Lanes> &x,
                     const Vec3<Lanes> &n,
                     Lanes (&eta)[2],
                     Lanes       &alpha,
                     Vec3<Lanes> &x_m,
                     Lanes       &slope) const
  {
    const Vec3<Lanes> minus_n = {{-n[0], -n[1], -n[2]}};
    unsigned int      active  = (1u << n_lanes) - 1;
    for (unsigned int iteration = 0; active != 0 && iteration < max_iterations;
         ++iteration)
      {
        // A partner lies on the face; farther out the polynomial means nothing.
        clamp_into(shape, 0.5, eta);
        Vec3<Lanes> dx[2];
        Lanes       step[3];
        polynomial.evaluate(eta[0], eta[1], x_m, dx);
        solve_3x3(dx[0], dx[1], minus_n, x - x_m, step);
        eta[0] += step[0];
        eta[1] += step[1];
        alpha  = step[2];
        x_m    = x_m + step[0] * dx[0] + step[1] * dx[1];
        slope  = orientation * dot(n, cross(dx[0], dx[1]));
        active = lanes_above(maximum(absolute(step[0]), absolute(step[1])),
                             broadcast(step_tolerance));
      }
    return active;
  }



  void
  MasterMap::nearest_samples(const Vec3<Lanes> &x,
                             const Vec3<Lanes> &n,
                             const unsigned int wanted,
                             Lanes (&eta)[2]) const
  {
    const ReferenceRule &samples = gauss_rule(7).on(shape);
    Lanes                chosen, best = broadcast(1e300);
    for (unsigned int l = 0; l < n_lanes; ++l)
      chosen[l] = (wanted & (1u << l)) != 0 ? 1. : 0.;
    for (unsigned int i = 0; i < samples.weight.size(); ++i)
      {
        const Lanes e[2] = {broadcast(samples.xi_1[i]),
                            broadcast(samples.xi_2[i])};
        Vec3<Lanes> x_m, dx[2];
        polynomial.evaluate(e[0], e[1], x_m, dx);
        const Vec3<Lanes> off    = cross(x_m - x, n);
        const Lanes       facing = orientation * dot(n, cross(dx[0], dx[1]));
        const Lanes distance = facing < 0. ? dot(off, off) : broadcast(1e200);
        const Lanes better   = distance < best ? chosen : broadcast(0.);
        best                 = minimum(best, distance);
        for (unsigned int d = 0; d < 2; ++d)
          eta[d] = better > 0. ? e[d] : eta[d];
      }
  }
} // namespace mortise
