// Nodes at the vertices of the coarse mesh of a body that a rank needs to
// coarsen its lattice.
#pragma once

#include <mortise/body/mesh/lattice_coarsening.h>
#include <mortise/body/spaces/nodal_space.h>

#include <vector>

namespace mortise
{
  class LatticeNodes
  {
  public:
    using Index = NodalSpace::Index;

    /// @p vertices: of degree one in all bodies. Collective.
    LatticeNodes(const NodalSpace        &vertices,
                 const Body              &body,
                 const LatticeCoarsening &lattice,
                 MPI_Comm                 comm);

    /// At a vertex of the coarse mesh; numbers::invalid_dof_index where the
    /// rank has no cell at it nor a vertex that follows from it.
    Index
    operator[](const unsigned int vertex) const
    {
      return nodes[vertex];
    }

  private:
    std::vector<Index> nodes;
  };
} // namespace mortise
