// The matrix of the coarsest level, degree one, for a factorisation or
// multigrid on coarser meshes.
#pragma once

#include <mortise/body/spaces/vertex_coarsening.h>
#include <mortise/operators/levels/block_csr_matrix.h>
#include <mortise/operators/levels/multigrid_level.h>

#include <vector>

namespace mortise
{
  struct VertexMatrix
  {
    BlockCsrMatrix                  blocks; ///< K + J on degree one
    std::vector<dealii::Point<dim>> points; ///< of owned nodes
    std::vector<unsigned int>       bodies; ///< of owned nodes

    /// Points and bodies of the nodes @p kept alone.
    void
    keep(const std::vector<unsigned int> &kept)
    {
      for (unsigned int i = 0; i < kept.size(); ++i) // in ascending order
        {
          points[i] = points[kept[i]];
          bodies[i] = bodies[kept[i]];
        }
      points.resize(kept.size());
      bodies.resize(kept.size());
    }
  };

  /// K + J on @p level, of degree one in all bodies, or with @p coarsening
  /// directly P^T (K + J) P on the coarser mesh. Collective.
  VertexMatrix
  assemble_vertex_matrix(const MultigridLevel   &level,
                         const VertexCoarsening *coarsening = nullptr);
} // namespace mortise
