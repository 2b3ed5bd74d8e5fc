// Functions of degree one on refined meshes by those on the meshes before their
// finest cells were made: what multigrid on vertices goes down by. It knows
// nothing of matrices.
#pragma once

#include <deal.II/base/index_set.h>

#include <mortise/body/spaces/nodal_space.h>

#include <utility>
#include <vector>

namespace mortise
{
  /// From the vertices of one mesh to those of the next coarser one; in both,
  /// ranks have contiguous ranges of nodes.
  struct VertexCoarsening
  {
    using Index = NodalSpace::Index;

    /// Nodes that a value follows from, with their weights.
    using Entries = std::vector<std::pair<Index, double>>;

    /// Coarse nodes of this rank: those of its fine ones that stay and do not
    /// hang.
    dealii::IndexSet owned;
    std::vector<unsigned int>
      kept; ///< by owned coarse node: the owned fine one

    /// The value at owned fine node i is sum_e weights[e] u(nodes[e]), e =
    /// begin[i] .. begin[i + 1] - 1, nodes those of the coarse mesh; nothing
    /// where it hangs.
    std::vector<unsigned int> begin;
    std::vector<Index>        nodes;
    std::vector<double>       weights;
  };

  /// The range of this rank where each has @p n_owned, behind those of the ranks
  /// before. Collective.
  dealii::IndexSet
  next_range(dealii::types::global_dof_index n_owned, MPI_Comm comm);

  /// Of the owned nodes @p fine_nodes of @p space (positions in its range) those stay that have no entries in
  /// @p rows, by owned node, and do not hang; they are what @p fine_nodes becomes, and the rows of all are
  /// cleared. Collective.
  VertexCoarsening
  coarsen_by(const NodalSpace                       &space,
             std::vector<VertexCoarsening::Entries> &rows,
             std::vector<unsigned int>              &fine_nodes,
             MPI_Comm                                comm);

  /// Takes back, body by body, the finest cells of all, then the finest of what
  /// is left, down to the coarse meshes; none where nothing was refined.
  /// The numbering of the first fine mesh is that of @p vertices, of degree one
  /// in all bodies. Collective.
  ///
  /// A vertex that stays and hangs on the coarser mesh hangs on the finest one,
  /// too, from the same vertices: the mesh around it is the same.
  std::vector<VertexCoarsening>
  make_vertex_coarsenings(const NodalSpace &vertices, MPI_Comm comm);
} // namespace mortise
