// See elimination_tree.h.
#include <deal.II/base/exceptions.h>

#include <metis.h>
#include <mortise/solvers/factorisation/elimination_tree.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>

namespace mortise
{
  namespace
  {
    using Indices = std::vector<unsigned int>;

    /// Rows with the same columns taken together, as those of one entity of
    /// the mesh are: a quotient of the graph with numbers of rows as weights.
    struct Quotient
    {
      explicit Quotient(const MatrixGraph &graph)
        : member_of(graph.size())
      {
        using Key      = std::pair<std::uint64_t, std::uint64_t>;
        const auto mix = [](std::uint64_t x) {
          x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
          x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
          return x ^ (x >> 31);
        };
        std::map<Key, unsigned int> found;
        Indices                     representative;
        for (unsigned int i = 0; i < graph.size(); ++i)
          {
            // sums of 128 bits stand for sets
            Key key{0, 0};
            for (unsigned int k = graph.begin[i]; k < graph.begin[i + 1]; ++k)
              {
                const std::uint64_t hash = mix(graph.columns[k] + 1);
                key.first += hash;
                key.second += mix(hash);
              }
            const auto [entry, is_new] = found.emplace(key, weights.size());
            if (is_new)
              {
                representative.push_back(i);
                weights.push_back(0);
              }
            member_of[i] = entry->second;
            ++weights[entry->second];
          }
        // rows of a node may list, as zeros, columns whose rows do not list it
        std::vector<std::vector<idx_t>> lists(weights.size());
        for (unsigned int v = 0; v < weights.size(); ++v)
          for (unsigned int k = graph.begin[representative[v]];
               k < graph.begin[representative[v] + 1];
               ++k)
            if (const unsigned int w = member_of[graph.columns[k]]; w != v)
              {
                lists[v].push_back(w);
                lists[w].push_back(v);
              }
        begin.push_back(0);
        for (auto &list : lists)
          {
            std::sort(list.begin(), list.end());
            neighbours.insert(neighbours.end(),
                              list.begin(),
                              std::unique(list.begin(), list.end()));
            begin.push_back(neighbours.size());
          }
      }

      idx_t
      size() const
      {
        return weights.size();
      }

      Indices            member_of;
      std::vector<idx_t> begin, neighbours, weights;
    };

    /// Up to this many rows one dense block takes no longer than an order and
    /// its blocks.
    constexpr unsigned int max_dense = 192;

    /// New position by vertex.
    Indices
    dissect(Quotient &graph)
    {
      idx_t              n = graph.size();
      std::vector<idx_t> old(n), permutation(n);
      if (n < 3) // nothing to gain
        {
          std::iota(permutation.begin(), permutation.end(), 0);
          return Indices(permutation.begin(), permutation.end());
        }
      idx_t options[METIS_NOPTIONS];
      METIS_SetDefaultOptions(options);
      options[METIS_OPTION_COMPRESS] = 0;
      options[METIS_OPTION_CCORDER]  = 1;
      const int result               = METIS_NodeND(&n,
                                      graph.begin.data(),
                                      graph.neighbours.data(),
                                      graph.weights.data(),
                                      options,
                                      old.data(),
                                      permutation.data());
      AssertThrow(result == METIS_OK,
                  dealii::ExcMessage("METIS could not order the matrix"));
      return Indices(permutation.begin(), permutation.end());
    }

    /// The graph with its vertices at new positions, only neighbours behind.
    struct Ordered
    {
      Ordered(const Quotient &graph, const Indices &permutation)
        : later(graph.size())
        , earlier(graph.size())
        , weights(graph.size())
      {
        for (unsigned int v = 0; v < permutation.size(); ++v)
          {
            weights[permutation[v]] = graph.weights[v];
            for (idx_t k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
              if (const unsigned int w = permutation[graph.neighbours[k]];
                  w > permutation[v])
                {
                  later[permutation[v]].push_back(w);
                  earlier[w].push_back(permutation[v]);
                }
          }
      }

      std::vector<Indices> later, earlier;
      Indices              weights;
    };

