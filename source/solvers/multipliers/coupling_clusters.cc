// See coupling_clusters.h.
#include <mortise/solvers/multipliers/coupling_clusters.h>

#include <algorithm>
#include <iterator>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Each column of a block, which is gathered and scattered, counts as so
    /// many entries: with 6, 16 and 40 products take the same time, with 0, an
    /// entity for a block, two and a half times as long in the smallest scenes.
    constexpr double entries_per_column = 8.;

    double
    work(const double n_rows, const double n_columns)
    {
      return (n_rows + entries_per_column) * n_columns;
    }
  } // namespace

  IndexSet
  coupled_displacements(const BlockSystem &system, const RowsByEntity &rows)
  {
    IndexSet touched(system.owned_displacement.size());
    for (const int displacement : rows.displacements)
      if (displacement >= 0)
        touched.add_index(displacement);
    touched.compress();
    return touched;
  }

  std::vector<bool>
  independent_nodes(const BlockSystem &system, const RowsByEntity &rows)
  {
    LevelVector<float> is_independent(system.owned_displacement,
                                      coupled_displacements(system, rows),
                                      system.communicator);
    if (system.bulk)
      for (const auto &independent : system.bulk->independent_displacements())
        is_independent.local_element(independent.index) = 1.;
    is_independent.update_ghost_values();
    std::vector<bool> result(rows.n_nodes(), true);
    for (unsigned int v = 0; v < dim * result.size(); ++v)
      if (const int displacement = rows.displacements[v];
          displacement >= 0 && is_independent(displacement) == 0.)
        result[v / dim] = false;
    return result;
  }

  SplitEntityRows::SplitEntityRows(const EntityRows        &shared,
                                   const std::vector<bool> &is_independent)
    : shared(&shared)
    , own(shared.n_rows, -1)
  {
    const unsigned int n           = shared.nodes.size();
    bool               is_diagonal = true;
    for (int r = 0; r < shared.n_rows && is_diagonal; ++r)
      for (unsigned int k = 0; k < n; ++k)
        if (!is_independent[shared.nodes[k]] && shared.values[r * n + k] != 0.)
          {
            is_diagonal = is_diagonal && own[r] < 0;
            own[r]      = static_cast<int>(k);
          }
    if (!is_diagonal)
      own.assign(own.size(), -1);
    for (unsigned int k = 0; k < n; ++k)
      if (is_independent[shared.nodes[k]])
        columns[1].push_back(k);
      else if (!is_diagonal)
        columns[0].push_back(k);
  }

  bool
  CouplingCluster::add(const SplitEntityRows &rows)
  {
    std::array<std::vector<unsigned int>, 2> united;
    unsigned int n_united = 0, n_own = 0, n_added = 0;
    for (unsigned int i = 0; i < 2; ++i)
      {
        std::vector<unsigned int> added;
        for (const unsigned int k : rows.columns[i])
          added.push_back(rows.shared->nodes[k]);
        std::set_union(nodes[i].begin(),
                       nodes[i].end(),
                       added.begin(),
                       added.end(),
                       std::back_inserter(united[i]));
        n_united += united[i].size();
        n_own += nodes[i].size();
        n_added += added.size();
      }
    if (end > begin &&
        work(n_rows + rows.shared->n_rows, n_united) >
          work(n_rows, n_own) + work(rows.shared->n_rows, n_added))
      return false;
    nodes = std::move(united);
    n_rows += rows.shared->n_rows;
    ++end;
    return true;
  }

  std::vector<CouplingCluster>
  make_clusters(const std::vector<SplitEntityRows> &all)
  {
    std::vector<CouplingCluster> result;
    for (std::size_t s = 0; s < all.size(); ++s)
      if (result.empty() || !result.back().add(all[s]))
        {
          result.push_back({s, s, 0, {}});
          result.back().add(all[s]);
        }
    return result;
  }
} // namespace mortise
