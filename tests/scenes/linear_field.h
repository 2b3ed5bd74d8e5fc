// Linear displacements with the loads that a scene needs for them to be exact
// where two boxes do not meet.
#pragma once

#include <mortise/material/material.h>
#include <mortise/problem/input/parameters.h>

#include "scenes.h"

namespace mortise::testing
{
  /// The displacement u = G x and its stress in the material of the boxes.
  struct LinearField
  {
    double G[3][3];

    Settings
    displacement() const
    {
      std::string text;
      for (unsigned int c = 0; c < 3; ++c)
        text += (c ? "; " : "Exact solution/Displacement=") + number(G[c][0]) +
                "*x + " + number(G[c][1]) + "*y + " + number(G[c][2]) + "*z";
      return {text};
    }

    /// Loads on zmax of the lower and zmin of the upper body: the traction times @p lower, @p upper,
    /// which are 1 off the overlap and 0 on it.
    Settings
    loads(const std::string &lower, const std::string &upper) const
    {
      const auto stress =
        Material(LinearElastic{900., 0.25}).stress(dealii::Tensor<2, 3>(G));
      const auto load = [&](const double sign, const std::string &factor) {
        std::string text;
        for (unsigned int c = 0; c < 3; ++c)
          text +=
            (c ? "; " : "") + number(sign * stress[c][2]) + "*(" + factor + ")";
        return text;
      };
      return {"Body lower/Boundary zmax/Traction=" + load(1., lower),
              "Body upper/Boundary zmin/Traction=" + load(-1., upper)};
    }
  };

  /// 1 for x < @p cut and 0 beyond; on the face from @p begin to @p end, which holds the cut, its
  /// projection to polynomials of degree @p p (up to 3): c + sum_k (P_{k+1} - P_{k-1})(2 c - 1) / 2 P_k.
  inline std::string
  step(const double       cut,
       const double       begin,
       const double       end,
       const unsigned int p)
  {
    const double      s    = 2. * (cut - begin) / (end - begin) - 1.;
    const double      P[5] = {1.,
                              s,
                              (3. * s * s - 1.) / 2.,
                              (5. * s * s * s - 3. * s) / 2.,
                              (35. * s * s * s * s - 30. * s * s + 3.) / 8.};
    const std::string t =
      "(2*(x - " + number(begin) + ")/" + number(end - begin) + " - 1)";
    const std::string Q[4]   = {"",
                                t,
                                "(3*" + t + "^2 - 1)/2",
                                "(5*" + t + "^3 - 3*" + t + ")/2"};
    std::string       inside = number((s + 1.) / 2.);
    for (unsigned int k = 1; k <= p; ++k)
      inside += " + " + number((P[k + 1] - P[k - 1]) / 2.) + "*" + Q[k];
    return "if(x < " + number(begin) + ", 1, if(x < " + number(end) + ", " +
           inside + ", 0))";
  }
} // namespace mortise::testing
