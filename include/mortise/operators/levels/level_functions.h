// Basis functions of a matrix on a level, given by their values at the nodes of
// cells, and assembly over cells.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/operators/levels/block_csr_matrix.h>
#include <mortise/operators/levels/multigrid_level.h>
#include <mortise/operators/levels/vertex_transfer.h>

#include <vector>

namespace mortise
{
  /// The functions of the nodes of the level that do not hang, or of those that
  /// a coarsening keeps.
  class LevelFunctions
  {
  public:
    using Index = dealii::types::global_dof_index;

    struct Entry
    {
      Index        node; ///< of the matrix
      double       weight;
      unsigned int constrained; ///< bits of its constrained components
    };

    /// Master nodes of the values in a cell: entries ends[i - 1], ... for its
    /// node i, each of node nodes[index].
    struct Masters
    {
      std::vector<Index>        nodes;
      std::vector<Entry>        entries;
      std::vector<unsigned int> indices; ///< by entry
      std::vector<unsigned int> ends;    ///< by node

      /// They are the nodes of the cell and free.
      bool plain = true;
    };

    using Layout = std::shared_ptr<const dealii::Utilities::MPI::Partitioner>;

    /// @p level is kept by reference; @p coarsening may be null. Local nodes are those of @p layout,
    /// which owns what that of the level does. Collective.
    LevelFunctions(const MultigridLevel   &level,
                   const Layout           &layout,
                   const VertexCoarsening *coarsening);

    /// Adds to @p entries the value at a local node that does not hang.
    void
    expand(unsigned int        index,
           double              weight,
           std::vector<Entry> &entries) const;

    Masters
    find_masters(const std::vector<Index> &nodes) const;

    /// By node of @p masters and component: the entries (component of a node of the cell, value) of the function.
    static MatrixFreeElasticity<double>::CellFunctions
    columns(const Masters &masters);

    /// Adds W^T A W, A the matrix of a cell and W the columns().
    void
    add(const dealii::FullMatrix<double> &matrix,
        const Masters                    &masters,
        BlockCsrMatrixBuilder            &builder);

    /// Adds a matrix of these functions.
    void
    add_projected(const dealii::FullMatrix<double> &matrix,
                  const std::vector<Index>         &nodes,
                  BlockCsrMatrixBuilder            &builder);

  private:
    void
    resolve(const Masters &masters, const dealii::FullMatrix<double> &matrix);

    unsigned int
    local(const Index node) const
    {
      return layout->global_to_local(dim * node) / dim;
    }

    const MultigridLevel      &level;
    const Layout               layout;
    std::vector<unsigned int>  constrained; ///< by local node, bits
    InterpolationRows          rows;        ///< of the coarsening
    std::vector<unsigned int>  begin;
    dealii::FullMatrix<double> half, resolved;
    std::vector<unsigned int>  numbers; ///< in the builder
  };
} // namespace mortise
