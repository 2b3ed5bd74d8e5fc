#include <mortise/interface/clipping.h>
#include <mortise/interface/integration_cells.h>
#include <mortise/interface/surface_evaluation.h>

#include <algorithm>
#include <cmath>

#include "pair_scratch.h"

namespace mortise
{
  using namespace dealii;

  // Linear maps: cells are bilinear in (s,t), so n points are exact for total
  // degree 2n-2 in the reference coordinates; n = p+2 is exact for products of
  // two Q_1 functions and for all products of total degree 2p+2, which include
  // a Q_p function times a constant. On two triangles all products are of total
  // degree 2p, and n = p+1 is exact for them.
  //
  // Else the integrand is rational, with a pole of order m = p+3 or so where a
  // surface element vanishes: at distance 1/d from the middle of an overlap of
  // half width 1, d the distortion. Its expansion has terms binomial(m+k-1, k)
  // (2/rho)^k of degree 2p+k, with rho = (1 + sqrt(1 - d^2)) / d, and p+e
  // points miss those from k = 2e-1 on. The bound below was set by measurement
  // (tests/interface/overlap_integrals.cc): moments of degree p per direction
  // on any slave or master face, relative to its area, are right to about
  // 1e-11.
  unsigned int
  quadrature_points(const unsigned int degree_slave,
                    const unsigned int degree_master,
                    const double       distortion,
                    const bool         both_triangles)
  {
    const unsigned int degree = std::max(degree_slave, degree_master);
    if (distortion <= 0.)
      return degree + (both_triangles ? 1 : 2);
    const double d             = std::min(distortion, 0.95),
                 rho           = (1. + std::sqrt(1. - d * d)) / d;
    constexpr double bound     = 1e-8;
    constexpr int    max_extra = 24;
    double           term      = 1; // binomial(p+2+k, k) rho^-k
    for (int extra = 1, k = 1; extra <= max_extra; ++extra)
      {
        for (; k <= 2 * extra - 1; ++k)
          term *= (degree + 2 + k) / (k * rho);
        if (extra >= 2 && term <= bound)
          return degree + extra;
      }
    return degree + max_extra;
  }



  void
  IntegrationPoints::resize(const unsigned int n)
  {
    for (unsigned int i = 0; i < 2; ++i)
      {
        slave_xi[i].resize(n);
        master_eta[i].resize(n);
      }
    for (unsigned int d = 0; d < 3; ++d)
      {
        slave_x[d].resize(n);
        master_x[d].resize(n);
      }
    weight.resize(n);
    gap.resize(n);
  }



  void
  IntegrationPoints::move(const unsigned int from, const unsigned int to)
  {
    for (auto *arrays : {&slave_xi, &master_eta})
      for (auto &array : *arrays)
        array[to] = array[from];
    for (auto *arrays : {&slave_x, &master_x})
      for (auto &array : *arrays)
        array[to] = array[from];
    weight[to] = weight[from];
    gap[to]    = gap[from];
  }



