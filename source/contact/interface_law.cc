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
    static const std::vector<std::string> names = {
      "tie", "slide", "contact", "tresca", "spring"};
    return names;
  }

  double
  InterfaceLaw::gap(const InterfacePoint &point) const
  {
    return point.normal *
             (has_mesh_gap ? point.jump + point.mesh_gap : point.jump) +
           point.offset;
  }

  namespace
  {
    /// lambda_t + c s
    Tensor<1, 3>
    trial_traction(const InterfacePoint &point, const double c)
    {
      const Tensor<1, 3> along = point.traction - c * point.jump;
      return along - (point.normal * along) * point.normal;
    }
  } // namespace

  bool
  InterfaceLaw::sticks(const InterfacePoint &point, const double c) const
  {
    return !has_friction() ||
           trial_traction(point, c).norm() <=
             point.friction.of(point.normal * point.traction);
  }

  double
  InterfaceLaw::violation(const InterfacePoint &point, const double c) const
  {
    const Tensor<1, 3> &n    = point.normal;
    const double        pull = n * point.traction;
    if (is_one_sided())
      {
        double result = complementarity_violation(gap(point), pull, c);
        if (has_friction())
          {
            Tensor<1, 3> followed = trial_traction(point, c);
            const double bound    = point.friction.of(pull);
            if (const double size = followed.norm(); size > bound)
              followed *= bound / size;
            result += (point.traction - pull * n - followed).norm_square() / c;
          }
        return result;
      }
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
  InterfaceLaw::penalty(const InterfaceStiffness              &of_tie,
                        const std::vector<InterfaceStiffness> &springs) const
  {
    InterfaceStiffness result = of_tie;
    if (constrained == ConstrainedDirections::normal)
      result.tangential = 0.;
    if (springs.empty())
      return result;
    InterfaceStiffness mean{0., 0.};
    for (const InterfaceStiffness &spring : springs)
      {
        mean.normal += spring.normal / springs.size();
        mean.tangential += spring.tangential / springs.size();
      }
    const auto in_series = [](const double tie, const double spring) {
      return tie > 0. && spring > 0. ? 1. / (1. / tie + 1. / spring) : 0.;
    };
    return {in_series(of_tie.normal, mean.normal),
            in_series(of_tie.tangential, mean.tangential)};
  }
} // namespace mortise
