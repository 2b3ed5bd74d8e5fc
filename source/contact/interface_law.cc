#include <mortise/contact/interface_law.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of gap and pressure, per area.
    double
    complementarity_violation(const double gap,
                              const double pressure,
                              const double c)
    {
      const double of_gap      = c * gap * gap,
                   of_pressure = pressure * pressure / c;
      if (gap > 0. && pressure > 0.)
        return std::min(of_gap, of_pressure);
      return (gap < 0. ? of_gap : 0.) + (pressure < 0. ? of_pressure : 0.);
    }
  } // namespace

  const std::vector<std::string> &
  interface_law_names()
  {
    static const std::vector<std::string> names = {"tie",
                                                   "slide",
                                                   "contact",
                                                   "spring"};
    return names;
  }

  double
  InterfaceLaw::gap(const InterfacePoint &point) const
  {
    return point.normal *
             (has_mesh_gap ? point.jump + point.mesh_gap : point.jump) +
           point.offset;
  }

  double
  InterfaceLaw::violation(const InterfacePoint &point, const double c) const
  {
    const Tensor<1, 3> &n    = point.normal;
    const double        pull = n * point.traction;
    if (is_one_sided())
      return complementarity_violation(gap(point), pull, c);
    const InterfaceStiffness K =
      stiffness ? stiffness(point.position) : InterfaceStiffness();
    double square =
      std::pow((gap(point) + pull / K.normal) / (1. + c / K.normal), 2);
    if (constrained == ConstrainedDirections::all)
      square += (point.jump - (n * point.jump) * n +
                 (point.traction - pull * n) / K.tangential)
                  .norm_square() /
                std::pow(1. + c / K.tangential, 2);
    return c * square;
  }

  InterfaceStiffness
  InterfaceLaw::penalty(const double                           of_tie,
                        const std::vector<InterfaceStiffness> &springs) const
  {
    if (of_tie == 0.)
      return {0., 0.};
    InterfaceStiffness result{
      of_tie, constrained == ConstrainedDirections::all ? of_tie : 0.};
    if (springs.empty())
      return result;
    InterfaceStiffness mean{0., 0.};
    for (const InterfaceStiffness &spring : springs)
      {
        mean.normal += spring.normal / springs.size();
        mean.tangential += spring.tangential / springs.size();
      }
    const auto in_series = [of_tie](const double spring) {
      return spring > 0. ? 1. / (1. / of_tie + 1. / spring) : 0.;
    };
    return {in_series(mean.normal), in_series(mean.tangential)};
  }
} // namespace mortise
