// Random values of a scene, the same on every rank, to compare with what a
// checkpoint gives back.
#pragma once

#include <cstdint>
#include <cstring>
#include <random>

#include "checkpoint_scene.h"

namespace mortise::testing
{
  /// 64 bits drawn at random, NaN and infinity among them.
  inline double
  random_bits(std::mt19937_64 &random)
  {
    const std::uint64_t bits = random();
    double              value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }

  inline bool
  same_bits(const double a, const double b)
  {
    return std::memcmp(&a, &b, sizeof(double)) == 0;
  }

  inline std::vector<types::global_dof_index>
  dofs_of(const Body::CellIterator &cell)
  {
    std::vector<types::global_dof_index> dofs(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    return dofs;
  }

  using Face = std::tuple<unsigned int, CellId, unsigned int>;

  /// The same random values of a scene on every rank.
  class Truth
  {
  public:
    Truth(const Given &given)
      : serial(given, MPI_COMM_SELF)
    {
      std::mt19937_64 random(1);
      const auto      fill = [&](BodyVector &values, const auto &handler) {
        values.reinit(handler.n_dofs());
        for (double &value : values)
          value = random_bits(random);
      };
      state.solutions.resize(serial.bodies.size());
      cells.resize(serial.bodies.size());
      for (const auto &body : serial.bodies)
        {
          BodySolution &own = state.solutions[body->index];
          fill(own.displacement, body->dof_handler);
          if (body->pressure)
            fill(own.pressure, body->pressure->dof_handler);
          for (const auto &cell : body->dof_handler.active_cell_iterators())
            cells[body->index].emplace(cell->id(), cell);
        }
      for (unsigned int i = 0; i < serial.couplings.size(); ++i)
        {
          const BodySurface &slave = serial.couplings[i].interface->slave();
          state.multipliers.emplace_back();
          for (unsigned int s = 0; s < slave.faces.size(); ++s)
            {
              std::vector<double> values(dim * slave.traces[s].n_functions());
              for (double &value : values)
                value = random_bits(random);
              faces[{i, slave.cells[s]->id(), slave.face_numbers[s]}] = values;
              state.multipliers.back().push_back(values);
            }
        }
    }

    /// Call @p take(dof, value) for each dof of each cell that @p scene knows, of one field of @p body.
    template <typename Take>
    void
    for_each_dof(const Body &body, const bool pressure, const Take &take) const
    {
      const Body         &own   = *serial.bodies[body.index];
      const BodySolution &truth = state.solutions[body.index];
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          {
            const auto &of_truth = cells[body.index].at(cell->id());
            const auto  dofs =
              dofs_of(pressure ? body.pressure->cell(cell) : cell);
            const auto own_dofs =
              dofs_of(pressure ? own.pressure->cell(of_truth) : of_truth);
            AssertThrow(dofs.size() == own_dofs.size(), ExcInternalError());
            for (unsigned int i = 0; i < dofs.size(); ++i)
              take(dofs[i],
                   (pressure ? truth.pressure :
                               truth.displacement)(own_dofs[i]));
          }
    }

    /// The same values spread as @p scene is.
    SceneValues
    spread(const Scene &scene) const
    {
      SceneValues result;
      result.solutions.resize(scene.bodies.size());
      for (const auto &body : scene.bodies)
        for (const bool pressure : {false, true})
          if (!pressure || body->pressure)
            {
              BodySolution &own    = result.solutions[body->index];
              BodyVector   &values = pressure ? own.pressure : own.displacement;
              const auto   &handler =
                pressure ? body->pressure->dof_handler : body->dof_handler;
              values.reinit(handler.locally_owned_dofs(),
                            pressure ? body->pressure->relevant_dofs :
                                       body->relevant_dofs,
                            scene.comm);
              for_each_dof(*body,
                           pressure,
                           [&](const auto dof, const double value) {
                             if (values.in_local_range(dof))
                               values(dof) = value;
                           });
              values.update_ghost_values();
            }
      for (unsigned int i = 0; i < scene.couplings.size(); ++i)
        {
          const BodySurface &slave = scene.couplings[i].interface->slave();
          result.multipliers.emplace_back();
          for (unsigned int s = 0; s < slave.faces.size(); ++s)
            result.multipliers.back().push_back(
              faces.at({i, slave.cells[s]->id(), slave.face_numbers[s]}));
        }
      return result;
    }

    /// Values of this rank, ghosts among them, that are not as they should be.
    unsigned int
    n_wrong(const Scene &scene, const SceneValues &checkpoint) const
    {
      unsigned int sum = 0;
      for (const auto &body : scene.bodies)
        for (const bool pressure : {false, true})
          if (!pressure || body->pressure)
            {
              const BodySolution &own = checkpoint.solutions[body->index];
              const BodyVector   &values =
                pressure ? own.pressure : own.displacement;
              for_each_dof(*body,
                           pressure,
                           [&](const auto dof, const double value) {
                             sum += !same_bits(values(dof), value);
                           });
            }
      for (unsigned int i = 0; i < scene.couplings.size(); ++i)
        {
          const BodySurface &slave = scene.couplings[i].interface->slave();
          sum += checkpoint.multipliers[i].size() != slave.faces.size();
          for (unsigned int s = 0; s < slave.faces.size(); ++s)
            {
              const auto &got = checkpoint.multipliers[i][s];
              const auto &expected =
                faces.at({i, slave.cells[s]->id(), slave.face_numbers[s]});
              sum += !std::equal(got.begin(),
                                 got.end(),
                                 expected.begin(),
                                 expected.end(),
                                 same_bits);
            }
        }
      return sum;
    }

  private:
    Scene                                             serial;
    SceneValues                                       state;
    std::vector<std::map<CellId, Body::CellIterator>> cells; ///< by body
    std::map<Face, std::vector<double>>               faces;
  };
} // namespace mortise::testing
