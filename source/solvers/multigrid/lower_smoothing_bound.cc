// See lower_smoothing_bound.h.
#include <mortise/solvers/multigrid/lower_smoothing_bound.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  namespace
  {
    // Less for high degrees and towards incompressible materials, so that
    // iterations stay the same: doc/tuning.md.
    constexpr double base = 0.13;

    double
    by_degree(const bool tetrahedra, const unsigned int degree)
    {
      const double p = degree, next = lower_degree(tetrahedra, degree);
      return std::min(1., 2. * next / p) *
             std::min(1., std::pow((tetrahedra ? 2. : 4.) / p, 1.5));
    }

    /// The ratio is 3.5 for Poisson's ratio 0.3.
    double
    by_material(const Material &material)
    {
      return std::min(1., std::sqrt(3.5 / material.stiffness_ratio()));
    }
  } // namespace

  double
  lower_smoothing_bound(const NodalSpace &space, const bool finest)
  {
    double factor = 1.;
    for (const Body *body : space.bodies())
      factor = std::min(factor,
                        by_degree(body->mesh.tetrahedra,
                                  space.degree(*body, body->max_degree())) *
                          by_material(body->material));
    return base * factor * (finest ? 1. : 0.5);
  }
} // namespace mortise
