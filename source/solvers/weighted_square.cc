// See weighted_square.h.
#include <Epetra_Import.h>
#include <Teuchos_BLAS.hpp>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/multiplier_nodes.h>
#include <mortise/solvers/weighted_square.h>

#include <algorithm>
#include <array>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// T B^T by node, a row for each column of B: the rows of one component
    /// behind those of another, their columns ascending, owned ones first.
    struct NodeTranspose
    {
      NodeTranspose(const Epetra_CrsMatrix &matrix,
                    const Epetra_Map       &columns,
                    const NodeNumbers      &numbers)
        : row_of(columns.NumMyElements())
        , begin{0}
      {
        std::vector<std::pair<int, double>> row;
        for (unsigned int c = 0; c < dim; ++c)
          for (int i = 0; i < columns.NumMyElements(); ++i)
            if (const int id = columns.GID(i);
                id % static_cast<int>(dim) == static_cast<int>(c))
              {
                const EpetraRow entries(matrix, matrix.LRID(id));
                row.clear();
                for (int k = 0; k < entries.length; ++k)
                  row.emplace_back(numbers.of_column[entries.columns[k]],
                                   entries.values[k]);
                std::sort(row.begin(), row.end());
                row_of[i] = begin.size() - 1;
                for (const auto &[node, value] : row)
                  {
                    nodes.push_back(node);
                    values.push_back(value);
                  }
                begin.push_back(nodes.size());
              }
        for (unsigned int r = 0; r < size(); ++r)
          group_of.push_back(r > 0 && same_nodes(r - 1, r) ? group_of.back() :
                                                             r);
        same.resize(size(), {-1, -1, -1});
        for (int i = 0; i < columns.NumMyElements(); ++i)
          if (const int id = columns.GID(i); id % static_cast<int>(dim) == 0)
            for (unsigned int c = 0; c < dim; ++c)
              if (const int other = columns.LID(id + static_cast<int>(c));
                  other >= 0 && same_rows(row_of[i], row_of[other]))
                same[row_of[i]][c] = row_of[other];
      }

      unsigned int
      size() const
      {
        return begin.size() - 1;
      }

      bool
      same_nodes(const unsigned int r, const unsigned int s) const
      {
        return std::equal(nodes.begin() + begin[r],
                          nodes.begin() + begin[r + 1],
                          nodes.begin() + begin[s],
                          nodes.begin() + begin[s + 1]);
      }

      bool
      same_rows(const unsigned int r, const unsigned int s) const
      {
        return same_nodes(r, s) && std::equal(values.begin() + begin[r],
                                              values.begin() + begin[r + 1],
                                              values.begin() + begin[s]);
      }

      std::vector<int>          row_of; ///< by column of B
      std::vector<unsigned int> begin;
      std::vector<int>          nodes;
      std::vector<double>       values;
      std::vector<unsigned int> group_of; ///< neighbours with the same nodes
      /// By row of the first component: that of another component if it is the
      /// same, else -1.
      std::vector<std::array<int, dim>> same;
    };

    /// Computes the rows of entities one after the other.
    class Square
    {
    public:
      Square(const Epetra_CrsMatrix         &B,
             const NodeTranspose            &transposed,
             const NodeNumbers              &numbers,
             const std::vector<EntityNodes> &entities)
        : B(B)
        , transposed(transposed)
        , entities(entities)
        , place(numbers.global.size())
        , mark(numbers.global.size(), -1)
      {
        result.n_components  = dim;
        std::size_t n_values = 0, n_columns = 0;
        for (unsigned int e = 0; e < entities.size(); ++e)
          {
            alike.push_back(is_alike(entities[e]));
            patterns.push_back(pattern(e));
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

      NodeRows result;

    private:
      /// Have all components the same rows?
      bool
      is_alike(const EntityNodes &entity) const
      {
        if (entity.groups.size() != dim)
          return false;
        for (unsigned int c = 0; c < dim; ++c)
          {
            const NodeGroup &group = entity.groups[c];
            if (group.component != c ||
                group.rows.n_rows != entity.groups[0].rows.n_rows)
              return false;
            for (int i = 0; i < group.rows.n_rows; ++i)
              {
                const EpetraRow p(B, entity.groups[0].rows.first + i),
                  q(B, group.rows.first + i);
                if (!std::equal(p.values,
                                p.values + p.length,
                                q.values,
                                q.values + q.length))
                  return false;
                for (int k = 0; k < p.length && i == 0; ++k)
                  if (transposed.same[transposed.row_of[p.columns[k]]][c] !=
                      transposed.row_of[q.columns[k]])
                    return false;
              }
          }
        return true;
      }

      std::vector<int>
      pattern(const unsigned int e)
      {
        std::vector<int> result;
        for (const NodeGroup &group : entities[e].groups)
          {
            const EpetraRow row(B, group.rows.first);
            unsigned int    last = transposed.size();
            for (int k = 0; k < row.length; ++k)
              {
                const unsigned int r = transposed.row_of[row.columns[k]];
                if (transposed.group_of[r] == last)
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
            if (alike[e])
              break;
          }
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
        return &result.values[begin[e]] +
               (node - entities[e].first) * stride(e) +
               (alike[e] ? 0 : component * patterns[e].size());
      }

      void
      compute(const unsigned int e, const NodeNumbers &numbers)
      {
        const EntityNodes      &entity  = entities[e];
        const std::vector<int> &columns = patterns[e];
        for (unsigned int l = 0; l < columns.size(); ++l)
          place[columns[l]] = l;
        for (const NodeGroup &group : entity.groups)
          {
            for (int i = 0; i < group.rows.n_rows; ++i)
              result.entries[(group.node + i) * dim + group.component] =
                group.rows.first + i;
            if (alike[e] && group.component > 0)
              continue;
            multiply(e, group);
            mirror(e, group);
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
      multiply(const unsigned int e, const NodeGroup &group)
      {
        const EpetraRow row(B, group.rows.first);
        const int       n = group.rows.n_rows;
        for (int k = 0; k < row.length;)
          {
            // rows of a group have the same nodes and stand one behind the
            // other
            const int          first = k;
            const unsigned int r     = transposed.row_of[row.columns[k]];
            while (++k < row.length &&
                   transposed.row_of[row.columns[k]] ==
                     static_cast<int>(r) + k - first &&
                   transposed.group_of[r + k - first] == transposed.group_of[r])
              ;
            const int *nodes   = &transposed.nodes[transposed.begin[r]];
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
                      &transposed.values[transposed.begin[r]] + skipped,
                      n_nodes,
                      row.values + first,
                      row.length,
                      0.,
                      product.data(),
                      length);
            const double *from = product.data();
            for (int i = 0; i < n; ++i, from += length)
              {
                double *to = values(e, group.node + i, group.component);
                for (int l = 0; l < length; ++l)
                  to[place[nodes[skipped + l]]] += from[l];
              }
          }
      }

      /// Columns in front of the entity's own nodes: owned, computed before.
      void
      mirror(const unsigned int e, const NodeGroup &group)
      {
        for (unsigned int l = 0;
             l < patterns[e].size() && patterns[e][l] < entities[e].first;
             ++l)
          {
            const int          j     = patterns[e][l];
            const unsigned int other = entity_of[j];
            const double      *from  = values(other, j, group.component);
            const auto        &nodes = patterns[other];
            auto at = std::lower_bound(nodes.begin(), nodes.end(), group.node);
            for (int i = 0; i < group.rows.n_rows && at != nodes.end(); ++i)
              if (*at == group.node + i)
                values(e, group.node + i, group.component)[l] =
                  from[at++ - nodes.begin()];
          }
      }

      const Epetra_CrsMatrix          &B;
      const NodeTranspose             &transposed;
      const std::vector<EntityNodes>  &entities;
      std::vector<int>                 place, mark; ///< by node
      std::vector<char>                alike;       ///< by entity
      std::vector<std::vector<int>>    patterns;    ///< nodes, by entity
      std::vector<std::size_t>         begin;       ///< of values, by entity
      std::vector<unsigned int>        entity_of;
      const Teuchos::BLAS<int, double> blas;
      std::vector<double>              product;
    };

    /// T B^T with a row for each column of B.
    std::unique_ptr<Epetra_CrsMatrix>
    scaled_transpose(const Epetra_CrsMatrix    &B,
                     const LevelVector<double> &weights)
    {
      const Epetra_Map &owned  = B.DomainMap();
      auto              scaled = transpose(B, owned);
      Epetra_Vector     scale(owned);
      for (int i = 0; i < scale.MyLength(); ++i)
        scale[i] = weights.local_element(i);
      scaled->LeftScale(scale);
      if (B.Comm().NumProc() == 1)
        return scaled;
      auto on_columns = std::make_unique<Epetra_CrsMatrix>(Copy, B.ColMap(), 0);
      on_columns->Import(*scaled, Epetra_Import(B.ColMap(), owned), Insert);
      on_columns->FillComplete(B.RangeMap(), owned);
      return on_columns;
    }
  } // namespace

  NodeRows
  weighted_square(const Epetra_CrsMatrix    &coupling,
                  const LevelVector<double> &weights)
  {
    const auto        transposed = scaled_transpose(coupling, weights);
    const auto        entities   = group_by_entity(coupling);
    const NodeNumbers numbers =
      number_nodes(entities, coupling.RowMap(), transposed->ColMap());
    const NodeTranspose by_node(*transposed, coupling.ColMap(), numbers);
    return Square(coupling, by_node, numbers, entities).result;
  }
} // namespace mortise
