// Description of the scene of a checkpoint, by which other scenes are refused.
#pragma once

#include <mortise/mortar/coupling.h>
#include <mortise/operators/scene_system.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mortise
{
  /// The number of a cell, the same on any number of ranks.
  using CellNumber = dealii::CellId::binary_type;

  /// The same for all ways to spread a scene over ranks.
  struct SceneDescription
  {
    struct OfBody
    {
      std::string   name, shape;
      std::uint64_t cells;
      unsigned int  degree_min, degree_max;
      std::uint64_t dofs, pressures;
      /// Smallest and largest coordinates of vertices, then the mean of
      /// vertices and centres of cells about the smallest, with weights that
      /// depend on the numbers of cell and vertex: cells that were renumbered
      /// show, too.
      std::array<double, 9> geometry;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &name &shape &cells &degree_min &degree_max &dofs &pressures
          &geometry;
      }
    };

    struct OfInterface
    {
      std::string   name, slave; ///< body
      std::uint64_t faces;       ///< of the slave

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &name &slave &faces;
      }
    };

    std::vector<OfBody>      bodies;
    std::vector<OfInterface> interfaces;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &bodies &interfaces;
    }
  };

  /// Collective.
  SceneDescription
  describe_scene(const Bodies                &bodies,
                 const std::vector<Coupling> &couplings,
                 MPI_Comm                     comm);

  /// Throws std::out_of_range if no scene can be like this.
  void
  check(const SceneDescription &scene);

  /// How @p then, of the checkpoint, and @p now differ, in words; empty if they do not.
  std::vector<std::string>
  differences(const SceneDescription &then, const SceneDescription &now);
} // namespace mortise
