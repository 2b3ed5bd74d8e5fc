#include <mortise/base/error.h>
#include <mortise/material/linear_elastic.h>

#include <cmath>
#include <sstream>

namespace mortise
{
  using namespace dealii;

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
    check(poisson_ratio > -1. && poisson_ratio < 0.5,
          "Poisson ratio",
          poisson_ratio,
          "greater than -1 and less than 0.5");
  }
} // namespace mortise
