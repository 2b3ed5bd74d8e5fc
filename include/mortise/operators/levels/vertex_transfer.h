// Interpolation P between the vertices of a mesh and of a coarser one, and the
// matrix P^T A P.
#pragma once

#include <mortise/body/spaces/vertex_coarsening.h>
#include <mortise/operators/levels/block_csr_matrix.h>
#include <mortise/operators/levels/level_operator_base.h>

#include <numeric>
#include <vector>

namespace mortise
{
  /// Rows of P, one behind the other.
  struct InterpolationRows
  {
    using Index = VertexCoarsening::Index;

    std::vector<unsigned int> lengths;
    std::vector<Index>        nodes; ///< coarse ones
    std::vector<double>       weights;

    /// Where rows begin, and the last one ends.
    std::vector<unsigned int>
    begin() const
    {
      std::vector<unsigned int> result(lengths.size() + 1);
      std::partial_sum(lengths.begin(), lengths.end(), result.begin() + 1);
      return result;
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &lengths &nodes &weights;
    }
  };

  /// The rows of all local nodes of @p layout (three indices per node), whose
  /// owned nodes are the fine ones of @p coarsening. Collective.
  InterpolationRows
  interpolation_rows(const dealii::Utilities::MPI::Partitioner &layout,
                     const VertexCoarsening                    &coarsening);

  /// Drop from @p coarse the components that are constrained at its vertices;
  /// @p constrained: indices of owned fine ones. Collective.
  void
  constrain(const std::vector<unsigned int> &constrained,
            const VertexCoarsening          &coarsening,
            BlockCsrMatrix                  &coarse);

  /// P^T A P with the constraints of the coarse vertices and the ghosts that P
  /// needs. Collective.
  BlockCsrMatrix
  coarsen(const BlockCsrMatrix &fine, const VertexCoarsening &coarsening);

  /// P is the same for all components.
  template <typename Number>
  class VertexTransfer
  {
  public:
    /// @p coarse: by coarsen().
    VertexTransfer(const VertexCoarsening &coarsening,
                   const BlockCsrMatrix   &coarse);

    /// fine += P coarse, constrained components included. Collective.
    void
    prolongate_add(LevelVector<Number>       &fine,
                   const LevelVector<Number> &coarse) const;

    /// coarse = P^T fine, constrained components included. Collective.
    void
    restrict_to(LevelVector<Number>       &coarse,
                const LevelVector<Number> &fine) const;

  private:
    std::vector<unsigned int> begin;   ///< by owned fine node
    std::vector<unsigned int> indices; ///< of coarse nodes' first components
    std::vector<Number>       weights;
  };
} // namespace mortise