  void
  IntegrationPoints::refer_to(const SurfaceFace &undeformed,
                              const SurfaceFace &slave)
  {
    FacePolynomial there, here;
    there.reinit(undeformed, undeformed.frame.center);
    here.reinit(slave, slave.frame.center);
    for (auto &array : undeformed_x)
      array.resize(size());
    for (unsigned int q = 0; q < size(); q += n_lanes)
      {
        const unsigned int n     = std::min<unsigned int>(n_lanes, size() - q);
        Lanes              xi[2] = {broadcast(slave.frame.center_xi),
                                    broadcast(slave.frame.center_xi)};
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int l = 0; l < n; ++l)
            xi[i][l] = slave_xi[i][q + l];
        Vec3<Lanes> x;
        const Lanes ratio =
          there.area_element(xi[0], xi[1], x) / here.area_element(xi[0], xi[1]);
        for (unsigned int l = 0; l < n; ++l)
          {
            weight[q + l] *= ratio[l];
            for (unsigned int d = 0; d < 3; ++d)
              undeformed_x[d][q + l] = undeformed.frame.center[d] + x[d][l];
          }
      }
  }



  void
  Coverage::add(const Coverage &other)
  {
    gap_sum += other.gap_sum;
    distance_sum += other.distance_sum;
    slave_area += other.slave_area;
    covered_area += other.covered_area;
    n_candidates += other.n_candidates;
    n_pairs += other.n_pairs;
    n_cells += other.n_cells;
    n_points += other.n_points;
    n_failures += other.n_failures;
    max_gap = std::max(max_gap, other.max_gap);
  }



  void
  Coverage::add(const PairResult &pair, const IntegrationPoints &points)
  {
    ++n_candidates;
    n_failures += pair.status == PairStatus::failed ? 1 : 0;
    if (pair.status != PairStatus::accepted)
      return;
    ++n_pairs;
    covered_area += pair.area;
    n_cells += pair.n_cells;
    n_points += points.size();
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        gap_sum += points.weight[q] * points.gap[q];
        distance_sum += points.weight[q] * std::fabs(points.gap[q]);
      }
    max_gap = std::max(max_gap, pair.max_gap);
  }



  PairIntegrator::PairIntegrator(const SearchDistance &distance)
    : scratch(std::make_unique<Scratch>())
  {
    scratch->distance = distance;
  }



  PairIntegrator::~PairIntegrator() = default;



  void
  PairIntegrator::reinit(const SurfaceFace &slave)
  {
    scratch->slave.reinit(slave);
    scratch->slave_size   = slave.size;
    scratch->slave_frame  = slave.frame;
    scratch->slave_linear = slave.linear;
    scratch->slave_area   = face_area(slave);
  }



  PairResult
  PairIntegrator::integrate(const SurfaceFace &master,
                            const unsigned int degree_slave,
                            const unsigned int degree_master,
                            IntegrationPoints &points)
  {
    scratch->begin_pair(master, degree_slave, degree_master);
    scratch->gap_limit =
      scratch->distance.of(std::max(scratch->slave_size, master.size));
    PairResult result = scratch->slave_linear && master.affine ?
                          integrate_linear_pair(*scratch, master, points) :
                          integrate_curved_pair(*scratch, master, points);
    if (result.status != PairStatus::accepted)
      {
        result.area    = 0;
        result.n_cells = 0;
        points.resize(0);
      }
    return result;
  }



  std::optional<PairResult>
  PairIntegrator::integrate_coinciding(const SurfaceFace &slave,
                                       const SurfaceFace &master,
                                       const unsigned int degree_slave,
                                       const unsigned int degree_master,
                                       IntegrationPoints &points)
  {
    scratch->begin_pair(master, degree_slave, degree_master);
    return integrate_coinciding_pair(*scratch, slave, master, points);
  }



  const GaussRule &
  PairIntegrator::Scratch::rule(const double distortion) const
  {
    if (n_points > 0)
      return gauss_rule(n_points);
    const unsigned int n =
      quadrature_points(degree_slave,
                        degree_master,
                        products == Products::of_flat_faces ? 0. : distortion,
                        both_triangles());
    // one more than these: what a rule leaves jumps as well
    return gauss_rule(
      products == Products::all ?
        std::max(n + 1, 2 * std::max(degree_slave, degree_master) + 2) :
        n);
  }



  bool
  PairIntegrator::Scratch::samples_meet() const
  {
    // Not on the boundary: faces that only touch do not meet.
    constexpr unsigned int n_samples = 8;
    constexpr double       rim       = 0.02;
    const auto             meet      = [&](const FaceShape shape,
                          const Lanes(&x)[2],
                          const Lanes &gap,
                          const Lanes &slope) {
      for (unsigned int l = 0; l < n_lanes; ++l)
        if (lies_inside(shape, x[0][l], x[1][l]) &&
            std::abs(gap[l]) <= gap_limit && slope[l] < 0)
          return true;
      return false;
    };
    const auto place =
      [](const FaceShape shape, const Lanes &s, const double t, Lanes(&x)[2]) {
        x[0] = shape == FaceShape::triangle ? s * (1. - t) : s;
        x[1] = broadcast(t);
      };
    Lanes first;
    for (unsigned int l = 0; l < n_lanes; ++l)
      first[l] = rim + (1. - 2. * rim) * l / (n_lanes - 1.);
    for (unsigned int j = 0; j < n_samples; ++j)
      {
        const double second = rim + (1. - 2. * rim) * j / (n_samples - 1.);
        Lanes        at[2], other[2], gap, slope;
        Vec3<Lanes>  x, dx[2], x_m;
        place(slave.shape(), first, second, at);
        slave.evaluate(at, x, dx);
        if (master.project(
              x, slave.normal(at), false, other, gap, x_m, slope) == 0 &&
            meet(master.shape, other, gap, slope))
          return true;
        place(master.shape, first, second, at);
        master.polynomial.evaluate(at[0], at[1], x, dx);
        if (slave.pull_back(x, false, other, gap) == 0 &&
            meet(slave.shape(),
                 other,
                 gap,
                 master.orientation *
                   dot(slave.normal(other), cross(dx[0], dx[1]))))
          return true;
      }
    return false;
  }



  void
  PairIntegrator::set_points_per_direction(const unsigned int n)
  {
    scratch->n_points = n;
  }



  void
  PairIntegrator::set_products(const Products of)
  {
    scratch->products = of;
  }



  double
  PairIntegrator::slave_area() const
  {
    return scratch->slave_area;
  }
} // namespace mortise
