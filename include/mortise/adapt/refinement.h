// Which cells are cut and on which the degree rises, so that the error becomes
// what is allowed with few unknowns. It never touches a mesh.
#pragma once

#include <mortise/adapt/cell_states.h>

#include <vector>

namespace mortise
{
  enum class Refinement
  {
    keep,
    rise,
    split
  };

  /// By body and active cell, of owned ones.
  using Refinements = std::vector<std::vector<Refinement>>;

  struct RefinementOptions
  {
    bool         may_split      = true;  ///< hexahedra
    bool         only_splits    = false; ///< where cells may be cut
    unsigned int largest_degree = max_degree;
  };

  /// The best on every cell.
  Refinements
  refine_all(const Bodies            &bodies,
             const CellStates        &states,
             const RefinementOptions &options);

  /// On as few cells as leave the square @p allowed of the energy norm of the error, as histories say, or on those that
  /// have most of it, so that all have about the same. Collective.
  Refinements
  choose_refinements(const Bodies            &bodies,
                     const CellStates        &states,
                     const RefinementOptions &options,
                     double                   allowed);

  /// Unknowns after @p refinements by those now, about; one if there are none. Collective.
  double
  growth(const Bodies      &bodies,
         const CellStates  &states,
         const Refinements &refinements);

  /// Write @p refinements into the histories of @p states; which cells split_cells() is to cut.
  std::vector<std::vector<bool>>
  prepare_refinement(const Bodies      &bodies,
                     const Refinements &refinements,
                     CellStates        &states);
} // namespace mortise
