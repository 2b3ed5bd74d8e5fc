// The matrix of the coarsest level, degree one, for algebraic multigrid. It
// never solves.
#pragma once

#include <mortise/operators/nodal_level.h>

namespace mortise
{
  struct VertexMatrix
  {
    /// K + J on degree one; a held row has nothing but its diagonal.
    SparseMatrix                                 matrix;
    std::vector<dealii::types::global_dof_index> rows;   ///< owned
    std::vector<dealii::Point<dim>>              points; ///< of each three rows
  };

  /// @p level: of degree one in all bodies. Collective.
  void
  assemble_vertex_matrix(const NodalLevel &level, VertexMatrix &result);
} // namespace mortise
