// Products with a BlockCsrMatrix.
#pragma once

#include <deal.II/base/aligned_vector.h>

#include <mortise/operators/levels/block_csr_matrix.h>
#include <mortise/operators/levels/level_operator_base.h>

#include <vector>

namespace mortise
{
  template <typename Number>
  class BlockCsrOperator : public LevelOperatorBase<Number>
  {
  public:
    explicit BlockCsrOperator(BlockCsrMatrix blocks);

    void
    initialize(LevelVector<Number> &v) const override
    {
      v.reinit(layout);
    }

    void
    vmult(LevelVector<Number>       &dst,
          const LevelVector<Number> &src) const override;

    void
    diagonal(LevelVector<Number> &diagonal) const override;

    const std::vector<unsigned int> &
    constrained() const override
    {
      return constrained_indices;
    }

  private:
    std::vector<unsigned int> constrained_indices;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<std::size_t>                                   begin;
    std::vector<unsigned int>                                  columns;
    dealii::AlignedVector<Number>                              values;
  };
} // namespace mortise
