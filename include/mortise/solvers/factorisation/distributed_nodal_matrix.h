// A matrix by rows of nodes and its products. It never sees more of other ranks
// than the nodes that its own couple with.
#pragma once

#include <mortise/base/types.h>
#include <mortise/solvers/factorisation/nodal_matrix.h>

#include <vector>

namespace mortise
{
  class DistributedNodalMatrix
  {
  public:
    /// Collective.
    DistributedNodalMatrix(NodalMatrix rows, MPI_Comm comm);

    const NodalMatrix &
    rows() const
    {
      return node_rows;
    }

    MPI_Comm
    communicator() const
    {
      return nodal.get_mpi_communicator();
    }

    /// First node by rank, and what is behind the last.
    const std::vector<int> &
    starts() const
    {
      return rank_starts;
    }

    /// Nodes of other ranks in owned rows, ascending.
    const std::vector<int> &
    ghosts() const
    {
      return ghost_nodes;
    }

    /// The index of a node among the owned ones, then the ghosts; -1: neither.
    int
    local(int node) const;

    /// By owned node and ghost, and component; 0 where one is lacking. Good
    /// until the next call of a member. Collective.
    const Vector &
    at_nodes(const Vector &x) const;

    /// Leaves what at_nodes() needs.
    void
    drop_rows();

    /// y = matrix x, both with the entries of rows(). Collective.
    void
    vmult(Vector &y, const Vector &x) const;

  private:
    void
    find_ghosts();
    /// Is it of this rank?
    bool
    is_owned(const int node) const
    {
      return node >= first && node < end;
    }

    NodalMatrix      node_rows;
    std::vector<int> rank_starts, ghost_nodes;
    int              first = 0, end = 0; ///< owned nodes
    mutable Vector   nodal;
  };
} // namespace mortise
