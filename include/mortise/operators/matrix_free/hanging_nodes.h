// Constraints C of the hanging nodes of one level: values of vectors, and the
// transpose for residuals, without communication.
#pragma once

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/partitioner.h>

#include <mortise/body/spaces/nodal_space.h>

#include <vector>

namespace mortise
{
  /// @p n_components of each node follow each other in vectors.
  template <typename Number, unsigned int n_components = dim>
  class HangingNodes
  {
  public:
    /// @p layout: as for MatrixFreeElasticity.
    HangingNodes(const NodalSpace                          &space,
                 const dealii::Utilities::MPI::Partitioner &layout);

    /// u_h = C u: values at hanging nodes from the others, which have their
    /// ghost values.
    void
    fill(Number *u) const;

    /// r += C^T r_h, r_h = 0.
    void
    collect(Number *r) const;

    /// u_h = 0.
    void
    clear(Number *u) const;

    /// d += the part of diag(C^T K C) that comes from d_h = diag(K) at hanging
    /// nodes, without what couples two of them; d_h = 0. It is 0.4 to 1.2 times
    /// the true one, and costs no iteration for p = 2..5 on the thick sphere.
    void
    collect_diagonal(Number *d) const;

  private:
    /// Nodes that follow from the same others.
    struct Group
    {
      std::vector<unsigned int> rows;    ///< indices of first components
      std::vector<unsigned int> columns; ///< indices of first components
      std::size_t               first;   ///< of its weights
    };

    std::vector<Group> groups;
    /// Row by row, filled with zeros to whole vectors of the processor.
    dealii::AlignedVector<Number>         weights;
    mutable dealii::AlignedVector<Number> workspace;
  };
} // namespace mortise
