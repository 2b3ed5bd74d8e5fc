// State of adaptive cycles in a checkpoint, and checks of it.
#pragma once

#include <mortise/adapt/cycle_errors.h>
#include <mortise/body/mesh/size_field.h>
#include <mortise/operators/scene_system.h>
#include <mortise/output/checkpoint_scene.h>
#include <mortise/problem/input/parameters.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mortise
{
  struct CellCheckpoint
  {
    std::uint64_t coarse = 0;
    std::string   children; ///< number of the child on each level, as bytes
    CellState     state;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &coarse &children &state;
    }
  };

  /// Coordinates of the vertices of a cell of SizeField, then their sizes.
  using SizesOfCell = std::array<double, 16>;

  /// See Adaptivity::checkpoint().
  struct CycleCheckpoint
  {
    std::string    quantity; ///< empty: the energy norm
    unsigned int   n_meshes = 0;
    EstimateMemory memory;
    std::vector<std::vector<CellCheckpoint>> cells; ///< by body
    std::vector<std::vector<SizesOfCell>>    sizes; ///< likewise

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &quantity &n_meshes &memory &cells &sizes;
    }
  };

  /// Throws std::out_of_range if @p kept is impossible with @p bodies.
  void
  check(const CycleCheckpoint &kept, const std::vector<BodyParameters> &bodies);

  /// Throws std::out_of_range for an impossible cell.
  CellNumber
  number_of(const CellCheckpoint &cell);

  /// Throws std::out_of_range for a degenerate tetrahedron or impossible sizes.
  SizeField::Cell
  size_cell(const SizesOfCell &numbers);

  /// Throws std::out_of_range if @p sizes require far more tetrahedra than the
  /// @p n_cells of their mesh.
  void
  check_number(const std::vector<SizeField::Cell> &sizes, std::size_t n_cells);
} // namespace mortise
