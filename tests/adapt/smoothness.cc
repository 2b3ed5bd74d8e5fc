// Proves that Legendre coefficients fall as the nearest pole says, and that
// cells at corners and edges are told from those beside them, on any degree,
// direction and size.
#include <mortise/adapt/smoothness.h>
#include <mortise/body/elements/fe_legendre.h>

#include <cmath>
#include <functional>

#include "../verdict.h"

using namespace mortise;


namespace
{
  using Function = std::function<double(const dealii::Point<3> &)>;

  /// On the cell with lower corner @p corner and size @p h.
  std::vector<double>
  coefficients(const unsigned int      degree,
               const dealii::Point<3> &corner,
               const double            h,
               const Function         &function)
  {
    const FE_Legendre                   element(degree);
    std::vector<dealii::Vector<double>> values;
    for (const auto &point : element.get_generalized_support_points())
      {
        values.emplace_back(1);
        values.back()[0] = function(corner + h * point);
      }
    std::vector<double> result(element.n_dofs_per_cell());
    element.convert_generalized_support_point_values_to_dof_values(values,
                                                                   result);
    return result;
  }

  double
  decay(const unsigned int      degree,
        const dealii::Point<3> &corner,
        const double            h,
        const Function         &function)
  {
    return legendre_decay(degree, {coefficients(degree, corner, h, function)});
  }

  /// A pole at distance @p d times its size from the face of the unit cell, in
  /// direction @p axis.
  void
  check_pole(const double d, const unsigned int axis)
  {
    const double z = 1. + 2. * d;
    verdict("pole at " + std::to_string(d) + " in direction " +
              std::to_string(axis),
            std::fabs(
              decay(8,
                    {},
                    1.,
                    [&](const auto &x) { return std::log(1. + d - x[axis]); }) -
              (z - std::sqrt(z * z - 1.))),
            0.04);
    const auto zero = coefficients(8, {}, 1., [](const auto &) { return 0.; });
    verdict("pressure with a pole at " + std::to_string(d) + " in direction " +
              std::to_string(axis),
            std::fabs(legendre_decay(8,
                                     {zero},
                                     coefficients(7,
                                                  {},
                                                  1.,
                                                  [&](const auto &x) {
                                                    return 1. /
                                                           (1. + d - x[axis]);
                                                  }),
                                     1.) -
                      (z - std::sqrt(z * z - 1.))),
            0.04);
  }

  /// A displacement that is not smooth beside a pressure that is: the larger
  /// one counts.
  void
  check_pressure(const unsigned int degree, const Function &rough)
  {
    const auto displacement = coefficients(degree, {}, 1., rough);
    const auto pressure = coefficients(degree - 1, {}, 1., [](const auto &x) {
      return std::exp(x[0] + x[1] + x[2]);
    });
    for (const auto &[unit, smooth] :
         {std::pair<double, bool>(1e2, true), {1e-4, false}})
      verdict("pressure times " + std::to_string(unit) + ", degree " +
                std::to_string(degree),
              is_smooth(
                legendre_decay(degree, {displacement}, pressure, unit)) !=
                smooth,
              0.);
  }
} // namespace

int
main()
{
  for (const double d : {0.25, 0.5, 1.})
    for (const unsigned int axis : {0, 1, 2})
      check_pole(d, axis);
  const Function corner = [](const auto &x) {
    return std::pow(x.square(), 0.3);
  };
  const Function edge = [](const auto &x) {
    return std::pow(x[0] * x[0] + x[2] * x[2], 0.25) *
           std::sin(0.5 * std::atan2(x[2], x[0] + 1e-300));
  };
  for (const unsigned int p : {3, 4, 5, 6, 7, 8})
    check_pressure(p, corner);
  for (const unsigned int p : {3, 4, 5, 6, 7, 8})
    for (const double h : {1., 1e-3})
      {
        const std::string of =
          ", degree " + std::to_string(p) + ", size " + std::to_string(h);
        // the larger of what is allowed and what is: 1 is too much
        verdict("a cell at a corner is told" + of,
                is_smooth(decay(p, {}, h, corner)),
                0.);
        verdict("at an edge" + of, is_smooth(decay(p, {}, h, edge)), 0.);
        verdict("one cell away from a corner" + of,
                !is_smooth(decay(p, {h, h, 0.}, h, corner)),
                0.);
        verdict("one cell away from an edge" + of,
                !is_smooth(decay(p, {h, 0., h}, h, edge)),
                0.);
      }
}
