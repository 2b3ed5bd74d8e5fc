// Runs scenes inside test programs and prints verdicts.
#pragma once

#include <mortise/output/summary.h>
#include <mortise/problem/input/parameters.h>
#include <verdict.h>

#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace mortise::testing
{
  /// Run the scene of a parameter text, silently; nothing is written. @p warnings, if given, holds
  /// those of the run.
  Summary
  run_scene(const std::string        &text,
            const Settings           &settings,
            const MPI_Comm            comm     = MPI_COMM_WORLD,
            std::vector<std::string> *warnings = nullptr);

  /// Verdict: is the scene refused with @p expected in the message?
  inline void
  check_message(const std::string &what,
                const std::string &text,
                const Settings    &settings,
                const std::string &expected)
  {
    ::check_message(what, [&] { run_scene(text, settings); }, {expected});
  }

  /// Verdicts on the errors of a scene whose exact solution the elements hold.
  inline void
  exact_verdicts(const std::string &what, const ErrorSummary &errors)
  {
    verdict(what + ": displacement 1e-10", *errors.displacement_l2, 1e-10);
    verdict(what + ": stress 1e-10", *errors.energy, 1e-10);
    verdict(what + ": traction 1e-10", *errors.multiplier_l2, 1e-10);
  }

  inline Settings
  operator+(Settings a, const Settings &b)
  {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  /// Subdivisions of the bodies of two_boxes(), and their degree.
  inline Settings
  meshes(const std::string &lower,
         const std::string &upper,
         const unsigned int degree)
  {
    return {"Body lower/Mesh/Subdivisions=" + lower,
            "Body upper/Mesh/Subdivisions=" + upper,
            "Body lower/Degree=" + std::to_string(degree),
            "Body upper/Degree=" + std::to_string(degree)};
  }

  /// @p setting of both of them.
  inline Settings
  both(const std::string &setting)
  {
    return {"Body lower/" + setting, "Body upper/" + setting};
  }

  /// log_2 of the ratio of two errors, over log_2 of the ratio of mesh sizes.
  inline double
  rate(const double coarse, const double fine, const double refinement = 2.)
  {
    return std::log(coarse / fine) / std::log(refinement);
  }

  /// By how much a rate may stay below its limit: p in energy, p + 1 in L2, p
  /// for the multiplier.
  struct RateSlack
  {
    double displacement, multiplier;
  };

  /// Verdicts on the errors of a mesh of degree @p p and of the same mesh with
  /// all cells halved.
  inline void
  rate_verdicts(const std::string  &what,
                const unsigned int  p,
                const ErrorSummary &coarse,
                const ErrorSummary &fine,
                const RateSlack     slack)
  {
    const auto check = [&](const std::string           &quantity,
                           const unsigned int           limit,
                           const std::optional<double> &before,
                           const std::optional<double> &after,
                           const double                 allowed) {
      std::ostringstream text;
      text << what << ": " << quantity << " rate at least " << limit << " - "
           << allowed;
      verdict(text.str(), limit - rate(*before, *after), allowed);
    };
    check("energy", p, coarse.energy, fine.energy, slack.displacement);
    check("L2",
          p + 1,
          coarse.displacement_l2,
          fine.displacement_l2,
          slack.displacement);
    check("multiplier",
          p,
          coarse.multiplier_l2,
          fine.multiplier_l2,
          slack.multiplier);
  }
} // namespace mortise::testing
