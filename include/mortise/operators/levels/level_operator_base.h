// Interface of the operators that smoothers work with.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace mortise
{
  template <typename Number>
  using LevelVector = dealii::LinearAlgebra::distributed::Vector<Number>;

  /// Symmetric and positive definite on the free components. Vectors are zero
  /// at constrained ones.
  template <typename Number>
  class LevelOperatorBase
  {
  public:
    virtual ~LevelOperatorBase() = default;

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

    /// Replace each value of @p diagonal by the mean over the free components
    /// of its node; 1 at constrained ones.
    void
    average_components(LevelVector<Number> &diagonal) const;

    /// Set constrained components to zero.
    void
    clear_constrained(LevelVector<Number> &v) const
    {
      for (const unsigned int index : constrained())
        v.local_element(index) = 0;
    }
  };
} // namespace mortise
