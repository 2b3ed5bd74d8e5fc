// How the clipper cuts the edges of the master into pieces, see clipping.h.
#include <mortise/interface/clipping.h>

#include <algorithm>

namespace mortise
{
  // Cut an edge until each part is outside of the slave face on one side, or
  // short and flat enough in the slave's chart for its ends and slopes to
  // describe it.
  void
  LoopClipper::subdivide_edge(const unsigned int edge)
  {
    const EdgePolynomial &polynomial = master->edges[edge];
    const LagrangeBasis  &basis      = lagrange_basis(polynomial.degree);
    const unsigned int    n          = polynomial.degree + 1;
    double                nodal[3][max_face_nodes];
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto &c     = polynomial.coefficients;
        const auto  chart = slave->chart({{c[0][i], c[1][i], c[2][i]}});
        for (unsigned int d = 0; d < 3; ++d)
          nodal[d][i] = chart[d];
      }
    control.assign(3 * n, 0.);
    for (unsigned int d = 0; d < 3; ++d)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          control[d * n + i] += basis.bernstein[i][j] * nodal[d][j];
    breakpoints.push_back({edge, 0., {0., 0.}, {0., 0.}});
    subdivide(edge, 0., 1., 0);
  }



  void
  LoopClipper::subdivide(const unsigned int edge,
                         const double       tau_0,
                         const double       tau_1,
                         unsigned int       depth)
  {
    constexpr double       flat_enough = 0.25, short_enough = 3.;
    constexpr unsigned int max_depth = 14;

    const unsigned int n    = master->edges[edge].degree + 1;
    const unsigned int base = control.size() - 3 * n;
    double             low[3], high[3], bend = 0, length = 0;
    double             least_sum = control[base] + control[base + n];
    for (unsigned int i = 1; i < n; ++i)
      least_sum =
        std::min(least_sum, control[base + i] + control[base + n + i]);
    for (unsigned int d = 0; d < 3; ++d)
      {
        const double *c = &control[base + d * n];
        low[d] = high[d] = c[0];
        for (unsigned int i = 1; i < n; ++i)
          {
            low[d]  = std::min(low[d], c[i]);
            high[d] = std::max(high[d], c[i]);
            if (d < 2)
              bend = std::max(bend,
                              std::abs(c[i] - c[0] -
                                       (c[n - 1] - c[0]) * i / (n - 1.)));
          }
        if (d < 2)
          length = std::max(length, high[d] - low[d]);
      }
    const double height =
      std::min(std::max(high[2], -low[2]), slave->height_limit);
    const double        widening = slave->twist() * height;
    const ReferenceBox &near     = slave->near;
    const bool          far =
      low[0] > near.upper[0] + widening || high[0] < near.lower[0] - widening ||
      low[1] > near.upper[1] + widening || high[1] < near.lower[1] - widening ||
      least_sum > near.upper[2] + widening;
    const bool simple =
      bend <= flat_enough && (slave->linear() || length <= short_enough);
    if (far || simple || depth >= max_depth)
      {
        const unsigned int last = breakpoints.size();
        segments.push_back({last - 1, last, far, false, 0., {0., 0.}});
        breakpoints.push_back({edge, tau_1, {0., 0.}, {0., 0.}});
        return;
      }

    // de Casteljau: the left half goes on the stack, the right half stays below
    // it.
    control.resize(base + 6 * n);
    for (unsigned int d = 0; d < 3; ++d)
      {
        double *right = &control[base + d * n],
               *left  = &control[base + (3 + d) * n];
        for (unsigned int i = 0; i < n; ++i)
          {
            left[i] = right[0];
            for (unsigned int j = 0; j + 1 < n - i; ++j)
              right[j] = 0.5 * (right[j] + right[j + 1]);
          }
      }
    const double tau = 0.5 * (tau_0 + tau_1);
    subdivide(edge, tau_0, tau, depth + 1);
    control.resize(base + 3 * n);
    subdivide(edge, tau, tau_1, depth + 1);
  }
} // namespace mortise
