// Scenes of which a part of the multipliers is active, and sets of these that
// are drawn by their places.
#pragma once

#include <mortise/mortar/nodal_block.h>
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
      return {data, load, x, {}, {}};
    }

  private:
    static Parameters
    valid(Parameters parameters)
    {
      validate(parameters);
      return parameters;
    }

    const Parameters   parameters;
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

  /// Where the owned multipliers are: the mean of the nodes that they move.
  inline std::vector<dealii::Point<dim>>
  positions(const Discretisation &discretisation, const MPI_Comm comm)
  {
    const dealii::IndexSet &owned =
      discretisation.linear_system().owned_multiplier;
    dealii::IndexSet ghosts(owned);
    for (const Coupling &coupling : discretisation.interfaces().all())
      for (const auto &rows : coupling.multipliers->rows())
        ghosts.add_indices(rows.index.begin(), rows.index.end());
    std::vector<dealii::LinearAlgebra::distributed::Vector<double>> sums(dim +
                                                                         1);
    for (auto &sum : sums)
      sum.reinit(owned, ghosts, comm);
    for (const Coupling &coupling : discretisation.interfaces().all())
      {
        const BodySurface &slave = coupling.interface->slave();
        for (unsigned int s = 0; s < slave.faces.size(); ++s)
          {
            const auto &rows = coupling.multipliers->rows()[s];
            const auto  nodes =
              face_nodes(slave.traces[s].shape, slave.traces[s].degree);
            for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
              for (unsigned int e = rows.begin[r]; e < rows.begin[r + 1]; ++e)
                {
                  const dealii::Point<dim> x =
                    face_point(slave.faces[s], nodes[r % rows.n_nodes()]);
                  const double w = std::fabs(rows.weight[e]);
                  for (unsigned int c = 0; c < dim; ++c)
                    sums[c](rows.index[e]) += w * x[c];
                  sums[dim](rows.index[e]) += w;
                }
          }
      }
    for (auto &sum : sums)
      sum.compress(dealii::VectorOperation::add);
    std::vector<dealii::Point<dim>> result(owned.n_elements());
    for (unsigned int i = 0; i < result.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        result[i][c] = sums[c].local_element(i) / sums[dim].local_element(i);
    return result;
  }

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
