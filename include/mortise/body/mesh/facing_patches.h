// Which faces of bodies lie opposite each other, before anything is coupled.
#pragma once

#include <mortise/body/mesh/mesh_file.h>

#include <vector>

namespace mortise
{
  /// A patch of one body and one of another that it faces.
  struct FacingPatches
  {
    std::size_t slave_body = 0, slave = 0; ///< the patch of less area
    std::size_t master_body = 0, master = 0;
    double      area = 0.; ///< of the slave's faces whose middle is opposite
    double      least_distance = 0., mean_distance = 0.,
           largest_distance =
             0.; ///< of vertices from the master's shape, or of
                 ///< middles along the normal if it has none
  };

  /// Pairs of patches of different @p bodies that face each other along the
  /// slave's normal, up to 45 degrees, at most @p reach apart, over a hundredth of
  /// the slave's area at least.
  std::vector<FacingPatches>
  facing_patches(const std::vector<MeshSurface> &bodies, double reach);
} // namespace mortise
