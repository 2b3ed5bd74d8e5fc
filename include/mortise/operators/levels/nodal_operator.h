// What smoothers need to know of an operator on values at nodes.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace mortise
{
  template <typename Number>
  using LevelVector = dealii::LinearAlgebra::distributed::Vector<Number>;

  /// Symmetric, positive definite where components are not constrained. Vectors
  /// are zero where they are, and stay so.
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

    /// 1 at constrained components; initialised here. Collective.
    virtual void
    diagonal(LevelVector<Number> &diagonal) const = 0;

    /// Indices of owned components.
    virtual const std::vector<unsigned int> &
    constrained() const = 0;

    /// Each value of diagonal() by the mean over the components of its node
    /// that are not constrained; 1 at those that are.
    void
    average_components(LevelVector<Number> &diagonal) const;

    /// Zero at constrained components.
    void
    clear_constrained(LevelVector<Number> &v) const
    {
      for (const unsigned int index : constrained())
        v.local_element(index) = 0;
    }
  };
} // namespace mortise
