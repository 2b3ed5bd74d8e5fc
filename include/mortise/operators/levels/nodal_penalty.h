// The penalty by which coarser levels see ties, between nodes, and its product.
#pragma once

#include <deal.II/base/aligned_vector.h>

#include <mortise/base/types.h>

#include <vector>

namespace mortise
{
  /// The jump penalty J = sum over interfaces of gamma int [[u]].[[v]], gamma ~
  /// E / h of the softer side, between the nodes that this rank's slave faces
  /// and their partners have; the same for each component. Where bodies slide,
  /// that of the jumps along normals, gamma int [[u.n]] [[v.n]]. K + J is
  /// regular even where K is not; it is for preconditioning and never part of
  /// the equations.
  struct NodalPenalty
  {
    /// Nodes that couple with the same others, as those inside a face do.
    struct Group
    {
      std::vector<unsigned int> rows;    ///< indices of first components
      std::vector<unsigned int> columns; ///< indices of first components
      std::vector<double>       values;  ///< row by row
    };
    std::vector<Group> groups;
    /// Where bodies slide: by node, those of both sides in one direction. Else
    /// empty.
    std::vector<dealii::Tensor<1, dim>> normals;
  };

  template <typename Number>
  class PenaltyProduct
  {
  public:
    /// @p penalty must stay alive.
    explicit PenaltyProduct(const NodalPenalty &penalty);

    /// dst += J src.
    void
    add(const Number *src, Number *dst) const;

    /// diagonal += that of J.
    void
    add_diagonal(Number *diagonal) const;

  private:
    void
    add_along_normals(const Number *src, Number *dst) const;
    void
    add_all_components(const Number *src, Number *dst) const;

    const NodalPenalty                   &penalty;
    dealii::AlignedVector<Number>         values;  ///< rows padded
    std::vector<Number>                   normals; ///< by node and component
    mutable dealii::AlignedVector<Number> workspace;
  };
} // namespace mortise
