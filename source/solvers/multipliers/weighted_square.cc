// See weighted_square.h.
#include <Teuchos_BLAS.hpp>
#include <mortise/solvers/multipliers/weighted_square.h>
#include <mortise/solvers/multipliers/weighted_transpose_by_node.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Computes the rows of entities one after the other.
    class Square
    {
    public:
      Square(const RowsByEntity            &B,
             const WeightedTransposeByNode &transposed,
             const NodeNumbers             &numbers)
        : transposed(transposed)
        , entities(B.multipliers.entities)
        , rows(B.rows)
        , index(numbers.global.size())
        , mark(numbers.global.size(), -1)
      {
        result.n_components  = dim;
        std::size_t n_values = 0, n_columns = 0;
        for (unsigned int e = 0; e < entities.size(); ++e)
          {
            patterns.push_back(pattern(e));
            alike.push_back(is_alike(e));
            begin.push_back(n_values);
            n_columns += patterns[e].size() * entities[e].n_nodes;
            n_values += stride(e) * entities[e].n_nodes;
            entity_of.insert(entity_of.end(), entities[e].n_nodes, e);
          }
        result.entries.assign(dim * entity_of.size(), -1);
        result.columns.reserve(n_columns);
        result.values.resize(n_values);
        for (unsigned int e = 0; e < entities.size(); ++e)
          compute(e, numbers);
      }

      RowsByNode result;

    private:
      /// Have all components the same rows?
      bool
      is_alike(const unsigned int e) const
      {
        if (rows[e].size() != 1)
          return false;
        const EntityRows &all = rows[e].front();
        return std::all_of(all.first_row.begin(),
                           all.first_row.end(),
                           [](const int first) { return first >= 0; }) &&
               std::all_of(all.nodes.begin(),
                           all.nodes.end(),
                           [&](const unsigned int node) {
                             return transposed.is_common[node];
                           }) &&
               std::all_of(patterns[e].begin(),
                           patterns[e].end(),
                           [&](const int node) {
                             return transposed.has_all_multipliers(node);
                           });
      }

      std::vector<int>
      pattern(const unsigned int e)
      {
        std::vector<int> result;
        for (const EntityRows &shared : rows[e])
          for (unsigned int c = 0; c < dim; ++c)
            {
              int last = -1;
              for (const unsigned int node : shared.nodes)
                {
                  const int r = transposed.row_of[dim * node + c];
                  if (r < 0 || (c > 0 && transposed.is_common[node]) ||
                      transposed.group_of[r] == last)
                    continue;
                  last = transposed.group_of[r];
                  for (unsigned int l = transposed.begin[r];
                       l < transposed.begin[r + 1];
                       ++l)
                    if (int &m = mark[transposed.nodes[l]];
                        m != static_cast<int>(e))
                      {
                        m = e;
                        result.push_back(transposed.nodes[l]);
                      }
                }
            }
        // a row that moves nothing has its diagonal
        for (int i = 0; i < entities[e].n_nodes; ++i)
          if (mark[entities[e].first + i] != static_cast<int>(e))
            result.push_back(entities[e].first + i);
        std::sort(result.begin(), result.end());
        return result;
      }

      /// From the values of a node to those of the next.
      std::size_t
      stride(const unsigned int e) const
      {
        return patterns[e].size() * (alike[e] ? 1 : dim);
      }

      /// The values of one component.
      double *
      values(const unsigned int e, const int node, const unsigned int component)
      {
        return result.values.data() + begin[e] +
               (node - entities[e].first) * stride(e) +
               (alike[e] ? 0 : component * patterns[e].size());
      }

      void
      compute(const unsigned int e, const NodeNumbers &numbers)
      {
        const EntityNodes      &entity  = entities[e];
        const std::vector<int> &columns = patterns[e];
        for (unsigned int l = 0; l < columns.size(); ++l)
          index[columns[l]] = l;
        for (const EntityRows &shared : rows[e])
          {
            for (int i = 0; i < shared.n_rows; ++i)
              for (unsigned int c = 0; c < dim; ++c)
                if (shared.first_row[c] >= 0)
                  result.entries[(shared.first_node + i) * dim + c] =
                    shared.first_row[c] + i;
            multiply(e, shared);
            mirror(e, shared);
          }
        for (int i = entity.first; i < entity.first + entity.n_nodes; ++i)
          {
            result.lengths.push_back(columns.size());
            result.variants.push_back(alike[e] ? 1 : dim);
            for (const int column : columns)
              result.columns.push_back(numbers.global[column]);
            for (unsigned int c = 0; c < dim; ++c)
              if (result.entries[i * dim + c] < 0)
                {
                  // no other row couples with it
                  const auto at =
                    std::lower_bound(columns.begin(), columns.end(), i) -
                    columns.begin();
                  double largest = 0.;
                  for (unsigned int d = 0; d < dim; ++d)
                    largest = std::max(largest, values(e, i, d)[at]);
                  values(e, i, c)[at] = largest > 0. ? largest : 1.;
                }
          }
      }

      /// Columns from the entity's own nodes on.
      void
      multiply(const unsigned int e, const EntityRows &shared)
      {
        const auto         first = std::find_if(shared.first_row.begin(),
                                        shared.first_row.end(),
                                        [](const int row) { return row >= 0; });
        const unsigned int c0    = first - shared.first_row.begin();
        const auto        &nodes = patterns[e];
        const unsigned int own =
          std::lower_bound(nodes.begin(), nodes.end(), entities[e].first) -
          nodes.begin();
        add_products(e, shared, c0, true);
        if (alike[e])
          return;
        for (unsigned int c = dim; c-- > c0;)
          if (shared.first_row[c] >= 0)
            for (int i = 0; i < shared.n_rows; ++i)
              {
                const double *from = values(e, shared.first_node + i, c0);
                double       *to   = values(e, shared.first_node + i, c);
                for (unsigned int l = own; l < nodes.size(); ++l)
                  to[l] = transposed.has_multiplier(nodes[l], c) ? from[l] : 0.;
              }
        for (unsigned int c = c0; c < dim; ++c)
          if (shared.first_row[c] >= 0)
            add_products(e, shared, c, false);
      }

      /// Adds what comes from the nodes that are common to all components, or
      /// from the others.
      void
      add_products(const unsigned int e,
                   const EntityRows  &shared,
                   const unsigned int component,
                   const bool         common)
      {
        const int  n = shared.n_rows, width = shared.nodes.size();
        const auto row_of = [&](const int k) {
          const unsigned int node = shared.nodes[k];
          return transposed.is_common[node] == common ?
                   transposed.row_of[dim * node + component] :
                   -1;
        };
        for (int k = 0; k < width;)
          {
            // rows of a group have the same nodes and stand one behind the
            // other
            const int first = k, r = row_of(k);
            ++k;
            if (r < 0)
              continue;
            while (k < width && row_of(k) == r + k - first &&
                   transposed.group_of[r + k - first] == transposed.group_of[r])
              ++k;
            const int *nodes   = transposed.nodes.data() + transposed.begin[r];
            const int  n_nodes = transposed.begin[r + 1] - transposed.begin[r];
            const int  skipped =
              std::lower_bound(nodes, nodes + n_nodes, entities[e].first) -
              nodes;
            const int length = n_nodes - skipped;
            if (length == 0)
              continue;
            product.resize(std::size_t(n) * length);
            blas.GEMM(Teuchos::NO_TRANS,
                      Teuchos::NO_TRANS,
                      length,
                      n,
                      k - first,
                      1.,
                      transposed.values.data() + transposed.begin[r] + skipped,
                      n_nodes,
                      shared.values.data() + first,
                      width,
                      0.,
                      product.data(),
                      length);
            const double *from = product.data();
            for (int i = 0; i < n; ++i, from += length)
              {
                double *to = values(e, shared.first_node + i, component);
                for (int l = 0; l < length; ++l)
                  to[index[nodes[skipped + l]]] += from[l];
              }
          }
      }

      /// Columns in front of the entity's own nodes: owned, computed before.
      void
      mirror(const unsigned int e, const EntityRows &shared)
      {
        for (unsigned int c = 0; c < (alike[e] ? 1 : dim); ++c)
          if (shared.first_row[c] >= 0)
            for (unsigned int l = 0;
                 l < patterns[e].size() && patterns[e][l] < entities[e].first;
                 ++l)
              {
                const int          j     = patterns[e][l];
                const unsigned int other = entity_of[j];
                const double      *from  = values(other, j, c);
                const auto        &nodes = patterns[other];
                auto               at    = std::lower_bound(nodes.begin(),
                                           nodes.end(),
                                           shared.first_node);
                for (int i = 0; i < shared.n_rows && at != nodes.end(); ++i)
                  if (*at == shared.first_node + i)
                    values(e, shared.first_node + i, c)[l] =
                      from[at++ - nodes.begin()];
              }
      }

      const WeightedTransposeByNode              &transposed;
      const std::vector<EntityNodes>             &entities;
      const std::vector<std::vector<EntityRows>> &rows;        ///< by entity
      std::vector<int>                            index, mark; ///< by node
      std::vector<char>                           alike;       ///< by entity
      std::vector<std::vector<int>>    patterns; ///< nodes, by entity
      std::vector<std::size_t>         begin;    ///< of values, by entity
      std::vector<unsigned int>        entity_of;
      const Teuchos::BLAS<int, double> blas;
      std::vector<double>              product;
    };
  } // namespace

  RowsByNode
  weighted_square(const RowsByEntity        &coupling,
                  const LevelVector<double> &weights)
  {
    WeightedTranspose transposed(coupling, weights);
    const NodeNumbers numbers =
      number_nodes(coupling.multipliers, transposed.multipliers);
    const WeightedTransposeByNode by_node(std::move(transposed),
                                          coupling,
                                          numbers);
    return Square(coupling, by_node, numbers).result;
  }
} // namespace mortise
