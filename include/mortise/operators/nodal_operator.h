// What smoothers need to know of an operator on values at nodes. It never
// solves.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

namespace mortise
{
  template <typename Number>
  using LevelVector = dealii::LinearAlgebra::distributed::Vector<Number>;

  /// Symmetric, positive definite where components are not held. Vectors are
  /// zero where they are, and stay so.
  template <typename Number>
  class NodalOperator
  {
  public:
    virtual ~NodalOperator() = default;

    virtual void
    initialize(LevelVector<Number> &v) const = 0;

    /// dst = A src. Collective.
    virtual void
    vmult(LevelVector<Number> &dst, const LevelVector<Number> &src) const = 0;

    /// Each entry of the diagonal by the mean over the components of its node
    /// that are not held; 1 at those that are. @p diagonal is initialised.
    /// Collective.
    virtual void
    node_diagonal(LevelVector<Number> &diagonal) const = 0;

    /// Zero at held components.
    virtual void
    clear_held(LevelVector<Number> &v) const = 0;
  };
} // namespace mortise
