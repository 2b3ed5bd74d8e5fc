// See nodal_matrix.h.
#include <Epetra_Import.h>
#include <Epetra_IntVector.h>
#include <Epetra_Map.h>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/factorisation/nodal_matrix.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace mortise
{
  NodalMatrix
  rows_as_nodes(const Epetra_CrsMatrix &matrix)
  {
    NodalMatrix nodes;
    const int   n = matrix.NumMyRows();
    nodes.entries.resize(n);
    std::iota(nodes.entries.begin(), nodes.entries.end(), 0);
    nodes.variants.assign(n, 1);
    for (int i = 0; i < n; ++i)
      {
        const EpetraRow row(matrix, i);
        nodes.lengths.push_back(row.length);
        for (int k = 0; k < row.length; ++k)
          nodes.columns.push_back(matrix.GCID(row.columns[k]));
        nodes.values.insert(nodes.values.end(),
                            row.values,
                            row.values + row.length);
      }
    return nodes;
  }

  void
  add(NodalMatrix &matrix, const Epetra_CrsMatrix &other)
  {
    NodalMatrix sum;
    sum.entries           = matrix.entries;
    sum.variants          = matrix.variants;
    const int    *columns = matrix.columns.data();
    const double *values  = matrix.values.data();
    for (unsigned int i = 0; i < matrix.size(); ++i)
      {
        std::map<int, double> row;
        for (unsigned int k = 0; k < matrix.lengths[i]; ++k)
          row[*columns++] += *values++;
        const EpetraRow added(other, static_cast<int>(i));
        for (int k = 0; k < added.length; ++k)
          row[other.GCID(added.columns[k])] += added.values[k];
        sum.lengths.push_back(row.size());
        for (const auto &[column, value] : row)
          {
            sum.columns.push_back(column);
            sum.values.push_back(value);
          }
      }
    matrix = std::move(sum);
  }

  namespace
  {
    Epetra_Map
    nodes_of(const NodalMatrix &matrix, const Epetra_Comm &comm)
    {
      return Epetra_Map(-1, static_cast<int>(matrix.size()), 0, comm);
    }

    /// @p owned, a number for each owned node, by column of @p matrix. Collective.
    std::vector<int>
    by_column(const NodalMatrix &matrix, const Epetra_IntVector &owned)
    {
      std::vector<int> unique(matrix.columns);
      std::sort(unique.begin(), unique.end());
      unique.erase(std::unique(unique.begin(), unique.end()), unique.end());
      const Epetra_Map columns(-1,
                               static_cast<int>(unique.size()),
                               unique.data(),
                               0,
                               owned.Map().Comm());
      Epetra_IntVector all(columns);
      all.Import(owned, Epetra_Import(columns, owned.Map()), Insert);
      std::vector<int> result;
      for (const int column : matrix.columns)
        result.push_back(all[columns.LID(column)]);
      return result;
    }

    /// Does owned node i, whose row begins with @p columns and @p values, couple
    /// with another one?
    bool
    couples(const NodalMatrix &matrix,
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

  NodalMatrix
  select(const NodalMatrix       &matrix,
         const std::vector<bool> &active,
         const Epetra_Comm       &comm)
  {
    const unsigned int n     = matrix.n_components;
    const Epetra_Map   nodes = nodes_of(matrix, comm);
    Epetra_IntVector   owned(nodes); // bits of the components that are active
    for (unsigned int i = 0; i < matrix.entries.size(); ++i)
      if (matrix.entries[i] >= 0 && active[matrix.entries[i]])
        owned[static_cast<int>(i / n)] |= 1 << i % n;
    const std::vector<int> bits = by_column(matrix, owned);
    NodalMatrix            result;
    result.n_components  = n;
    result.entries       = matrix.entries;
    const double *values = matrix.values.data();
    std::size_t   column = 0; // first of the node
    for (unsigned int i = 0; i < matrix.size(); ++i)
      {
        const unsigned int length = matrix.lengths[i];
        const int          self   = nodes.GID(static_cast<int>(i));
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

  NodalMatrix
  take_coupled(const NodalMatrix                   &matrix,
               const Epetra_Comm                   &comm,
               std::vector<std::pair<int, double>> &lone)
  {
    const unsigned int n     = matrix.n_components;
    const Epetra_Map   nodes = nodes_of(matrix, comm);
    Epetra_IntVector   number(nodes); // among those that couple; -1: does not
    int                mine = 0, behind = 0;
    const int         *columns = matrix.columns.data();
    const double      *values  = matrix.values.data();
    for (unsigned int i = 0; i < matrix.size(); ++i)
      {
        const int self = nodes.GID(static_cast<int>(i));
        number[i] = couples(matrix, i, self, columns, values) ? mine++ : -1;
        for (unsigned int c = 0; c < n && number[i] < 0; ++c)
          if (matrix.entries[i * n + c] >= 0)
            for (unsigned int k = 0; k < matrix.lengths[i]; ++k)
              if (columns[k] == self)
                lone.emplace_back(
                  matrix.entries[i * n + c],
                  values[(matrix.variants[i] == 1 ? 0 : c * matrix.lengths[i]) +
                         k]);
        columns += matrix.lengths[i];
        values += std::size_t(matrix.lengths[i]) * matrix.variants[i];
      }
    comm.ScanSum(&mine, &behind, 1);
    for (unsigned int i = 0; i < matrix.size(); ++i)
      if (number[i] >= 0)
        number[i] += behind - mine;
    const std::vector<int> numbers = by_column(matrix, number);

    NodalMatrix result;
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

  std::unique_ptr<Epetra_CrsMatrix>
  as_matrix(const NodalMatrix &rows, const Epetra_Comm &comm)
  {
    const int           n_components = rows.n_components;
    const Epetra_Map    map(-1,
                         static_cast<int>(rows.size()) * n_components,
                         0,
                         comm);
    std::vector<int>    lengths, columns;
    std::vector<double> values;
    for (const unsigned int length : rows.lengths)
      lengths.insert(lengths.end(), n_components, static_cast<int>(length));
    auto matrix =
      std::make_unique<Epetra_CrsMatrix>(Copy, map, lengths.data(), true);
    const int    *from_column = rows.columns.data();
    const double *from_value  = rows.values.data();
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        const int length = static_cast<int>(rows.lengths[i]);
        for (int c = 0; c < n_components; ++c)
          {
            columns.clear();
            for (int k = 0; k < length; ++k)
              columns.push_back(from_column[k] * n_components + c);
            const double *variant =
              from_value + (rows.variants[i] == 1 ? 0 : c * length);
            values.assign(variant, variant + length);
            matrix->InsertGlobalValues(
              map.GID(static_cast<int>(i) * n_components + c),
              length,
              values.data(),
              columns.data());
          }
        from_column += length;
        from_value += std::size_t(length) * rows.variants[i];
      }
    matrix->FillComplete();
    return matrix;
  }
} // namespace mortise
