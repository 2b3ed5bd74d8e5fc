#include <Epetra_Import.h>
#include <Teuchos_BLAS.hpp>
#include <mortise/solvers/diagonal_lifting.h>
#include <mortise/solvers/epetra_tools.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Columns of B T B^T, in the numbering of those of @p transposed, by group
    /// of rows of B. @p group_of: groups of rows of @p transposed.
    std::vector<std::vector<int>>
    columns_of_square(const Epetra_CrsMatrix      &B,
                      const std::vector<RowGroup> &row_groups,
                      const Epetra_CrsMatrix      &transposed,
                      const std::vector<int>      &group_of)
    {
      std::vector<std::vector<int>> result(row_groups.size());
      std::vector<int>              mark(transposed.NumMyCols(), -1);
      for (unsigned int g = 0; g < row_groups.size(); ++g)
        {
          const EpetraRow row(B, row_groups[g].first);
          for (int k = 0, last = -1; k < row.length; ++k)
            if (const int h = group_of[row.columns[k]]; h != last)
              {
                last = h;
                const EpetraRow multipliers(transposed, row.columns[k]);
                for (int l = 0; l < multipliers.length; ++l)
                  if (int &m = mark[multipliers.columns[l]];
                      m != static_cast<int>(g))
                    {
                      m = g;
                      result[g].push_back(multipliers.columns[l]);
                    }
              }
          std::sort(result[g].begin(), result[g].end());
        }
      return result;
    }

    /// Whether the owned rows of @p B are the first columns of @p transposed.
    bool
    owned_columns_first(const Epetra_CrsMatrix &B,
                        const Epetra_CrsMatrix &transposed)
    {
      for (int i = 0; i < B.NumMyRows(); ++i)
        if (transposed.LCID(B.GRID(i)) != i)
          return false;
      return true;
    }

    /// B T B^T with the rows of B, by dense blocks. @p transposed: T B^T with
    /// one row for each column of B, in the order of these.
    SparseRows
    weighted_square(const Epetra_CrsMatrix &B,
                    const Epetra_CrsMatrix &transposed)
    {
      const auto row_groups    = group_rows(B),
                 column_groups = group_rows(transposed);
      std::vector<int> group_of(transposed.NumMyRows());
      for (unsigned int g = 0; g < column_groups.size(); ++g)
        for (int i = 0; i < column_groups[g].n_rows; ++i)
          group_of[column_groups[g].first + i] = g;
      const auto pattern =
        columns_of_square(B, row_groups, transposed, group_of);
      std::size_t              n_entries = 0;
      std::vector<std::size_t> begin_of(row_groups.size());
      std::vector<int>         row_group_of(B.NumMyRows());
      for (unsigned int g = 0; g < row_groups.size(); ++g)
        {
          begin_of[g] = n_entries;
          n_entries += pattern[g].size() * row_groups[g].n_rows;
          for (int i = 0; i < row_groups[g].n_rows; ++i)
            row_group_of[row_groups[g].first + i] = g;
        }
      // what is left of the diagonal has been computed right of it
      const bool is_mirrored = owned_columns_first(B, transposed);

      SparseRows result;
      result.columns.reserve(n_entries);
      result.values.resize(n_entries);
      const Teuchos::BLAS<int, double> blas;
      std::vector<double>              product;
      std::vector<int>                 place(transposed.NumMyCols()), global;
      for (unsigned int g = 0; g < row_groups.size(); ++g)
        {
          const auto &group = row_groups[g];
          const int   n = group.n_rows, m = pattern[g].size();
          double     *sums  = &result.values[begin_of[g]];
          const int   first = is_mirrored ? group.first : 0;
          global.clear();
          for (int l = 0; l < m; ++l)
            {
              place[pattern[g][l]] = l;
              global.push_back(transposed.GCID(pattern[g][l]));
            }
          result.lengths.insert(result.lengths.end(), n, m);
          for (int i = 0; i < n; ++i)
            result.columns.insert(result.columns.end(),
                                  global.begin(),
                                  global.end());
          const EpetraRow row(B, group.first);
          for (int k = 0; k < row.length;)
            {
              // these columns of the rows are one group; rows of a group are
              // stored one after the other
              const int       h     = group_of[row.columns[k]];
              const int       begin = k;
              const EpetraRow multipliers(transposed, row.columns[k]);
              while (k < row.length && group_of[row.columns[k]] == h &&
                     row.columns[k] - row.columns[begin] == k - begin)
                ++k;
              // columns of a row are sorted
              const int skipped =
                std::lower_bound(multipliers.columns,
                                 multipliers.columns + multipliers.length,
                                 first) -
                multipliers.columns;
              const int length = multipliers.length - skipped;
              if (length == 0)
                continue;
              product.resize(std::size_t(n) * length);
              blas.GEMM(Teuchos::NO_TRANS,
                        Teuchos::NO_TRANS,
                        length,
                        n,
                        k - begin,
                        1.,
                        multipliers.values + skipped,
                        multipliers.length,
                        row.values + begin,
                        row.length,
                        0.,
                        product.data(),
                        length);
              for (int i = 0; i < n; ++i)
                for (int l = 0; l < length; ++l)
                  sums[std::size_t(i) * m +
                       place[multipliers.columns[skipped + l]]] +=
                    product[std::size_t(i) * length + l];
            }
          for (int l = 0; l < m && pattern[g][l] < first;)
            {
              // rows of a group have the same columns, so all or none of them
              const int h   = row_group_of[pattern[g][l]];
              const int n_h = row_groups[h].n_rows, m_h = pattern[h].size();
              const int at = std::lower_bound(pattern[h].begin(),
                                              pattern[h].end(),
                                              group.first) -
                             pattern[h].begin();
              const double *from = &result.values[begin_of[h]] + at;
              for (int i = 0; i < n; ++i)
                for (int k = 0; k < n_h; ++k)
                  sums[std::size_t(i) * m + l + k] =
                    from[std::size_t(k) * m_h + i];
              l += n_h;
            }
        }
      return result;
    }
  } // namespace

  DiagonalLifting::DiagonalLifting(const BlockSystem &system)
    : weights(system.nodal->diagonal())
  {
    for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
      weights.local_element(i) = 1. / weights.local_element(i);

    // T B^T, whose rows a rank needs for all columns of its B
    const auto       &coupling = system.coupling.trilinos_matrix();
    const bool        one_rank = coupling.Comm().NumProc() == 1;
    const Epetra_Map &owned =
      one_rank ? coupling.ColMap() : coupling.DomainMap();
    const auto    scaled = transpose(coupling, owned);
    Epetra_Vector scale(owned);
    for (int i = 0; i < scale.MyLength(); ++i)
      scale[i] = weights.local_element(coupling.DomainMap().LID(owned.GID(i)));
    scaled->LeftScale(scale);
    if (one_rank)
      {
        factorise(weighted_square(coupling, *scaled), coupling.RowMap());
        return;
      }
    Epetra_CrsMatrix on_columns(Copy, coupling.ColMap(), 0);
    on_columns.Import(*scaled, Epetra_Import(coupling.ColMap(), owned), Insert);
    on_columns.FillComplete(coupling.RangeMap(), owned);
    factorise(weighted_square(coupling, on_columns), coupling.RowMap());
  }

  void
  DiagonalLifting::vmult(Vector &dst, const Vector &src) const
  {
    const double *from = src.begin();
    double       *to   = dst.begin();
    for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
      to[i] = weights.local_element(i) * from[i];
  }
} // namespace mortise
