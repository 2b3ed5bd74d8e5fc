// Products with a matrix of NodeBlocks.
#pragma once

#include <deal.II/base/aligned_vector.h>

#include <mortise/operators/nodal_operator.h>
#include <mortise/operators/node_blocks.h>

#include <vector>

namespace mortise
{
  template <typename Number>
  class NodeBlockOperator : public NodalOperator<Number>
  {
  public:
    explicit NodeBlockOperator(NodeBlocks blocks);

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
    held() const override
    {
      return held_places;
    }

  private:
    std::vector<unsigned int>                                  held_places;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<std::size_t>                                   begin;
    std::vector<unsigned int>                                  columns;
    dealii::AlignedVector<Number>                              values;
  };
} // namespace mortise
