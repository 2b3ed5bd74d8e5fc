// See level_functions.h.
#include <mortise/operators/levels/level_functions.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  LevelFunctions::LevelFunctions(const MultigridLevel   &level,
                                 const Layout           &layout,
                                 const VertexCoarsening *coarsening)
    : level(level)
    , layout(layout)
    , constrained((layout->locally_owned_size() + layout->n_ghost_indices()) /
                  dim)
  {
    const LevelVector<double> is_constrained =
      constrained_components(level, layout);
    for (unsigned int i = 0; i < dim * constrained.size(); ++i)
      if (is_constrained.local_element(i) != 0.)
        constrained[i / dim] |= 1U << i % dim;
    if (coarsening == nullptr)
      return;
    rows  = interpolation_rows(*layout, *coarsening);
    begin = rows.begin();
  }

  void
  LevelFunctions::expand(const unsigned int  index,
                         const double        weight,
                         std::vector<Entry> &entries) const
  {
    if (begin.empty())
      entries.push_back({layout->local_to_global(dim * index) / dim,
                         weight,
                         constrained[index]});
    else
      for (unsigned int e = begin[index]; e < begin[index + 1]; ++e)
        entries.push_back(
          {rows.nodes[e], weight * rows.weights[e], constrained[index]});
  }

  LevelFunctions::Masters
  LevelFunctions::find_masters(const std::vector<Index> &cell_nodes) const
  {
    Masters result;
    auto   &entries = result.entries;
    for (const Index cell_node : cell_nodes)
      {
        if (const auto *line =
              level.space->hanging_nodes().get_constraint_entries(cell_node))
          for (const auto &[node, weight] : *line)
            expand(local(node), weight, entries);
        else
          expand(local(cell_node), 1., entries);
        result.ends.push_back(entries.size());
        result.plain = result.plain && begin.empty() &&
                       entries.size() == result.ends.size() &&
                       entries.back().node == cell_node &&
                       entries.back().constrained == 0;
      }
    auto &nodes = result.nodes;
    if (result.plain)
      {
        nodes = cell_nodes;
        return result;
      }
    for (const Entry &entry : entries)
      nodes.push_back(entry.node);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const Entry &entry : entries)
      result.indices.push_back(
        std::lower_bound(nodes.begin(), nodes.end(), entry.node) -
        nodes.begin());
    return result;
  }

  /// resolved = W^T A W with the weights of @p masters.
  void
  LevelFunctions::resolve(const Masters            &masters,
                          const FullMatrix<double> &matrix)
  {
    const unsigned int n = matrix.n(), m = dim * masters.nodes.size();
    half.reinit(m, n);
    resolved.reinit(m, m);
    const auto for_each = [&](const auto &visit) {
      unsigned int e = 0;
      for (unsigned int i = 0; i < masters.ends.size(); ++i)
        for (; e < masters.ends[i]; ++e)
          for (unsigned int c = 0; c < dim; ++c)
            if ((masters.entries[e].constrained >> c & 1U) == 0)
              visit(dim * i + c,
                    dim * masters.indices[e] + c,
                    masters.entries[e].weight);
    };
    for_each([&](const unsigned int i, const unsigned int j, const double w) {
      const double *from = &matrix(i, 0);
      double       *to   = &half(j, 0);
      for (unsigned int k = 0; k < n; ++k)
        to[k] += w * from[k];
    });
    for (unsigned int r = 0; r < m; ++r)
      {
        const double *from = &half(r, 0);
        double       *to   = &resolved(r, 0);
        for_each([&](const unsigned int i,
                     const unsigned int j,
                     const double       w) { to[j] += w * from[i]; });
      }
  }

  void
  LevelFunctions::add(const FullMatrix<double> &of_cell,
                      const Masters            &masters,
                      BlockCsrMatrixBuilder    &builder)
  {
    if (!masters.plain)
      resolve(masters, of_cell);
    add_projected(masters.plain ? of_cell : resolved, masters.nodes, builder);
  }

  MatrixFreeElasticity<double>::CellFunctions
  LevelFunctions::columns(const Masters &masters)
  {
    MatrixFreeElasticity<double>::CellFunctions result(dim *
                                                       masters.nodes.size());
    unsigned int                                e = 0;
    for (unsigned int i = 0; i < masters.ends.size(); ++i)
      for (; e < masters.ends[i]; ++e)
        for (unsigned int c = 0; c < dim; ++c)
          if ((masters.entries[e].constrained >> c & 1U) == 0)
            result[dim * masters.indices[e] + c].emplace_back(
              dim * i + c, masters.entries[e].weight);
    return result;
  }

  void
  LevelFunctions::add_projected(const FullMatrix<double> &matrix,
                                const std::vector<Index> &nodes,
                                BlockCsrMatrixBuilder    &builder)
  {
    numbers.clear();
    for (const Index node : nodes)
      numbers.push_back(builder.local_number(node));
    for (unsigned int i = 0; i < numbers.size(); ++i)
      for (unsigned int j = 0; j < numbers.size(); ++j)
        {
          double *block = builder.block(numbers[i], numbers[j]);
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int r = 0; r < dim; ++r)
              block[dim * c + r] += matrix(dim * i + r, dim * j + c);
        }
  }
} // namespace mortise
