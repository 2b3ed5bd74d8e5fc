#include <mortise/base/numbers.h>
#include <mortise/base/rigid_motion.h>
#include <mortise/material/orthotropic.h>

#include <cmath>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Strains of the axes from stresses along them.
    Tensor<2, 3>
    compliance(const Orthotropic &material)
    {
      Tensor<2, 3> S;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int j = (i + 1) % 3;
          S[i][i]              = 1. / material.young_moduli[i];
          S[i][j]              = S[j][i] =
            -material.poisson_ratios[i] / material.young_moduli[i];
        }
      return S;
    }

    /// In the axes of the material.
    AnisotropicLaw<double>
    own_law(const Orthotropic &material)
    {
      AnisotropicLaw<double> law;
      const Tensor<2, 3>     stiffness = invert(compliance(material));
      for (unsigned int i = 0; i < 3; ++i)
        {
          for (unsigned int j = 0; j < 3; ++j)
            law.C[i][j] = stiffness[i][j];
          // shears come as yz, zx, xy
          law.C[3 + i][3 + i] = material.shear_moduli[(i + 1) % 3];
        }
      return law;
    }

    /// From the bulk modulus and the shear modulus.
    LinearElastic
    isotropic(const double K, const double G)
    {
      return {9. * K * G / (3. * K + G), (3. * K - 2. * G) / (6. * K + 2. * G)};
    }
  } // namespace

  std::optional<ConstantDefect>
  Orthotropic::defect() const
  {
    constexpr std::array<const char *, 3> pairs = {{"xy", "yz", "zx"}};
    for (const auto &[name, moduli] : {std::pair("Young moduli", young_moduli),
                                       std::pair("Shear moduli", shear_moduli)})
      for (const double modulus : moduli)
        if (!(modulus >= smallest_modulus && modulus <= largest_modulus))
          return ConstantDefect{name,
                                text_of(modulus),
                                "three positive numbers (force per area) " +
                                  allowed_moduli()};
    // nu_ij sqrt(E_j / E_i) are minus the cosines between three directions
    std::array<double, 3> cosine;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const std::string nu = std::string("nu_") + pairs[i];
        const double      bound =
          std::sqrt(young_moduli[i] / young_moduli[(i + 1) % 3]);
        cosine[i] = poisson_ratios[i] / bound;
        if (!(std::fabs(cosine[i]) < 1.))
          return ConstantDefect{"Poisson ratios",
                                nu + " = " + text_of(poisson_ratios[i]),
                                "|" + nu + "| < " + text_of(bound) +
                                  " = sqrt(E_" + pairs[i][0] + " / E_" +
                                  pairs[i][1] + ")"};
      }
    const double determinant = 1. - cosine[0] * cosine[0] -
                               cosine[1] * cosine[1] - cosine[2] * cosine[2] -
                               2. * cosine[0] * cosine[1] * cosine[2];
    if (!(determinant > 1e-12))
      return ConstantDefect{
        "Poisson ratios",
        text_of(poisson_ratios[0]) + ", " + text_of(poisson_ratios[1]) + ", " +
          text_of(poisson_ratios[2]) +
          ", with which 1 - nu_xy nu_yx - nu_yz nu_zy - nu_zx "
          "nu_xz - 2 nu_xy nu_yz nu_zx = " +
          text_of(determinant),
        "ratios that make it positive, so that the stiffness is "
        "positive definite"};
    return {};
  }

  template <typename Number>
  AnisotropicLaw<Number>
  Orthotropic::law() const
  {
    const auto             own = own_law(*this);
    const Tensor<2, 3>     R   = RigidMotion(axes, {{0., 0., 0.}}).rotation;
    AnisotropicLaw<Number> result;
    for (unsigned int column = 0; column < 6; ++column)
      {
        Tensor<2, 3>       strain;
        const unsigned int a = (column + 1) % 3, b = (column + 2) % 3;
        if (column < 3)
          strain[column][column] = 1.;
        else
          strain[a][b] = strain[b][a] = 0.5;
        const Tensor<2, 3> stress =
          R * Tensor<2, 3>(stress_at(own, transpose(R) * strain * R)) *
          transpose(R);
        for (unsigned int i = 0; i < 3; ++i)
          {
            result.C[i][column]     = stress[i][i];
            result.C[3 + i][column] = stress[(i + 1) % 3][(i + 2) % 3];
          }
      }
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j < i; ++j)
        result.C[i][j] = result.C[j][i];
    return result;
  }

  template AnisotropicLaw<double>
  Orthotropic::law<double>() const;
  template AnisotropicLaw<float>
  Orthotropic::law<float>() const;

  LinearElastic::Averages
  Orthotropic::averages() const
  {
    const auto         law     = own_law(*this);
    const Tensor<2, 3> S       = compliance(*this);
    double             C_along = 0., C_across = 0., C_shear = 0.;
    double             S_along = 0., S_across = 0., S_shear = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        C_along += law.C[i][i];
        C_across += law.C[i][(i + 1) % 3];
        C_shear += shear_moduli[i];
        S_along += S[i][i];
        S_across += S[i][(i + 1) % 3];
        S_shear += 1. / shear_moduli[i];
      }
    return {isotropic((C_along + 2. * C_across) / 9.,
                      (C_along - C_across + 3. * C_shear) / 15.),
            isotropic(1. / (S_along + 2. * S_across),
                      15. / (4. * (S_along - S_across) + 3. * S_shear))};
  }
} // namespace mortise
