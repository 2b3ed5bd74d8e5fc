// How much a solution changes when degrees rise, cell by cell.
#pragma once

#include <mortise/operators/scene_solution.h>

#include <vector>

namespace mortise
{
  /// Numbers by body and active cell of its mesh, zero where a cell is not
  /// owned or not asked for.
  using CellNumbers = std::vector<std::vector<double>>;

  /// Squares of the energy norm (SolutionErrors::energy) of @p solutions on all owned cells. Collective.
  CellNumbers
  energy_by_cell(const Bodies                    &bodies,
                 const std::vector<BodySolution> &solutions);

  /// A solution on the cells whose degree will be one more.
  class SampledSolution
  {
  public:
    /// @p rises: by body and active cell of its mesh.
    SampledSolution(const Bodies                         &bodies,
                    const std::vector<BodySolution>      &solutions,
                    const std::vector<std::vector<bool>> &rises);

    /// Squares of the energy norm of the difference to @p solutions in the
    /// spaces that bodies have now, on the same meshes, on these cells.
    CellNumbers
    change(const Bodies                    &bodies,
           const std::vector<BodySolution> &solutions) const;

  private:
    struct OnCell
    {
      std::vector<dealii::Tensor<2, dim>> gradients;
      std::vector<double>                 pressures;
    };

    /// By body and active cell; without points where it is not asked for.
    std::vector<std::vector<OnCell>> samples;
  };
} // namespace mortise
