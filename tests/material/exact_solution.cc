// Exact solutions: known numbers, equilibrium, continuity between layers, exact
// derivatives.

#include <mortise/base/error.h>
#include <mortise/material/exact_solution.h>
#include <verdict.h>

#include <cmath>
#include <iostream>

using namespace mortise;
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
  constexpr auto sphere   = LameSolution::Geometry::sphere;
  constexpr auto cylinder = LameSolution::Geometry::cylinder;

  double
  relative(const double got, const double exact)
  {
    return std::fabs(got / exact - 1.);
  }

  /// Largest relative errors of u(1), u(1.5), u(2) and sigma_r(1.5), E = 1000,
  /// p = 1.
  double
  error_of_numbers(const LameSolution::Geometry geometry,
                   const double                 nu,
                   const std::array<double, 4> &exact)
  {
    const LinearElastic material{1000., nu};
    const LameSolution  two(geometry,
                            {{1.5, 2., material}, {1., 1.5, material}},
                           1.);
    const LameSolution  one(geometry, {{1., 2., material}}, 1.);
    double              error = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const double r = 1. + 0.5 * i;
        error          = std::max(
          {error,
                    relative(one.radial_displacement(r, 0), exact[i]),
                    relative(two.radial_displacement(r, r < 1.7 ? 1 : 0), exact[i])});
      }
    return std::max({error,
                     relative(one.radial_stress(1.5, 0), exact[3]),
                     relative(two.radial_stress(1.5, 0), exact[3]),
                     relative(two.radial_stress(1.5, 1), exact[3])});
  }

  template <typename Value, typename F>
  Value
  difference(const F           &f,
             const Point<3>    &p,
             const unsigned int direction,
             const double       h)
  {
    const auto at = [&](const double steps) {
      Point<3> q = p;
      q[direction] += steps * h;
      return f(q);
    };
    return (8. * (at(1.) - at(-1.)) - (at(2.) - at(-2.))) / (12. * h);
  }

  struct Errors
  {
    double gradient = 0., law = 0., equilibrium = 0.;
  };

  /// Gradient against differences of the displacement, stress against the law,
  /// body force against differences of the stress; relative to the largest
  /// entries.
  Errors
  derivative_errors(const ExactSolution &solution,
                    const Point<3>      &p,
                    const unsigned int   body,
                    const Material      &material,
                    const double         h)
  {
    const Tensor<2, 3>          g     = solution.gradient(p, body);
    const SymmetricTensor<2, 3> sigma = solution.stress(p, body);
    Errors                      errors;
    errors.law = (sigma - material.stress(g)).norm() / sigma.norm();
    Tensor<1, 3> divergence;
    double       scale = 0.;
    for (unsigned int j = 0; j < 3; ++j)
      {
        const auto d = difference<Tensor<1, 3>>(
          [&](const Point<3> &q) { return solution.displacement(q, body); },
          p,
          j,
          h);
        for (unsigned int i = 0; i < 3; ++i)
          errors.gradient =
            std::max(errors.gradient, std::fabs(g[i][j] - d[i]) / g.norm());
        const auto ds = difference<SymmetricTensor<2, 3>>(
          [&](const Point<3> &q) { return solution.stress(q, body); }, p, j, h);
        for (unsigned int i = 0; i < 3; ++i)
          divergence[i] += ds[i][j];
        scale = std::max(scale, ds.norm());
      }
    errors.equilibrium =
      (divergence + solution.body_force(p, body)).norm() / scale;
    return errors;
  }

  const RigidMotion moved({{20., -35., 70.}}, {{3., -2., 5.}});

  void
  check_lame(const std::string &name, const LameSolution::Geometry geometry)
  {
    const std::vector<LinearElastic> materials = {{1e6, 0.2},
                                                  {1., 0.45},
                                                  {30., -0.3}};
    const LameSolution               solution(geometry,
                                              {{1., 1.5, materials[0]},
                                               {1.5, 2., materials[1]},
                                               {2., 2.2, materials[2]}},
                                1.,
                                0.25,
                                moved);
    Errors                           worst;
    double                           frame = 0., traction = 0.;
    for (unsigned int body = 0; body < 3; ++body)
      for (const double r : {1.2, 1.7, 2.1})
        {
          const Tensor<1, 3> direction = Tensor<1, 3>({0.48, 0.6, 0.64});
          const Tensor<1, 3> local =
            geometry == sphere ? direction : Tensor<1, 3>({0.6, 0.8, 0.});
          const Point<3> p =
            moved(Point<3>(r * local + (geometry == sphere ? 0. : 0.7) *
                                         Tensor<1, 3>({0., 0., 1.})));
          const Errors e =
            derivative_errors(solution, p, body, materials[body], 2e-3);
          worst.gradient    = std::max(worst.gradient, e.gradient);
          worst.law         = std::max(worst.law, e.law);
          worst.equilibrium = std::max(worst.equilibrium, e.equilibrium);
          const Tensor<1, 3> radial = moved.rotation * local;
          const double       u_r    = solution.radial_displacement(r, body);
          frame =
            std::max(frame,
                     (solution.displacement(p, body) - u_r * radial).norm() /
                       std::fabs(u_r));
          const double s = solution.radial_stress(r, body);
          traction =
            std::max(traction,
                     (solution.stress(p, body) * radial - s * radial).norm() /
                       std::fabs(s));
        }
    verdict(name + ": gradient against differences of the displacement",
            worst.gradient,
            1e-9);
    verdict(name + ": stress against the law", worst.law, 1e-13);
    verdict(name + ": equilibrium against differences of the stress",
            worst.equilibrium,
            1e-9);
    verdict(name + ": displacement is radial in the moved frame", frame, 1e-13);
    verdict(name + ": radial traction in the moved frame", traction, 1e-12);
  }

  void
  check_contrast(const std::string &name, const LameSolution::Geometry geometry)
  {
    double jump_u = 0., jump_s = 0., ends = 0.;
    for (const double contrast : {1e-6, 1e-3, 1., 1e3, 1e6})
      for (const double scale : {1e-3, 1., 1e6})
        {
          const LameSolution solution(
            geometry,
            {{scale, 1.5 * scale, {1000., 0.3}},
             {1.5 * scale, 2. * scale, {1000. * contrast, 0.2}}},
            1.,
            0.1);
          const double c    = 1.5 * scale;
          const double u    = solution.radial_displacement(c, 0);
          const double jump = std::fabs(u - solution.radial_displacement(c, 1));
          const double largest =
            std::max({std::fabs(u),
                      std::fabs(solution.radial_displacement(scale, 0)),
                      std::fabs(solution.radial_displacement(2. * scale, 1))});
          jump_u = std::max(jump_u, jump / largest);
          jump_s = std::max(jump_s,
                            relative(solution.radial_stress(c, 0),
                                     solution.radial_stress(c, 1)));
          ends =
            std::max({ends,
                      relative(solution.radial_stress(scale, 0), -1.),
                      relative(solution.radial_stress(2. * scale, 1), -0.1)});
        }
    verdict(
      name +
        ": displacement at the interface from both sides (of the largest), contrast 1e-6 to 1e6",
      jump_u,
      1e-14);
    verdict(
      name +
        ": radial stress at the interface from both sides, contrast 1e-6 to 1e6",
      jump_s,
      1e-12);
    verdict(name + ": pressures at the ends, contrast 1e-6 to 1e6",
            ends,
            1e-12);
  }

  void
  check_expressions()
  {
    const std::vector<Material> materials = {LinearElastic{10., 0.3},
                                             LinearElastic{250., 0.1},
                                             Orthotropic{{{10., 1., 0.5}},
                                                         {{0.35, 0.6, 0.02}},
                                                         {{0.7, 0.05, 0.8}},
                                                         {{20., -35., 70.}}}};
    const ExpressionSolution    solution(
      VectorExpression(
        "sin(2*x)*y + z^3*x; exp(x*y/2)*cos(z); x*y*z + x^3 - atan(y*z)"),
      materials);
    Errors worst;
    for (unsigned int body = 0; body < 3; ++body)
      for (const Point<3> &p :
           {Point<3>(0.3, 0.4, 0.5), Point<3>(-0.7, 1.1, 0.2)})
        {
          const Errors e =
            derivative_errors(solution, p, body, materials[body], 2e-3);
          worst.gradient    = std::max(worst.gradient, e.gradient);
          worst.law         = std::max(worst.law, e.law);
          worst.equilibrium = std::max(worst.equilibrium, e.equilibrium);
        }
    verdict("expressions: gradient against differences of the displacement",
            worst.gradient,
            1e-9);
    verdict("expressions: stress against the law", worst.law, 1e-13);
    verdict("expressions: body force against differences of the stress",
            worst.equilibrium,
            1e-9);
  }

  /// Without divergence, at nu = 0.5, with a mean pressure.
  void
  check_incompressible()
  {
    const LinearElastic      law{10., 0.5, true};
    const Material           material(law);
    const ExpressionSolution solution(
      VectorExpression("sin(2*y + z); cos(x - 2*z); exp(x*y/2)"),
      {material},
      Expression("cos(2*x)*sin(y + z)"));
    const Point<3> p(0.3, 0.4, 0.5);
    const auto     stress   = solution.stress(p, 0);
    const double   mean     = std::cos(0.6) * std::sin(0.9);
    const auto     gradient = solution.gradient(p, 0);
    verdict("incompressible: mean pressure",
            std::fabs(-trace(stress) / 3. - mean),
            1e-14);
    verdict(
      "incompressible: shear",
      (deviator(stress) - 2. * law.lame_mu() * symmetrize(gradient)).norm(),
      1e-13);
    verdict("incompressible: pressure of the mixed form is the mean one",
            std::fabs(material.pressure(gradient, stress) - mean),
            1e-13);
    verdict("incompressible: stress by that pressure",
            (material.stress(gradient, mean) - stress).norm(),
            1e-13);
    Tensor<1, 3> divergence;
    for (unsigned int j = 0; j < 3; ++j)
      {
        const auto slope = difference<SymmetricTensor<2, 3>>(
          [&](const Point<3> &x) { return solution.stress(x, 0); }, p, j, 2e-3);
        for (unsigned int i = 0; i < 3; ++i)
          divergence[i] += slope[i][j];
      }
    verdict("incompressible: body force against differences of the stress",
            (divergence + solution.body_force(p, 0)).norm(),
            1e-8);
  }

  /// The two shares of the mixed form add up to the law, and both are bounded
  /// where the law is not.
  void
  check_mixed()
  {
    for (const double nu : {0.1, 0.3, 0.49, 0.499999})
      {
        const LinearElastic material{10., nu, true};
        const double        sum =
          material.displacement_lambda() + 1. / material.compressibility();
        verdict("mixed form, nu = " + std::to_string(nu) + ": lambda",
                relative(sum, material.lame_lambda()),
                1e-9);
      }
    const LinearElastic limit{10., 0.5, true};
    verdict("mixed form: compressibility at 0.5", limit.compressibility(), 0.);
    verdict("mixed form: lambda of the displacement at 0.5",
            limit.displacement_lambda(),
            limit.lame_mu());
  }

  void
  refused(const std::string                      &what,
          const std::vector<LameSolution::Layer> &layers,
          const std::string                      &fragment)
  {
    check_message("refused: " + what,
                  [&] { LameSolution(sphere, layers, 1.); },
                  {fragment});
  }

  /// Parts 1..2 (E = 1000, nu = 0.3) and 2..3 (500, 0.25) with a gap: it closes
  /// under the published pressure inside, and what presses then; an
  /// interference opens under the published tension.
  void
  check_contact(const std::string           &what,
                const LameSolution::Geometry geometry,
                const double                 closes,
                const double                 at_60,
                const double                 opens)
  {
    const auto solve =
      [&](const double offset, const double inside, const double outside) {
        LameSolution::Layer outer{2., 3., {500., 0.25}};
        outer.offset_inside  = offset;
        outer.contact_inside = true;
        return LameSolution(geometry,
                            {{1., 2., {1000., 0.3}}, outer},
                            inside,
                            outside);
      };
    verdict(what + ", open just below",
            std::fabs(
              solve(0.01, closes * (1. - 1e-9), 0.).radial_stress(2., 1)),
            0.);
    verdict(what + ", closed just above",
            std::fabs(
              solve(0.01, closes * (1. + 1e-9), 0.).radial_stress(2., 1)) > 0. ?
              0. :
              1.,
            0.);
    verdict(what + ", gap just below",
            std::fabs(
              solve(0.01, closes * (1. - 1e-9), 0.).radial_displacement(2., 0) -
              0.01),
            1e-10);
    verdict(what + ", inflated",
            relative(-solve(0.01, 60., 0.).radial_stress(2., 1), at_60),
            1e-9);
    verdict(what + ", pulled open",
            std::fabs(
              solve(-0.01, 0., -opens * (1. + 1e-9)).radial_stress(2., 0)),
            0.);
    verdict(what + ", pulled nearly open",
            -solve(-0.01, 0., -opens * (1. - 1e-9)).radial_stress(2., 0) > 0. ?
              0. :
              1.,
            0.);
  }
} // namespace

