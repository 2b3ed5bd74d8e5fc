// What a checkpoint says of its scene, so that values never go to a mesh that
// is not theirs. It never holds values.
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
    };

    struct OfInterface
    {
      std::string   name, slave; ///< body
      std::uint64_t faces;       ///< of the slave
    };

    std::vector<OfBody>      bodies;
    std::vector<OfInterface> interfaces;
  };

  /// Collective.
  SceneDescription
  describe_scene(const Bodies                &bodies,
                 const std::vector<Coupling> &couplings,
                 MPI_Comm                     comm);

  std::string
  pack(const SceneDescription &scene);

  /// Throws std::out_of_range if @p bytes are not those of pack().
  SceneDescription
  unpack_scene(const std::string &bytes);

  /// How @p then, of the checkpoint, and @p now differ, in words; empty if they do not.
  std::vector<std::string>
  differences(const SceneDescription &then, const SceneDescription &now);
} // namespace mortise
