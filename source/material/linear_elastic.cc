#include <mortise/base/error.h>
#include <mortise/material/linear_elastic.h>

#include <cmath>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// lambda_u / mu of an incompressible body.
    constexpr double kept = 0.5;
  } // namespace

  double
  LinearElastic::displacement_lambda() const
  {
    if (!mixed)
      return lame_lambda();
    // lambda = mu s / (1 - s), which need not exist
    const double s = 2. * poisson_ratio;
    return kept * lame_mu() * s / (kept * (1. - s) + s);
  }

  double
  LinearElastic::compressibility() const
  {
    const double s = 2. * poisson_ratio;
    return (1. - s) * (s + kept * (1. - s)) / (s * s * lame_mu());
  }

  Tensor<1, 3>
  LinearElastic::body_force(
    const std::array<SymmetricTensor<2, 3>, 3> &hessian) const
  {
    Tensor<1, 3> force;
    for (unsigned int i = 0; i < 3; ++i)
      {
        double gradient_of_divergence = 0.;
        for (unsigned int j = 0; j < 3; ++j)
          gradient_of_divergence += hessian[j][i][j];
        force[i] = -(lame_lambda() + lame_mu()) * gradient_of_divergence -
                   lame_mu() * trace(hessian[i]);
      }
    return force;
  }

  void
  LinearElastic::validate(const std::string &where) const
  {
    const auto check = [&](const bool   fine,
                           const char  *name,
                           const double got,
                           const char  *allowed) {
      if (fine)
        return;
      std::ostringstream message;
      message << where << (where.empty() ? "" : ": ") << name << " = " << got
              << "; allowed: " << allowed;
      throw InputError(message.str());
    };
    check(young_modulus > 0. && std::isfinite(young_modulus),
          "Young modulus",
          young_modulus,
          "a positive number");
    if (mixed)
      check(poisson_ratio > 0. && poisson_ratio <= 0.5,
            "Poisson ratio",
            poisson_ratio,
            "greater than 0 and not above 0.5");
    else
      check(poisson_ratio > -1. && poisson_ratio < 0.5,
            "Poisson ratio",
            poisson_ratio,
            "greater than -1 and less than 0.5");
  }
} // namespace mortise
