// Plan of the next cycle: cells that are cut, degrees that rise, and new meshes
// of tetrahedra.
#pragma once

#include <mortise/adapt/remeshing.h>

#include <optional>
#include <vector>

namespace mortise
{
  /// Within which meshes and degrees change.
  struct PlanOptions
  {
    RefinementOptions refinement; ///< of tetrahedra apart
    double            most_unknowns = 0.;
    /// By body, where another mesh of its tetrahedra can be made.
    std::vector<std::optional<RemeshingOptions>> remeshing;
  };

  struct MeshPlan
  {
    /// Why there is no next cycle.
    enum class Limit
    {
      none,
      largest_degree,
      most_unknowns
    };

    /// By body and active cell, see change_cells(); empty: none.
    std::vector<std::vector<bool>> splits, merges;
    std::vector<Remeshing>         meshes; ///< by body; empty: none is new
    Limit                          limit    = Limit::none;
    double                         unknowns = 0.; ///< of the next cycle, about
  };

  /// So that the largest errors of cells become the square @p allowed together, or without it the best of every
  /// cell: first changes are those of all cells. Degrees are written into the histories of @p states. @p n_meshes: how often there were
  /// new ones. Collective.
  MeshPlan
  plan_meshes(const Bodies               &bodies,
              const PlanOptions          &options,
              const std::optional<double> allowed,
              unsigned int                n_meshes,
              CellStates                 &states);
} // namespace mortise
