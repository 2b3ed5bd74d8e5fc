#include <mortise/operators/matrix_free/hanging_nodes.h>
#include <mortise/operators/matrix_free/tensor_kernel.h>

#include <algorithm>
#include <map>

namespace mortise
{
  using namespace dealii;

  template <typename Number, unsigned int n_components>
  HangingNodes<Number, n_components>::HangingNodes(
    const NodalSpace                  &space,
    const Utilities::MPI::Partitioner &layout)
  {
    std::map<std::vector<unsigned int>, unsigned int> group_of_columns;
    std::vector<std::vector<double>>                  values; // by group
    for (const auto &line : space.hanging_nodes().get_lines())
      {
        // sorted by index, but ghosts lie behind what is owned
        std::vector<std::pair<unsigned int, double>> entries;
        for (const auto &[node, weight] : line.entries)
          entries.emplace_back(layout.global_to_local(n_components * node),
                               weight);
        std::sort(entries.begin(), entries.end());
        std::vector<unsigned int> columns;
        for (const auto &entry : entries)
          columns.push_back(entry.first);
        const auto [found, is_new] =
          group_of_columns.emplace(columns, groups.size());
        if (is_new)
          {
            groups.push_back({{}, columns, 0});
            values.emplace_back();
          }
        groups[found->second].rows.push_back(
          layout.global_to_local(n_components * line.index));
        auto &list = values[found->second];
        for (const auto &entry : entries)
          list.push_back(entry.second);
      }

    std::size_t size = 0, widest = 0;
    for (Group &group : groups)
      {
        const std::size_t m = padded<Number>(group.columns.size());
        group.first         = size;
        size += group.rows.size() * m;
        widest = std::max(widest, m);
      }
    weights.resize(size);
    workspace.resize(n_components * widest);
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        const std::size_t n = groups[g].columns.size();
        for (unsigned int r = 0; r < groups[g].rows.size(); ++r)
          std::copy_n(&values[g][r * n],
                      n,
                      &weights[groups[g].first + r * padded<Number>(n)]);
      }
  }

  template <typename Number, unsigned int n_components>
  void
  HangingNodes<Number, n_components>::fill(Number *u) const
  {
    using V = typename Batch<Number>::Vector;
    for (const Group &group : groups)
      {
        const std::size_t n = group.columns.size(),
                          m = padded<Number>(n) / Batch<Number>::size;
        const V *weight   = reinterpret_cast<const V *>(&weights[group.first]);
        V       *gathered = reinterpret_cast<V *>(workspace.data());
        for (unsigned int c = 0; c < n_components; ++c)
          {
            gathered[c * m + m - 1] = V{};
            Number *to = workspace.data() + c * m * Batch<Number>::size;
            for (unsigned int j = 0; j < n; ++j)
              to[j] = u[group.columns[j] + c];
          }
        for (const unsigned int row : group.rows)
          {
            V sums[n_components] = {};
            for (unsigned int j = 0; j < m; ++j, ++weight)
              for (unsigned int c = 0; c < n_components; ++c)
                sums[c] += *weight * gathered[c * m + j];
            for (unsigned int c = 0; c < n_components; ++c)
              {
                Number sum = 0;
                for (unsigned int l = 0; l < Batch<Number>::size; ++l)
                  sum += sums[c][l];
                u[row + c] = sum;
              }
          }
      }
  }

  template <typename Number, unsigned int n_components>
  void
  HangingNodes<Number, n_components>::collect(Number *r) const
  {
    using V = typename Batch<Number>::Vector;
    for (const Group &group : groups)
      {
        const std::size_t n = group.columns.size(),
                          m = padded<Number>(n) / Batch<Number>::size;
        const V *weight = reinterpret_cast<const V *>(&weights[group.first]);
        V       *sums   = reinterpret_cast<V *>(workspace.data());
        std::fill(sums, sums + n_components * m, V{});
        for (const unsigned int row : group.rows)
          {
            for (unsigned int j = 0; j < m; ++j, ++weight)
              for (unsigned int c = 0; c < n_components; ++c)
                sums[c * m + j] += *weight * r[row + c];
            for (unsigned int c = 0; c < n_components; ++c)
              r[row + c] = 0;
          }
        for (unsigned int c = 0; c < n_components; ++c)
          {
            const Number *from = workspace.data() + c * m * Batch<Number>::size;
            for (unsigned int j = 0; j < n; ++j)
              r[group.columns[j] + c] += from[j];
          }
      }
  }

  template <typename Number, unsigned int n_components>
  void
  HangingNodes<Number, n_components>::clear(Number *u) const
  {
    for (const Group &group : groups)
      for (const unsigned int row : group.rows)
        for (unsigned int c = 0; c < n_components; ++c)
          u[row + c] = 0;
  }

  template <typename Number, unsigned int n_components>
  void
  HangingNodes<Number, n_components>::collect_diagonal(Number *d) const
  {
    for (const Group &group : groups)
      {
        const std::size_t n = group.columns.size(), m = padded<Number>(n);
        for (unsigned int i = 0; i < group.rows.size(); ++i)
          for (unsigned int c = 0; c < n_components; ++c)
            {
              const Number *weight = &weights[group.first + i * m];
              for (unsigned int j = 0; j < n; ++j)
                d[group.columns[j] + c] +=
                  weight[j] * weight[j] * d[group.rows[i] + c];
              d[group.rows[i] + c] = 0;
            }
      }
  }

  template class HangingNodes<float>;
  template class HangingNodes<double>;
  template class HangingNodes<double, 1>;
} // namespace mortise
