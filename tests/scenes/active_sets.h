// Scenes of which a part of the multipliers is active, and sets of these that
// are drawn by their places.
#pragma once

#include <mortise/problem/results/solved_step.h>
#include <mortise/problem/scene/discretisation.h>
#include <mortise/problem/scene/scene_data.h>
#include <mortise/solvers/solve.h>

#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "scenes/scenes.h"

namespace mortise::testing
{
  using PointSet = std::function<bool(const dealii::Point<dim> &)>;

  /// A scene as far as its equations.
  class EquationsOfScene
  {
  public:
    EquationsOfScene(const std::string &text,
                     const Settings    &settings,
                     const MPI_Comm     comm)
      : parameters(valid(parse_parameters(text, "test", settings)))
      , log(silence, comm)
      , run{parameters, log, timers, comm}
      , data(parameters, 1., checks)
      , bodies(create_meshes(run))
      , discretisation(run, data, bodies)
      , load(discretisation.load(data))
    {}

    const Parameters &
    given() const
    {
      return parameters;
    }

    /// Pairs that are found again are those of displaced bodies, whatever the
    /// law.
    void
    follow_bodies()
    {
      for (InterfaceParameters &interface : parameters.interfaces)
        interface.follows_bodies = true;
    }

    const RunContext &
    context() const
    {
      return run;
    }

    const SceneData &
    fields() const
    {
      return data;
    }

    /// @p x must live on.
    SolvedStep
    solved(const SystemVector &x) const
    {
      return {data, load, x, history, {}, {}};
    }

  private:
    static Parameters
    valid(Parameters parameters)
    {
      validate(parameters);
      return parameters;
    }

    Parameters         parameters;
    const PointHistory history; // there is none
    std::ostringstream silence;
    RunLog             log;
    Timers             timers;
    FieldChecks        checks;
    const RunContext   run;
    const SceneData    data;
    Bodies             bodies;

  public:
    Discretisation  discretisation;
    const SceneLoad load;
  };

  /// A number from 0 to 1 that only the place decides.
  inline double
  draw(const dealii::Point<dim> &x)
  {
    double sum = 0.;
    for (unsigned int c = 0; c < dim; ++c)
      sum += std::round(1e5 * x[c]) * (12.9898 + 65.233 * c);
    const double value = std::fabs(std::sin(sum)) * 43758.5453;
    return value - std::floor(value);
  }

  /// @p size: of the interface, about @p centre.
  inline std::vector<std::pair<std::string, PointSet>>
  point_sets(const bool sphere)
  {
    const dealii::Point<dim> centre =
      sphere ? dealii::Point<dim>(1.5 / std::sqrt(3.) *
                                  dealii::Tensor<1, dim>({1., 1., 1.})) :
               dealii::Point<dim>(0.5, 0.5, 0.5);
    const double size = sphere ? 1.5 : 1.;
    const auto   disc = [=](const double radius) {
      return [=](const dealii::Point<dim> &x) {
        return x.distance(centre) < radius * size;
      };
    };
    const auto board = [=](const double width) {
      return [=](const dealii::Point<dim> &x) {
        return (static_cast<int>(std::floor(x[0] / width + 0.37)) +
                static_cast<int>(std::floor(x[1] / width + 0.37))) %
                 2 ==
               0;
      };
    };
    return {{"all", [](const auto &) { return true; }},
            {"none", [](const auto &) { return false; }},
            {"random half", [](const auto &x) { return draw(x) < 0.5; }},
            {"random tenth", [](const auto &x) { return draw(x) < 0.1; }},
            {"board, fine", board(0.12 * size)},
            {"board, coarse", board(0.3 * size)},
            {"disc 0.15", disc(0.15)},
            {"disc 0.3", disc(0.3)},
            {"disc 0.32", disc(0.32)},
            {"disc 0.5", disc(0.5)}};
  }
} // namespace mortise::testing
