#include <mortise/interface/clipping.h>
#include <mortise/interface/integration_cells.h>

#include "pair_scratch.h"

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  unsigned int
  quadrature_points(const unsigned int degree_slave,
                    const unsigned int degree_master,
                    const bool         linear)
  {
    const unsigned int degree = std::max(degree_slave, degree_master);
    return linear ? degree + 2 : degree + 4;
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
  Coverage::add(const Coverage &other)
  {
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
  Coverage::add(const PairResult &pair, const unsigned int n_points_of_pair)
  {
    ++n_candidates;
    n_failures += pair.status == PairStatus::failed ? 1 : 0;
    if (pair.status != PairStatus::accepted)
      return;
    ++n_pairs;
    covered_area += pair.area;
    n_cells += pair.n_cells;
    n_points += n_points_of_pair;
    max_gap = std::max(max_gap, pair.max_gap);
  }



  PairIntegrator::PairIntegrator(const double search_fraction)
    : scratch(std::make_unique<Scratch>())
  {
    scratch->search_fraction = search_fraction;
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
    const bool         linear = scratch->slave_linear && master.affine;
    const unsigned int n =
      scratch->n_points > 0 ? scratch->n_points :
                              quadrature_points(degree_slave, degree_master, linear);
    const GaussRule &rule = gauss_rule(n);
    scratch->gap_limit    = scratch->search_fraction * std::max(scratch->slave_size, master.size);
    PairResult result     = linear ? integrate_linear_pair(*scratch, master, rule, points) :
                                     integrate_curved_pair(*scratch, master, rule, points);
    if (result.status != PairStatus::accepted)
      {
        result.area    = 0;
        result.n_cells = 0;
        points.resize(0);
      }
    return result;
  }



  void
  PairIntegrator::set_points_per_direction(const unsigned int n)
  {
    scratch->n_points = n;
  }



  double
  PairIntegrator::slave_area() const
  {
    return scratch->slave_area;
  }
} // namespace mortise
