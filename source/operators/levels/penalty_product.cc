#include <mortise/operators/levels/nodal_penalty.h>
#include <mortise/operators/matrix_free/tensor_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  template <typename Number>
  PenaltyProduct<Number>::PenaltyProduct(const NodalPenalty &penalty)
    : penalty(penalty)
  {
    // rows are filled with zeros to whole vectors of the processor
    std::size_t size = 0, widest = 0;
    for (const auto &group : penalty.groups)
      {
        const std::size_t n = padded<Number>(group.columns.size());
        size += group.rows.size() * n;
        widest = std::max(widest, n);
      }
    values.resize(size);
    workspace.resize(dim * widest);
    Number *to = values.data();
    for (const auto &group : penalty.groups)
      for (unsigned int r = 0; r < group.rows.size(); ++r)
        {
          const unsigned int n = group.columns.size();
          std::copy_n(&group.values[r * n], n, to);
          to += padded<Number>(n);
        }
    for (const auto &normal : penalty.normals)
      for (unsigned int c = 0; c < dim; ++c)
        normals.push_back(static_cast<Number>(normal[c]));
  }

  template <typename Number>
  void
  PenaltyProduct<Number>::add(const Number *src, Number *dst) const
  {
    if (normals.empty())
      add_all_components(src, dst);
    else
      add_along_normals(src, dst);
  }

  template <typename Number>
  void
  PenaltyProduct<Number>::add_all_components(const Number *src,
                                             Number       *dst) const
  {
    using V                  = typename Batch<Number>::Vector;
    const unsigned int width = Batch<Number>::size;
    const V *values          = reinterpret_cast<const V *>(this->values.data());
    for (const auto &group : penalty.groups)
      {
        const unsigned int n = group.columns.size(), m = padded<Number>(n);
        std::array<Number *, dim> gathered;
        for (unsigned int c = 0; c < dim; ++c)
          {
            gathered[c] = workspace.data() + c * m;
            std::fill(gathered[c] + n, gathered[c] + m, Number());
          }
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int c = 0; c < dim; ++c)
            gathered[c][j] = src[group.columns[j] + c];
        for (const unsigned int row : group.rows)
          {
            V sums[dim] = {};
            for (unsigned int j = 0; j < m / width; ++j, ++values)
              for (unsigned int c = 0; c < dim; ++c)
                sums[c] +=
                  *values * reinterpret_cast<const V *>(gathered[c])[j];
            for (unsigned int c = 0; c < dim; ++c)
              dst[row + c] +=
                sum_of_batch(reinterpret_cast<Number *>(&sums[c]));
          }
      }
  }

  template <typename Number>
  void
  PenaltyProduct<Number>::add_along_normals(const Number *src,
                                            Number       *dst) const
  {
    using V                  = typename Batch<Number>::Vector;
    const unsigned int width = Batch<Number>::size;
    const V *values          = reinterpret_cast<const V *>(this->values.data());
    Number  *gathered        = workspace.data();
    for (const auto &group : penalty.groups)
      {
        const unsigned int n = group.columns.size(), m = padded<Number>(n);
        std::fill(gathered + n, gathered + m, Number());
        for (unsigned int j = 0; j < n; ++j)
          {
            const unsigned int at = group.columns[j];
            gathered[j]           = normals[at] * src[at] +
                          normals[at + 1] * src[at + 1] +
                          normals[at + 2] * src[at + 2];
          }
        for (const unsigned int row : group.rows)
          {
            V sum = {};
            for (unsigned int j = 0; j < m / width; ++j, ++values)
              sum += *values * reinterpret_cast<const V *>(gathered)[j];
            const Number total = sum_of_batch(reinterpret_cast<Number *>(&sum));
            for (unsigned int c = 0; c < dim; ++c)
              dst[row + c] += normals[row + c] * total;
          }
      }
  }

  template <typename Number>
  void
  PenaltyProduct<Number>::add_diagonal(Number *diagonal) const
  {
    const Number *from = values.data();
    for (const auto &group : penalty.groups)
      for (const unsigned int row : group.rows)
        {
          for (unsigned int k = 0; k < group.columns.size(); ++k)
            if (group.columns[k] == row)
              for (unsigned int c = 0; c < dim; ++c)
                diagonal[row + c] +=
                  from[k] * (normals.empty() ?
                               Number(1) :
                               normals[row + c] * normals[row + c]);
          from += padded<Number>(group.columns.size());
        }
  }

  template class PenaltyProduct<float>;
  template class PenaltyProduct<double>;
} // namespace mortise
