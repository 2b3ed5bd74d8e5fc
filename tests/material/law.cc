// Proves what laws do at one point: tangents against differences of stresses,
// one point against several at once, symmetry of the moduli, the meaning of
// each constant of an orthotropic law by tension and shear along its axes,
// Hooke's law as a special case, rotation of strains and axes together,
// averages, and which constants are refused.

#include <deal.II/base/vectorization.h>

#include <mortise/base/rigid_motion.h>
#include <mortise/material/material.h>
#include <verdict.h>

#include <cmath>
#include <iostream>
#include <random>

using namespace mortise;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
  const LinearElastic hooke{10., 0.3};
  const Orthotropic   wood{{{10., 1., 0.5}},
                           {{0.35, 0.6, 0.02}},
                           {{0.7, 0.05, 0.8}},
                           {{20., -35., 70.}}};

  std::mt19937 generator(7);

  Tensor<2, 3>
  random_gradient()
  {
    std::uniform_real_distribution<> any(-1., 1.);
    Tensor<2, 3>                     result;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        result[i][j] = any(generator);
    return result;
  }

  template <typename Law>
  void
  check_tangent(const std::string &name, const Law &law)
  {
    const Tensor<2, 3> at = random_gradient(), direction = random_gradient();
    double             state[3][3], h[3][3], s[3][3];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          state[i][j] = at[i][j];
          h[i][j]     = direction[i][j];
        }
    law.tangent(state, h, s);
    const double       step       = 1e-3;
    const Tensor<2, 3> difference = (stress_at(law, at + step * direction) -
                                     stress_at(law, at - step * direction)) /
                                    (2. * step);
    double error = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        error = std::max(error, std::fabs(s[i][j] - difference[i][j]));
    verdict(name + ": tangent against differences of the stress",
            error / difference.norm(),
            1e-11);

    const Moduli C         = moduli(law);
    double       asymmetry = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int b = 0; b < 3; ++b)
            asymmetry = std::max({asymmetry,
                                  std::fabs(C[i][a][j][b] - C[j][b][i][a]),
                                  std::fabs(C[i][a][j][b] - C[a][i][j][b])});
    verdict(name + ": moduli symmetric", asymmetry, 1e-14);
  }

  /// Several points at once in the type @p Number against one in double.
  template <typename Number>
  void
  check_lanes(const std::string &name,
              const Material    &material,
              const double       tolerance)
  {
    using V                               = dealii::VectorizedArray<Number>;
    constexpr unsigned int          lanes = V::size();
    std::array<Tensor<2, 3>, lanes> gradients;
    V                               h[3][3], s[3][3];
    for (unsigned int lane = 0; lane < lanes; ++lane)
      {
        gradients[lane] = random_gradient();
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            h[i][j][lane] = gradients[lane][i][j];
      }
    std::visit([&](const auto &law) { law.stress(h, s); },
               material.displacement_law<Number>());
    double error = 0.;
    for (unsigned int lane = 0; lane < lanes; ++lane)
      {
        const auto expected = material.stress(gradients[lane]);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            error = std::max(error,
                             std::fabs(double(s[i][j][lane]) - expected[i][j]) /
                               expected.norm());
      }
    verdict(name + ": several points at once", error, tolerance);
  }

  /// Strains of the textbook under stresses along the axes of the material.
  void
  check_constants()
  {
    Orthotropic law = wood;
    law.axes        = {{0., 0., 0.}};
    const Material    material(law);
    const char *const axes  = "xyz";
    const auto        ratio = [&](const unsigned int i, const unsigned int j) {
      // nu_ij, from nu_ji where that is given
      return (i + 1) % 3 == j ? law.poisson_ratios[i] :
                                       law.poisson_ratios[j] * law.young_moduli[i] /
                                  law.young_moduli[j];
    };
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
        Tensor<2, 3>       gradient;
        gradient[i][i] = 1. / law.young_moduli[i];
        gradient[j][j] = -ratio(i, j) / law.young_moduli[i];
        gradient[k][k] = -ratio(i, k) / law.young_moduli[i];
        SymmetricTensor<2, 3> expected;
        expected[i][i] = 1.;
        verdict(std::string("tension along ") + axes[i],
                (material.stress(gradient) - expected).norm(),
                1e-14);
        Tensor<2, 3> shear;
        shear[i][j] = 1. / law.shear_moduli[i];
        SymmetricTensor<2, 3> across;
        across[i][j] = 1.;
        verdict(std::string("shear ") + axes[i] + axes[j],
                (material.stress(shear) - across).norm(),
                1e-14);
      }
  }

  void
  check_isotropic_constants()
  {
    const double E = hooke.young_modulus, nu = hooke.poisson_ratio,
                 G = hooke.lame_mu();
    const Orthotropic  same{{{E, E, E}},
                            {{nu, nu, nu}},
                            {{G, G, G}},
                            {{20., 30., 40.}}};
    const Tensor<2, 3> gradient = random_gradient();
    const auto         expected = Material(hooke).stress(gradient);
    verdict("isotropic constants: Hooke's stress",
            (Material(same).stress(gradient) - expected).norm() /
              expected.norm(),
            1e-14);
    for (const LinearElastic &average :
         {same.averages().voigt, same.averages().reuss})
      verdict("isotropic constants: averages",
              std::fabs(average.young_modulus / E - 1.) +
                std::fabs(average.poisson_ratio / nu - 1.),
              1e-13);
    const auto averages = wood.averages();
    verdict("averages: Reuss below Voigt",
            averages.reuss.young_modulus / averages.voigt.young_modulus,
            0.5);
  }

  /// Strains and axes turned together turn the stress.
  void
  check_rotation()
  {
    const RigidMotion   motion(wood.axes, {{0., 0., 0.}});
    const Tensor<2, 3> &R       = motion.rotation;
    Orthotropic         own     = wood;
    own.axes                    = {{0., 0., 0.}};
    const Tensor<2, 3> gradient = random_gradient();
    const Tensor<2, 3> expected =
      R * Tensor<2, 3>(Material(own).stress(gradient)) * transpose(R);
    const Tensor<2, 3> got = Material(wood).stress(R * gradient * transpose(R));
    verdict("strain and axes turned together",
            (got - expected).norm() / expected.norm(),
            1e-14);
    verdict("energy is the product of stress and strain",
            std::fabs(
              Material(wood).twice_energy(gradient, 0.) /
                (Material(wood).stress(gradient) * symmetrize(gradient)) -
              1.),
            1e-13);
  }

  void
  check_defect(const Orthotropic &law, const std::string &fragment)
  {
    const auto        defect = law.defect();
    const std::string got = defect ? defect->constant + ": got " + defect->got +
                                       "; allowed: " + defect->allowed :
                                     "";
    const bool        good =
      fragment.empty() ? got.empty() : got.find(fragment) != std::string::npos;
    verdict(good, fragment.empty() ? "accepted" : "refused: " + fragment, got);
  }

  void
  check_defects()
  {
    check_defect(wood, "");
    Orthotropic law     = wood;
    law.young_moduli[1] = -1.;
    check_defect(law, "Young moduli: got -1; allowed: three positive numbers");
    law                 = wood;
    law.shear_moduli[2] = 0.;
    check_defect(law, "Shear moduli: got 0; allowed: three positive numbers");
    law                   = wood; // sqrt(10) and sqrt(2)
    law.poisson_ratios[0] = 3.16;
    law.poisson_ratios[1] = 0.;
    law.poisson_ratios[2] = 0.;
    check_defect(law, "");
    law.poisson_ratios[0] = 3.17;
    check_defect(law, "got nu_xy = 3.17; allowed: |nu_xy| < 3.16228");
    law                   = wood;
    law.poisson_ratios[1] = -1.42;
    check_defect(law, "got nu_yz = -1.42; allowed: |nu_yz| < 1.41421");
    // each alone allowed: the limit of equal ratios is 1/2
    law =
      Orthotropic{{{1., 1., 1.}}, {{0.499, 0.499, 0.499}}, {{1., 1., 1.}}, {}};
    check_defect(law, "");
    law.poisson_ratios = {{0.501, 0.501, 0.501}};
    check_defect(law,
                 "allowed: ratios that make it positive, so that the "
                 "stiffness is positive definite");
  }
} // namespace

int
main()
{
  check_tangent("Hooke", hooke.law());
  check_tangent("orthotropic", wood.law());
  check_lanes<double>("Hooke, double", hooke, 1e-14);
  check_lanes<float>("Hooke, single", hooke, 1e-6);
  check_lanes<double>("orthotropic, double", wood, 1e-14);
  check_lanes<float>("orthotropic, single", wood, 1e-6);
  check_constants();
  check_isotropic_constants();
  check_rotation();
  check_defects();
}
