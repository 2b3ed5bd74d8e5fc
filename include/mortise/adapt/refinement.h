// Choice of the cells that are cut or whose degree rises, so that the error
// becomes the allowed one with few unknowns.
#pragma once

#include <mortise/adapt/cell_states.h>

#include <algorithm>
#include <vector>

namespace mortise
{
  enum class Refinement
  {
    keep,
    rise,
    split ///< of tetrahedra: a new mesh with smaller cells
  };

  /// Allowed square of the error of a cell over the mean of all cells.
  constexpr double fraction_of_cell = 0.25;

  /// The square of the error that a cell has for certain: what it has changed
  /// by is known, what follows after slow changes is not.
  inline double
  certain_error(const CellHistory &history)
  {
    return std::min(history.change, history.error);
  }

  /// By body and active cell, of owned ones.
  using Refinements = std::vector<std::vector<Refinement>>;

  struct RefinementOptions
  {
    bool              may_split      = true;  ///< hexahedra
    bool              only_splits    = false; ///< hexahedra that may be split
    unsigned int      largest_degree = max_degree;
    std::vector<bool> may_remesh; ///< by body, tetrahedra
  };

  /// The best on every cell that has not been refined since its mesh was made;
  /// others are kept.
  Refinements
  refine_new(const Bodies            &bodies,
             const CellStates        &states,
             const RefinementOptions &options);

  /// On as few cells as leave the square @p allowed of the energy norm of their largest errors, as histories say, or on those that
  /// have most of it, so that all have about the same. Tetrahedra are split
  /// only where they have most of it. Collective.
  Refinements
  choose_refinements(const Bodies            &bodies,
                     const CellStates        &states,
                     const RefinementOptions &options,
                     double                   allowed);

  /// With the splits of other cells of @p bodies, hexahedra, that these ask for, so that cells with a common
  /// vertex differ by one halving. Collective.
  Refinements
  with_closure(const Bodies &bodies, Refinements refinements);

  /// Unknowns after @p refinements, with_closure(), by those now, about; one if there are none. Collective.
  double
  growth(const Bodies      &bodies,
         const CellStates  &states,
         const Refinements &refinements);

  /// Write @p refinements into the histories of @p states; which cells change_cells() is to cut.
  std::vector<std::vector<bool>>
  prepare_refinement(const Bodies      &bodies,
                     const Refinements &refinements,
                     CellStates        &states);
} // namespace mortise
