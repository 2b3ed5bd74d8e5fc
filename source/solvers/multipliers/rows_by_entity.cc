// See rows_by_entity.h.
#include <mortise/solvers/multipliers/rows_by_entity.h>

#include <algorithm>

namespace mortise
{
  namespace
  {
    /// Neighbouring owned rows with the same columns, as those of one entity of
    /// the mesh are.
    struct RowGroup
    {
      unsigned int first = 0, n_rows = 0;
    };

    /// All owned rows in such groups.
    std::vector<RowGroup>
    group_rows(const SparseMatrix &matrix)
    {
      std::vector<RowGroup> groups;
      for (unsigned int i = 0; i < matrix.n_rows(); ++i)
        {
          const auto row  = matrix.row(i);
          const auto fits = [&](const SparseMatrix::Row &first) {
            return std::equal(row.columns,
                              row.columns + row.length,
                              first.columns,
                              first.columns + first.length);
          };
          if (groups.empty() || !fits(matrix.row(groups.back().first)))
            groups.push_back({i, 0});
          ++groups.back().n_rows;
        }
      return groups;
    }

    std::vector<int>
    free_displacements(const CouplingMatrix &B)
    {
      const SparseMatrix &scalar = B.scalar();
      Vector              ones(scalar.owned_unknowns(), scalar.communicator());
      ones                              = 1.;
      const std::vector<double> is_free = B.on_columns(ones);
      std::vector<int>          result;
      for (unsigned int k = 0; k < scalar.n_columns(); ++k)
        for (unsigned int c = 0; c < dim; ++c)
          result.push_back(
            is_free[dim * k + c] == 0. ?
              -1 :
              static_cast<int>(dim * scalar.global_column(k) + c));
      return result;
    }

    using RowsOfComponents = std::array<int, dim>;

    /// Are @p rows those behind the last of @p shared?
    bool
    follow(const EntityRows &shared, const RowsOfComponents &rows)
    {
      for (unsigned int c = 0; c < dim; ++c)
        if (const int first = shared.first_row[c];
            rows[c] != (first < 0 ? -1 : first + shared.n_rows))
          return false;
      return true;
    }
  } // namespace

  RowsByEntity::RowsByEntity(const CouplingMatrix &B)
    : matrix(B)
    , displacements(free_displacements(B))
    , multipliers(B)
    , rows(multipliers.entities.size())
  {
    const SparseMatrix           &scalar = B.scalar();
    std::vector<RowsOfComponents> sharing(scalar.n_rows(), {{-1, -1, -1}});
    for (unsigned int i = 0; i < scalar.n_rows(); ++i)
      sharing[B.representative(i)][B.component(i)] = static_cast<int>(i);
    unsigned int e = 0;
    for (const RowGroup &group : group_rows(scalar))
      {
        EntityRows *shared = nullptr;
        for (unsigned int i = group.first; i < group.first + group.n_rows; ++i)
          {
            if (B.representative(i) != i)
              continue;
            while (static_cast<int>(i) >= multipliers.entities[e].first_row +
                                            multipliers.entities[e].n_rows)
              {
                ++e;
                shared = nullptr;
              }
            const auto row = scalar.row(i);
            if (shared == nullptr || !follow(*shared, sharing[i]))
              {
                shared             = &rows[e].emplace_back();
                shared->first_node = multipliers.node_of_row[i];
                shared->first_row  = sharing[i];
                shared->nodes.assign(row.columns, row.columns + row.length);
              }
            shared->values.insert(shared->values.end(),
                                  row.values,
                                  row.values + row.length);
            ++shared->n_rows;
          }
      }
  }
} // namespace mortise
