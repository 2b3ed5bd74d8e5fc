// See rows_by_node.h.
#include <deal.II/base/mpi.h>

#include <mortise/base/sort_unique.h>
#include <mortise/solvers/factorisation/rows_by_node.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace mortise
{
  using namespace dealii;

  RowsByNode
  rows_as_nodes(const SparseMatrix &matrix)
  {
    RowsByNode         nodes;
    const unsigned int n = matrix.n_rows();
    nodes.entries.resize(n);
    std::iota(nodes.entries.begin(), nodes.entries.end(), 0);
    nodes.variants.assign(n, 1);
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto row = matrix.row(i);
        nodes.lengths.push_back(std::max(1u, row.length));
        if (row.length == 0)
          {
            nodes.columns.push_back(static_cast<int>(matrix.global_row(i)));
            nodes.values.push_back(1.);
          }
        for (unsigned int k = 0; k < row.length; ++k)
          nodes.columns.push_back(
            static_cast<int>(matrix.global_column(row.columns[k])));
        nodes.values.insert(nodes.values.end(),
                            row.values,
                            row.values + row.length);
      }
    return nodes;
  }

  void
  add(RowsByNode &matrix, const SparseMatrix &other)
  {
    RowsByNode sum;
    sum.entries           = matrix.entries;
    sum.variants          = matrix.variants;
    const int    *columns = matrix.columns.data();
    const double *values  = matrix.values.data();
    for (unsigned int i = 0; i < matrix.size(); ++i)
      {
        const unsigned int length = matrix.lengths[i];
        const auto         added  = other.row(i);
        const std::size_t  first  = sum.columns.size();
        sum.columns.insert(sum.columns.end(), columns, columns + length);
        sum.values.insert(sum.values.end(), values, values + length);
        columns += length;
        values += length;
        for (unsigned int k = 0; k < added.length; ++k)
          {
            // columns of other ranks may stand in front of lower ones
            const int  column = other.global_column(added.columns[k]);
            const auto at =
              std::find(sum.columns.begin() + first, sum.columns.end(), column);
            if (at != sum.columns.end())
              sum.values[at - sum.columns.begin()] += added.values[k];
            else
              {
                sum.columns.push_back(column);
                sum.values.push_back(added.values[k]);
              }
          }
        sum.lengths.push_back(sum.columns.size() - first);
      }
    matrix = std::move(sum);
  }

  namespace
  {
    int
    first_of(const IndexSet &nodes)
    {
      return nodes.n_elements() == 0 ?
               0 :
               static_cast<int>(nodes.nth_index_in_set(0));
    }

    /// @p owned, a number for each of @p nodes, by column of @p matrix. Collective.
    std::vector<int>
    by_column(const RowsByNode       &matrix,
              const std::vector<int> &owned,
              const IndexSet         &nodes,
              const MPI_Comm          comm)
    {
      const int  first = first_of(nodes), n = owned.size();
      const auto is_owned = [&](const int column) {
        return column >= first && column < first + n;
      };
      std::vector<int> others;
      std::copy_if(matrix.columns.begin(),
                   matrix.columns.end(),
                   std::back_inserter(others),
                   [&](const int column) { return !is_owned(column); });
      sort_unique(others);
      IndexSet of_others(nodes.size());
      of_others.add_indices(others.begin(), others.end());
      LinearAlgebra::distributed::Vector<double> all(nodes, of_others, comm);
      std::copy(owned.begin(), owned.end(), all.begin());
      all.update_ghost_values();
      std::vector<int> result;
      for (const int column : matrix.columns)
        result.push_back(is_owned(column) ? owned[column - first] :
                                            static_cast<int>(all(column)));
      return result;
    }

    /// Does owned node i, whose row begins with @p columns and @p values, couple
    /// with another one?
    bool
    couples(const RowsByNode  &matrix,
            const unsigned int i,
            const int          self,
            const int         *columns,
            const double      *values)
    {
      const unsigned int length = matrix.lengths[i];
      for (unsigned int k = 0; k < length; ++k)
        for (unsigned int c = 0; c < matrix.variants[i]; ++c)
          if (columns[k] != self && values[c * length + k] != 0.)
            return true;
      return false;
    }
  } // namespace

  RowsByNode
  select(const RowsByNode        &matrix,
         const std::vector<bool> &active,
         const MPI_Comm           comm)
  {
    const unsigned int n     = matrix.n_components;
    const IndexSet     nodes = owned_range(matrix.size(), comm);
    std::vector<int>   owned(matrix.size()); // bits of active components
    for (unsigned int i = 0; i < matrix.entries.size(); ++i)
      if (matrix.entries[i] >= 0 && active[matrix.entries[i]])
        owned[i / n] |= 1 << i % n;
    const std::vector<int> bits = by_column(matrix, owned, nodes, comm);
    RowsByNode             result;
    result.n_components  = n;
    result.entries       = matrix.entries;
    const double *values = matrix.values.data();
    std::size_t   column = 0; // first of the node
    for (unsigned int i = 0; i < matrix.size(); ++i)
      {
        const unsigned int length = matrix.lengths[i];
        const int          self   = first_of(nodes) + static_cast<int>(i);
        int                own    = 0;
        for (unsigned int k = 0; k < length; ++k)
          if (matrix.columns[column + k] == self)
            own = bits[column + k];
        std::vector<unsigned int> kept;
        bool                      alike = matrix.variants[i] == 1;
        for (unsigned int k = 0; k < length; ++k)
          if (const int both = own & bits[column + k];
              both != 0 || matrix.columns[column + k] == self)
            {
              kept.push_back(k);
              alike = alike && (both == (1 << n) - 1 || own == 0);
            }
        for (const unsigned int k : kept)
          result.columns.push_back(matrix.columns[column + k]);
        result.lengths.push_back(kept.size());
        result.variants.push_back(alike ? 1 : n);
        for (unsigned int c = 0; c < (alike ? 1 : n); ++c)
          for (const unsigned int k : kept)
            result.values.push_back(
              (own & bits[column + k]) >> c & 1 ||
                  matrix.columns[column + k] == self ?
                values[(matrix.variants[i] == 1 ? 0 : c * length) + k] :
                0.);
        column += length;
        values += std::size_t(length) * matrix.variants[i];
      }
    return result;
  }

  RowsByNode
  extract_coupled(const RowsByNode                    &matrix,
                  const MPI_Comm                       comm,
                  std::vector<std::pair<int, double>> &uncoupled_entries)
  {
    const unsigned int n     = matrix.n_components;
    const IndexSet     nodes = owned_range(matrix.size(), comm);
    std::vector<int>   number(matrix.size()); // of those that couple; or -1
    int                mine    = 0;
    const int         *columns = matrix.columns.data();
    const double      *values  = matrix.values.data();
    for (unsigned int i = 0; i < matrix.size(); ++i)
      {
        const int self = first_of(nodes) + static_cast<int>(i);
        number[i] = couples(matrix, i, self, columns, values) ? mine++ : -1;
        for (unsigned int c = 0; c < n && number[i] < 0; ++c)
          if (matrix.entries[i * n + c] >= 0)
            for (unsigned int k = 0; k < matrix.lengths[i]; ++k)
              if (columns[k] == self)
                uncoupled_entries.emplace_back(
                  matrix.entries[i * n + c],
                  values[(matrix.variants[i] == 1 ? 0 : c * matrix.lengths[i]) +
                         k]);
        columns += matrix.lengths[i];
        values += std::size_t(matrix.lengths[i]) * matrix.variants[i];
      }
    const int first = first_of(owned_range(mine, comm));
    for (int &of_node : number)
      if (of_node >= 0)
        of_node += first;
    const std::vector<int> numbers = by_column(matrix, number, nodes, comm);

    RowsByNode result;
    result.n_components = n;
    const int *column   = numbers.data();
    values              = matrix.values.data();
    for (unsigned int i = 0; i < matrix.size(); ++i)
      {
        const unsigned int length = matrix.lengths[i];
        if (number[i] >= 0)
          {
            result.entries.insert(result.entries.end(),
                                  &matrix.entries[i * n],
                                  &matrix.entries[i * n] + n);
            result.lengths.push_back(length -
                                     std::count(column, column + length, -1));
            result.variants.push_back(matrix.variants[i]);
            std::copy_if(column,
                         column + length,
                         std::back_inserter(result.columns),
                         [](const int c) { return c >= 0; });
            for (unsigned int c = 0; c < matrix.variants[i]; ++c)
              for (unsigned int k = 0; k < length; ++k)
                if (column[k] >= 0)
                  result.values.push_back(values[c * length + k]);
          }
        column += length;
        values += std::size_t(length) * matrix.variants[i];
      }
    return result;
  }

  SparseMatrix
  as_matrix(const RowsByNode &rows, const MPI_Comm comm)
  {
    const unsigned int           n = rows.n_components;
    SparseMatrix::CompressedRows result;
    const int                   *columns = rows.columns.data();
    const double                *values  = rows.values.data();
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        const unsigned int length = rows.lengths[i];
        for (unsigned int c = 0; c < n; ++c)
          {
            const double *variant =
              values + (rows.variants[i] == 1 ? 0 : c * length);
            for (unsigned int k = 0; k < length; ++k)
              result.columns.push_back(columns[k] * n + c);
            result.values.insert(result.values.end(),
                                 variant,
                                 variant + length);
            result.begin.push_back(result.columns.size());
          }
        columns += length;
        values += std::size_t(length) * rows.variants[i];
      }
    const IndexSet owned = owned_range(n * rows.size(), comm);
    return {owned, owned, comm, std::move(result)};
  }

  void
  multiply(const RowsByNode   &rows,
           const SparseMatrix &matrix,
           Vector             &y,
           const Vector       &x)
  {
    const auto         &entries = rows.entries;
    std::vector<double> from(entries.size()), to(entries.size());
    for (unsigned int i = 0; i < entries.size(); ++i)
      if (entries[i] >= 0)
        from[i] = x.local_element(entries[i]);
    matrix.vmult(to.data(), from.data());
    y = 0.;
    for (unsigned int i = 0; i < entries.size(); ++i)
      if (entries[i] >= 0)
        y.local_element(entries[i]) = to[i];
  }
} // namespace mortise