int
main()
{
  verdict("thick sphere, nu = 0.3, published digits",
          error_of_numbers(sphere,
                           0.3,
                           {{8.0e-4, 4.158730e-4, 3.0e-4, -0.195767}}),
          2e-6);
  verdict("thick sphere, nu = 0.5, published digits",
          error_of_numbers(
            sphere, 0.5, {{8.571429e-4, 3.809524e-4, 2.142857e-4, -0.195767}}),
          2e-6);
  verdict(
    "thick cylinder, nu = 0.3, published digits",
    error_of_numbers(cylinder,
                     0.3,
                     {{1.906667e-3, 1.415556e-3, 1.213333e-3, -0.259259}}),
    2e-6);
  verdict("thick cylinder, nu = 0.5, published digits",
          error_of_numbers(cylinder,
                           0.5,
                           {{2.0e-3, 1.333333e-3, 1.0e-3, -0.259259}}),
          2e-6);
  check_lame("sphere of three layers", sphere);
  check_lame("cylinder of three layers", cylinder);
  check_contrast("sphere", sphere);
  check_contrast("cylinder", cylinder);
  check_contact(
    "cylinders in contact", cylinder, 8.241758242, 4.738430584, 0.7407407407);
  check_contact(
    "spheres in contact", sphere, 33.33333333, 1.455938697, 1.563786008);
  check_expressions();
  check_incompressible();
  check_mixed();
  refused("inner radius zero", {{0., 1., {}}}, "0 < inner < outer");
  refused("radii exchanged", {{2., 1., {}}}, "0 < inner < outer");
  refused("layers with a gap",
          {{1., 1.5, {}}, {1.6, 2., {}}},
          "ends at radius 1.5 and the next begins at 1.6");
  refused("no layers", {}, "no body");
}