    std::vector<int>
    elimination_parents(const Ordered &graph)
    {
      const unsigned int n = graph.weights.size();
      std::vector<int>   parent(n, -1), ancestor(n, -1);
      for (unsigned int j = 0; j < n; ++j)
        for (int i : graph.earlier[j])
          while (i != -1 && i != static_cast<int>(j))
            {
              const int next = ancestor[i];
              ancestor[i]    = j;
              if (next == -1)
                parent[i] = j;
              i = next;
            }
      return parent;
    }

    /// New position by vertex: each subtree together, its root last.
    Indices
    postorder(const std::vector<int> &parent)
    {
      const int        n = parent.size();
      std::vector<int> first_child(n, -1), sibling(n, -1), stack;
      for (int v = n - 1; v >= 0; --v)
        if (parent[v] >= 0)
          {
            sibling[v]             = first_child[parent[v]];
            first_child[parent[v]] = v;
          }
      Indices      permutation(n);
      unsigned int next = 0;
      for (int root = 0; root < n; ++root)
        if (parent[root] < 0)
          {
            stack.push_back(root);
            while (!stack.empty())
              {
                const int v = stack.back();
                if (const int child = first_child[v]; child >= 0)
                  {
                    first_child[v] = sibling[child];
                    stack.push_back(child);
                  }
                else
                  {
                    permutation[v] = next++;
                    stack.pop_back();
                  }
              }
          }
      return permutation;
    }

    /// Vertices below the diagonal of each column of the factor.
    std::vector<Indices>
    factor_columns(const Ordered &graph, const std::vector<int> &parent)
    {
      const unsigned int   n = parent.size();
      std::vector<Indices> columns(n), children(n);
      std::vector<int>     mark(n, -1);
      for (unsigned int j = 0; j < n; ++j)
        if (parent[j] >= 0)
          children[parent[j]].push_back(j);
      for (unsigned int j = 0; j < n; ++j)
        {
          mark[j]        = j;
          const auto add = [&](const unsigned int i) {
            if (mark[i] != static_cast<int>(j))
              {
                mark[i] = j;
                columns[j].push_back(i);
              }
          };
          for (const unsigned int i : graph.later[j])
            add(i);
          for (const unsigned int child : children[j])
            for (const unsigned int i : columns[child])
              add(i);
          std::sort(columns[j].begin(), columns[j].end());
        }
      return columns;
    }

    /// Columns taken together. Zeros are stored where that makes blocks large
    /// enough for dense kernels.
    struct Block
    {
      unsigned int first = 0, last = 0; ///< vertices
      double       width = 0., below = 0., zeros = 0.;

      double
      n_entries() const
      {
        return width * (width + below);
      }
    };

    bool
    worth_merging(const Block &child, const Block &parent, const double zeros)
    {
      const double width   = child.width + parent.width;
      const double entries = width * (width + parent.below);
      return zeros <= 0.03 * entries ||
             (width <= 32. && zeros <= 0.25 * entries);
    }

    std::vector<Block>
    make_blocks(const Ordered              &graph,
                const std::vector<int>     &parent,
                const std::vector<Indices> &columns)
    {
      std::vector<Block> blocks;
      for (unsigned int j = 0; j < parent.size(); ++j)
        {
          Block block{j, j, double(graph.weights[j]), 0., 0.};
          for (const unsigned int i : columns[j])
            block.below += graph.weights[i];
          // with what ends in front of it and has it as its parent
          while (!blocks.empty() &&
                 parent[blocks.back().last] == static_cast<int>(j))
            {
              const Block &child = blocks.back();
              const double zeros =
                child.zeros + block.zeros +
                child.width * (block.width + block.below - child.below);
              if (!worth_merging(child, block, zeros))
                break;
              block.first = child.first;
              block.width += child.width;
              block.zeros = zeros;
              blocks.pop_back();
            }
          blocks.push_back(block);
        }
      return blocks;
    }
  } // namespace

