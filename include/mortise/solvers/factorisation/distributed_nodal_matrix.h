// A matrix by rows of nodes and its products. It never sees more of other ranks
// than the nodes that its own couple with.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

#include <Epetra_Map.h>
#include <Epetra_Vector.h>
#include <mortise/solvers/factorisation/nodal_matrix.h>

#include <vector>

namespace mortise
{
  class DistributedNodalMatrix
  {
  public:
    using NodeVector = dealii::LinearAlgebra::distributed::Vector<double>;

    /// @p map: of vectors that have the entries of @p rows. Collective.
    DistributedNodalMatrix(NodalMatrix rows, const Epetra_Map &map);

    const NodalMatrix &
    rows() const
    {
      return node_rows;
    }

    const Epetra_Map &
    map() const
    {
      return vector_map;
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
    const NodeVector &
    at_nodes(const Epetra_Vector &x) const;

    /// Leaves what at_nodes() needs.
    void
    drop_rows();

    /// y = matrix x. Collective.
    void
    vmult(Epetra_Vector &y, const Epetra_Vector &x) const;

  private:
    void
    find_ghosts();
    /// Is it of this rank?
    bool
    is_owned(const int node) const
    {
      return node >= first && node < end;
    }

    NodalMatrix        node_rows;
    Epetra_Map         vector_map;
    std::vector<int>   rank_starts, ghost_nodes;
    int                first = 0, end = 0; ///< owned nodes
    mutable NodeVector nodal;
  };
} // namespace mortise
