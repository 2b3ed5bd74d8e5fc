// See block_csr_operator.h.
#include <mortise/operators/levels/block_csr_operator.h>

#include <algorithm>
#include <cstring>

namespace mortise
{
  using namespace dealii;

  template <typename Number>
  BlockCsrOperator<Number>::BlockCsrOperator(BlockCsrMatrix blocks)
    : constrained_indices(constrained_components(blocks))
    , layout(blocks.layout)
    , begin(std::move(blocks.begin))
    , columns(std::move(blocks.columns))
  {
    values.resize_fast(blocks.values.size() + 1); // see vmult()
    std::copy(blocks.values.begin(), blocks.values.end(), values.begin());
    values.back() = 0;
  }

  template <typename Number>
  void
  BlockCsrOperator<Number>::vmult(LevelVector<Number>       &dst,
                                  const LevelVector<Number> &src) const
  {
    // A column of a block and one number behind it, which is not used.
    typedef Number Column __attribute__((vector_size(4 * sizeof(Number))));
    const auto     load = [](const Number *from) {
      Column column;
      std::memcpy(&column, from, sizeof(Column));
      return column;
    };
    src.update_ghost_values();
    const Number *x = src.begin(), *a = values.begin();
    Number       *y = dst.begin();
    for (unsigned int i = 0; i + 1 < begin.size(); ++i, y += dim)
      {
        Column sums[dim] = {};
        for (std::size_t k = begin[i]; k < begin[i + 1]; ++k, a += dim * dim)
          {
            const Number *u = x + std::size_t(dim) * columns[k];
            for (unsigned int c = 0; c < dim; ++c)
              sums[c] += load(a + dim * c) * u[c];
          }
        const Column sum = sums[0] + sums[1] + sums[2];
        for (unsigned int r = 0; r < dim; ++r)
          y[r] = sum[r];
      }
    src.zero_out_ghost_values();
  }

  template <typename Number>
  void
  BlockCsrOperator<Number>::diagonal(LevelVector<Number> &diagonal) const
  {
    initialize(diagonal);
    for (unsigned int i = 0; i + 1 < begin.size(); ++i)
      for (std::size_t k = begin[i]; k < begin[i + 1]; ++k)
        if (columns[k] == i)
          for (unsigned int c = 0; c < dim; ++c)
            diagonal.local_element(dim * i + c) =
              values[dim * dim * k + (dim + 1) * c];
    for (const unsigned int index : constrained_indices)
      diagonal.local_element(index) = 1;
  }

  template class BlockCsrOperator<float>;
  template class BlockCsrOperator<double>;
} // namespace mortise