  EliminationTree::EliminationTree(const MatrixGraph &matrix)
    : permutation(matrix.size())
  {
    if (matrix.size() == 0)
      return;
    if (matrix.size() <= max_dense)
      {
        std::iota(permutation.begin(), permutation.end(), 0);
        supernodes.emplace_back();
        supernodes.back().width = matrix.size();
        return;
      }
    Quotient quotient(matrix);
    Indices  vertex_permutation = dissect(quotient);
    {
      const Indices again =
        postorder(elimination_parents(Ordered(quotient, vertex_permutation)));
      for (unsigned int &v : vertex_permutation)
        v = again[v];
    }
    const Ordered graph(quotient, vertex_permutation);
    const auto    parent  = elimination_parents(graph);
    const auto    columns = factor_columns(graph, parent);
    const auto    blocks  = make_blocks(graph, parent, columns);

    // from vertices to rows
    const unsigned int n = parent.size();
    Indices            first(n + 1);
    std::partial_sum(graph.weights.begin(),
                     graph.weights.end(),
                     first.begin() + 1);
    Indices next(first.begin(), first.end() - 1);
    for (unsigned int i = 0; i < permutation.size(); ++i)
      permutation[i] = next[vertex_permutation[quotient.member_of[i]]]++;
    Indices block_of(n);
    for (unsigned int b = 0; b < blocks.size(); ++b)
      for (unsigned int v = blocks[b].first; v <= blocks[b].last; ++v)
        block_of[v] = b;
    for (const Block &block : blocks)
      {
        Supernode supernode;
        supernode.first = first[block.first];
        supernode.width = first[block.last + 1] - supernode.first;
        for (const unsigned int v : columns[block.last])
          for (unsigned int i = first[v]; i < first[v + 1]; ++i)
            supernode.rows.push_back(i);
        if (parent[block.last] >= 0)
          supernode.parent = block_of[parent[block.last]];
        supernodes.push_back(std::move(supernode));
      }
    for (unsigned int s = 0; s < supernodes.size(); ++s)
      if (const int above = supernodes[s].parent; above >= 0)
        supernodes[above].children.push_back(s);
  }

  std::vector<int>
  distribute_supernodes(const std::vector<Supernode> &supernodes,
                        const int                     n_ranks)
  {
    const unsigned int  n = supernodes.size();
    std::vector<double> work(n); // of subtrees
    Indices             roots;
    const auto          n_entries = [&](const unsigned int s) {
      return double(supernodes[s].width) * supernodes[s].height();
    };
    for (unsigned int s = 0; s < n; ++s)
      {
        work[s] += n_entries(s);
        if (const int parent = supernodes[s].parent; parent >= 0)
          work[parent] += work[s];
        else
          roots.push_back(s);
      }
    const auto deal = [&](std::vector<int> &owner) {
      std::stable_sort(roots.begin(), roots.end(), [&](auto a, auto b) {
        return work[a] > work[b];
      });
      std::vector<double> load(n_ranks);
      for (const unsigned int root : roots)
        {
          const auto least = std::min_element(load.begin(), load.end());
          owner[root]      = least - load.begin();
          *least += work[root];
        }
      return *std::max_element(load.begin(), load.end());
    };
    // Cut the heaviest subtree until the heaviest rank has the least to do,
    // with the work that all do.
    std::vector<int> owner(n, on_all_ranks);
    double           best = deal(owner), common_work = 0.;
    for (unsigned int cut = 0; n_ranks > 1 && cut < 8u * n_ranks; ++cut)
      {
        if (roots.empty() || supernodes[roots.front()].children.empty())
          break;
        const unsigned int s = roots.front();
        roots.erase(roots.begin());
        common_work += n_entries(s);
        roots.insert(roots.end(),
                     supernodes[s].children.begin(),
                     supernodes[s].children.end());
        std::vector<int> other(n, on_all_ranks);
        if (const double load = deal(other) + common_work; load < best)
          {
            best  = load;
            owner = std::move(other);
          }
      }
    for (unsigned int s = n; s-- > 0;)
      if (const int parent = supernodes[s].parent;
          parent >= 0 && owner[parent] != on_all_ranks)
        owner[s] = owner[parent];
    return owner;
  }
} // namespace mortise
