// See lower_smoothing_bound.h.
#include <mortise/solvers/multigrid/lower_smoothing_bound.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  namespace
  {
    // Less for high degrees and towards incompressible materials, so that
    // iterations stay the same: doc/measurements/tuning.md.
    constexpr double base = 0.13;

    double
    by_degree(const bool tetrahedra, const unsigned int degree)
    {
      return std::min(1., std::pow((tetrahedra ? 2. : 4.) / degree, 1.5));
    }

    double
    by_next_degree(const unsigned int degree, const unsigned int next)
    {
      return std::min(1., 2. * next / degree);
    }

    /// The next level is linear over @p n_steps between nodes, so that its
    /// smallest eigenvalue that is left goes with their square.
    double
    by_steps(const unsigned int n_steps)
    {
      return std::min(1., std::pow(6. / n_steps, 2));
    }

    /// The ratio is 3.5 for Poisson's ratio 0.3.
    double
    by_material(const Material &material)
    {
      return std::min(1., std::sqrt(3.5 / material.stiffness_ratio()));
    }
  } // namespace

  double
  lower_smoothing_bound(const NodalSpace          &space,
                        const bool                 finest,
                        const ThicknessCoarsening *thickness)
  {
    double factor = 1.;
    for (const Body *body : space.bodies())
      {
        const bool         tetrahedra = body->mesh.tetrahedra;
        const unsigned int degree     = space.degree(*body, body->max_degree());
        const bool         flat = thickness && thickness->flat[body->index];
        const double       of_next =
          flat ?
                  by_steps(thickness->n_steps) :
                  by_next_degree(degree,
                           thickness ? 1 : lower_degree(tetrahedra, degree));
        factor = std::min(factor,
                          of_next * by_degree(tetrahedra, degree) *
                            by_material(body->material));
      }
    return base * factor * (finest ? 1. : 0.5);
  }
} // namespace mortise
