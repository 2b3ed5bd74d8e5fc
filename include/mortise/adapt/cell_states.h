// Data of the cells of a scene that pass from one mesh to the next: degree,
// history of changes, and the solution as a polynomial, which nested spaces
// keep to the last digit.
#pragma once

#include <mortise/adapt/error_by_residual.h>
#include <mortise/operators/cells/cell_fields.h>

#include <vector>

namespace mortise
{
  struct CellHistory
  {
    unsigned int degree = 0;
    /// Squares of the energy norm, or for the error of a quantity products of
    /// that of the solution and that of its dual problem: by how much its last
    /// refinement changed the solution, first that of the solution itself; the
    /// error that is left, as it is estimated, and by which factor another such
    /// refinement makes it smaller.
    double change = 0., error = 0., ratio = 1.;
    /// The square of the error by that of the residual, as it was seen when the
    /// cell was refined, and before.
    double by_residual = square_by_residual_at_first;
    /// Violation of the laws of interfaces on its slave faces.
    double violation = 0.;
    /// Part of a face is in contact, part is open, or part of the cell has
    /// yielded: the solution is singular, however fast coefficients decay.
    bool at_free_boundary = false;
    /// Contribution of the last refinement to the quantity over the change:
    /// between -1 and 1 except in mixed form. One without a quantity.
    double share = 1.;
    /// By which residuals call for a larger error of a quantity than changes;
    /// one without a quantity.
    double raised = 1.;
    /// The change of the last rise of the degree by that of the rise before it,
    /// of cells that have not been split since; before the first rise one.
    double fall = 1.;
    /// By which the first change is taken to be multiplied, at least, by the
    /// next.
    double least_ratio = 0.;
    /// Rises of the degree that stand behind one another; of a cell that has
    /// been split none.
    unsigned int n_rises    = 0;
    bool         is_refined = false; ///< by the last refinement
    bool         is_split   = false; ///< by the last refinement, with siblings
    bool         is_new =
      true; ///< has not changed yet: change and error are the solution itself

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &degree &change &error &ratio &by_residual &violation
        &at_free_boundary &share &raised &fall &least_ratio &n_rises &is_refined
          &is_split &is_new;
    }
  };

  struct CellState
  {
    CellHistory      history;
    CellCoefficients coefficients, dual; ///< the latter with a quantity

    /// Degree of the cell at that time.
    unsigned int degree = 0;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &history &coefficients &dual &degree;
    }
  };

  /// By body and active cell of its mesh; empty states where a cell is not
  /// owned.
  using CellStates = std::vector<std::vector<CellState>>;

  /// Coefficients that a state has.
  using OfState = CellCoefficients CellState::*;

  /// Take the coefficients of @p solutions into @p states, which become as many as there
  /// are cells.
  void
  set_coefficients(const Bodies                    &bodies,
                   const std::vector<BodySolution> &solutions,
                   CellStates                      &states,
                   OfState coefficients = &CellState::coefficients);

  /// The fields with the coefficients of @p states in the spaces that @p bodies have now, of the same or
  /// higher degrees. Collective.
  std::vector<BodySolution>
  embedded(const Bodies     &bodies,
           const CellStates &states,
           OfState           coefficients = &CellState::coefficients);

  /// By body and active cell, zero where a cell is not owned.
  using NumbersByCell = std::vector<std::vector<double>>;

  /// Squares of the energy norm (SolutionErrors::energy) of @p solutions, see
  /// Material::twice_energy().
  NumbersByCell
  energy_by_cell(const Bodies                    &bodies,
                 const std::vector<BodySolution> &solutions);

  /// Of @p changes of @p solutions, see Material::twice_energy_of_change().
  NumbersByCell
  energy_of_changes(const Bodies                    &bodies,
                    const std::vector<BodySolution> &solutions,
                    const std::vector<BodySolution> &changes);

  /// The same for the modes that the last rise of a cell's degree added to
  /// @p states; zero for other cells.
  NumbersByCell
  energy_of_new_modes(const Bodies &bodies, const CellStates &states);

  /// Products of @p a and @p b with the operator of the scene by cell, that at
  /// @p solutions: with linear laws and without pressures those of the energy
  /// norm.
  NumbersByCell
  products_by_cell(const Bodies                    &bodies,
                   const std::vector<BodySolution> &solutions,
                   const std::vector<BodySolution> &a,
                   const std::vector<BodySolution> &b);

  /// Call @p visit(cell, what @p states has of it) for the owned
  /// cells of all @p bodies, with the body first.
  template <typename States, typename Visit>
  void
  for_each_cell(const Bodies &bodies, States &states, const Visit &visit)
  {
    for (const auto &body : bodies)
      for (const auto &cell : body->dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          visit(*body, cell, states[body->index][cell->active_cell_index()]);
  }
} // namespace mortise
