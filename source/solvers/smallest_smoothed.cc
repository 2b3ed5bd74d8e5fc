// See smallest_smoothed.h.
#include <mortise/solvers/smallest_smoothed.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  namespace
  {
    // Iterations on the thick sphere, p = 2..8, with chebyshev.cc's degrees:
    // hexahedra 8, 10, 9, 11, 11, 13, 12 with `base` for all of them, 8, 9, 8,
    // 8, 8, 8, 8 as below; tetrahedra 9, 12, 12, 13, 15, 20, 24 and 9, 10, 8,
    // 8, 9, 9, 11; Poisson's ratio 0.49 (p = 2, 4, 6) 26, 27, 37 and 18, 15,
    // 14. The times are the same within what can be measured, since polynomials
    // of higher degree take fewer iterations.
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
  smallest_smoothed(const NodalSpace &space, const bool finest)
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
