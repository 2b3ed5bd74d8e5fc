// Assembly of the matrix on the functions of a ThicknessCoarsening.
#pragma once

#include <mortise/body/spaces/thickness_coarsening.h>
#include <mortise/operators/levels/constraint_penalty.h>
#include <mortise/operators/levels/vertex_matrix.h>

#include <vector>

namespace mortise
{
  /// P^T (K + J) P: of flat bodies with the matrices of cells of all degrees, @p elasticity, of
  /// others with those of degree one; J are @p jumps. @p level: the finest. Collective.
  VertexMatrix
  assemble_thickness_matrix(const MultigridLevel                 &level,
                            const MatrixFreeElasticity<double>   &elasticity,
                            const ThicknessCoarsening            &coarsening,
                            const std::vector<ConstraintPenalty> &jumps);
} // namespace mortise
