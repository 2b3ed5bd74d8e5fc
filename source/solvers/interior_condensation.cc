// See interior_condensation.h.
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/interior_condensation.h>

#include <deal.II/base/mpi.h>

#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>

#include <algorithm>
#include <map>

namespace mortise
{
  using namespace dealii;

  InteriorCondensation::InteriorCondensation(const BlockSystem &system, const EntityGraph &graph)
  {
    const auto first = first_displacement(system);
    position.assign(system.owned_displacement.n_elements(), 0);
    for (unsigned int b = 0; b < system.entity_blocks.size(); ++b)
      if (graph.is_interior(b))
        for (const auto i : system.entity_blocks[b])
          position[i - first] = -1;
    for (unsigned int i = 0; i < position.size(); ++i)
      if (position[i] == 0)
        {
          position[i] = static_cast<int>(remaining_dofs.size());
          remaining_dofs.push_back(i);
        }
    build_base(system);
    eliminate(system, graph);
  }

  void
  InteriorCondensation::build_base(const BlockSystem &system)
  {
    const auto       first = static_cast<int>(first_displacement(system));
    std::vector<int> global;
    for (const int i : remaining_dofs)
      global.push_back(first + i);
    const auto      &k_matrix = system.stiffness.trilinos_matrix();
    const Epetra_Map map(-1, static_cast<int>(global.size()), global.data(), 0, k_matrix.Comm());

    const auto                    matrices = summands_of_bulk(system);
    std::vector<std::vector<int>> column_position;
    for (const auto *matrix : matrices)
      column_position.push_back(on_columns(*matrix, position));

    // Row by row of K + J, without the interiors.
    std::vector<std::pair<int, double>> entries;
    const auto                          collect = [&](const int dof) {
      entries.clear();
      for (unsigned int m = 0; m < matrices.size(); ++m)
        {
          const EpetraRow row(*matrices[m], dof);
          for (int k = 0; k < row.length; ++k)
            if (column_position[m][row.columns[k]] >= 0)
              entries.emplace_back(matrices[m]->ColMap().GID(row.columns[k]), row.values[k]);
        }
      std::sort(entries.begin(), entries.end(), [](const auto &a, const auto &b) {
        return a.first < b.first;
      });
      unsigned int end = 0;
      for (unsigned int k = 0; k < entries.size(); ++k)
        if (end > 0 && entries[end - 1].first == entries[k].first)
          entries[end - 1].second += entries[k].second;
        else
          entries[end++] = entries[k];
      entries.resize(end);
    };
    std::vector<int> lengths;
    for (const int dof : remaining_dofs)
      {
        collect(dof);
        lengths.push_back(static_cast<int>(entries.size()));
      }
    schur = std::make_unique<Epetra_CrsMatrix>(Copy, map, lengths.data(), true);
    std::vector<int>    columns;
    std::vector<double> values;
    for (unsigned int row = 0; row < global.size(); ++row)
      {
        collect(remaining_dofs[row]);
        columns.clear();
        values.clear();
        for (const auto &entry : entries)
          {
            columns.push_back(entry.first);
            values.push_back(entry.second);
          }
        schur->InsertGlobalValues(global[row],
                                  static_cast<int>(columns.size()),
                                  values.data(),
                                  columns.data());
      }
    schur->FillComplete();
    schur->OptimizeStorage();
    ghosted = std::make_unique<Epetra_Vector>(schur->ColMap());
  }

  InteriorCondensation::Interior
  InteriorCondensation::extract_interior(const BlockSystem &system, const unsigned int block) const
  {
    const auto      &k_matrix = system.stiffness.trilinos_matrix();
    const auto       first    = first_displacement(system);
    Interior         interior;
    std::map<int, int> own;
    for (const auto i : system.entity_blocks[block])
      {
        own[static_cast<int>(i - first)] = static_cast<int>(interior.dofs.size());
        interior.dofs.push_back(static_cast<int>(i - first));
      }
    const int n = static_cast<int>(interior.dofs.size());
    interior.cholesky.assign(n * n, 0.);

    std::map<int, int> column_of; // column of K -> column of S
    for (int i = 0; i < n; ++i)
      {
        const EpetraRow row(k_matrix, interior.dofs[i]);
        for (int k = 0; k < row.length; ++k)
          if (const auto it = own.find(row.columns[k]); it != own.end())
            interior.cholesky[i + it->second * n] = row.values[k];
          else if (row.values[k] != 0. && column_of.count(row.columns[k]) == 0)
            {
              const int column = schur->ColMap().LID(k_matrix.ColMap().GID(row.columns[k]));
              column_of[row.columns[k]] = column;
              interior.neighbors.push_back(column);
            }
      }
    std::sort(interior.neighbors.begin(), interior.neighbors.end());
    for (auto &entry : column_of)
      entry.second = static_cast<int>(std::lower_bound(interior.neighbors.begin(),
                                                       interior.neighbors.end(),
                                                       entry.second) -
                                      interior.neighbors.begin());
    interior.coupling.assign(n * interior.neighbors.size(), 0.);
    for (int i = 0; i < n; ++i)
      {
        const EpetraRow row(k_matrix, interior.dofs[i]);
        for (int k = 0; k < row.length; ++k)
          if (const auto it = column_of.find(row.columns[k]); it != column_of.end())
            interior.coupling[i + n * it->second] = row.values[k];
      }
    return interior;
  }

  void
  InteriorCondensation::add_to_row(const int row, const std::vector<int> &columns, const double *values)
  {
    const EpetraRow r(*schur, row);
    int             k = 0;
    for (unsigned int j = 0; j < columns.size(); ++j)
      {
        while (k < r.length && r.columns[k] < columns[j])
          ++k;
        Assert(k < r.length && r.columns[k] == columns[j], ExcInternalError());
        if (k < r.length && r.columns[k] == columns[j])
          r.values[k] += values[j];
      }
  }

  void
  InteriorCondensation::eliminate(const BlockSystem &system, const EntityGraph &graph)
  {
    Teuchos::LAPACK<int, double>                   lapack;
    Teuchos::BLAS<int, double>                     blas;
    std::map<unsigned int, std::vector<RemoteRow>> to_send;
    std::vector<int>                               owner(schur->NumMyCols());
    {
      const auto rank = static_cast<int>(Utilities::MPI::this_mpi_process(system.communicator));
      owner = on_columns(*schur, std::vector<int>(schur->NumMyRows(), rank));
    }
    std::vector<double> update;
    for (unsigned int b = 0; b < system.entity_blocks.size(); ++b)
      if (graph.is_interior(b))
        {
          Interior  interior = extract_interior(system, b);
          const int n        = static_cast<int>(interior.dofs.size());
          const int m        = static_cast<int>(interior.neighbors.size());
          int       info     = 0;
          lapack.POTRF('L', n, interior.cholesky.data(), n, &info);
          valid = valid && info == 0;
          if (info == 0 && m > 0)
            {
              auto &x = interior.extension;
              x       = interior.coupling;
              lapack.POTRS('L', n, m, interior.cholesky.data(), n, x.data(), n, &info);
              update.resize(m * m);
              // S_bb -= A_bi X
              blas.GEMM(Teuchos::TRANS, Teuchos::NO_TRANS, m, m, n, -1.,
                        interior.coupling.data(), n, x.data(), n, 0., update.data(), m);
            }
          for (int j = 0; info == 0 && j < m; ++j)
            if (interior.neighbors[j] < schur->NumMyRows())
              add_to_row(interior.neighbors[j], interior.neighbors, update.data() + j * m);
            else
              {
                RemoteRow row;
                row.columns.push_back(schur->ColMap().GID(interior.neighbors[j]));
                for (const int column : interior.neighbors)
                  row.columns.push_back(schur->ColMap().GID(column));
                row.values.assign(update.data() + j * m, update.data() + (j + 1) * m);
                to_send[owner[interior.neighbors[j]]].push_back(std::move(row));
              }
          std::vector<double>().swap(interior.coupling);
          if (info == 0)
            interiors.push_back(std::move(interior));
        }
    for (const auto &from : Utilities::MPI::some_to_some(system.communicator, to_send))
      for (const auto &row : from.second)
        {
          std::vector<std::pair<int, double>> entries;
          for (unsigned int j = 0; j < row.values.size(); ++j)
            entries.emplace_back(schur->ColMap().LID(row.columns[j + 1]), row.values[j]);
          std::sort(entries.begin(), entries.end());
          std::vector<int>    columns;
          std::vector<double> values;
          for (const auto &entry : entries)
            {
              columns.push_back(entry.first);
              values.push_back(entry.second);
            }
          add_to_row(schur->RowMap().LID(row.columns[0]), columns, values.data());
        }
    valid = Utilities::MPI::min(valid ? 1 : 0, system.communicator) == 1;
  }

  void
  InteriorCondensation::restrict_residual(Epetra_Vector &r_b, const double *r) const
  {
    Teuchos::BLAS<int, double> blas;
    std::vector<double>        r_i, y;
    ghosted->PutScalar(0.);
    for (const auto &interior : interiors)
      {
        const int n = static_cast<int>(interior.dofs.size());
        const int m = static_cast<int>(interior.neighbors.size());
        if (m == 0)
          continue;
        r_i.resize(n);
        y.resize(m);
        for (int i = 0; i < n; ++i)
          r_i[i] = r[interior.dofs[i]];
        blas.GEMV(
          Teuchos::TRANS, n, m, -1., interior.extension.data(), n, r_i.data(), 1, 0., y.data(), 1);
        for (int j = 0; j < m; ++j)
          (*ghosted)[interior.neighbors[j]] += y[j];
      }
    if (schur->Importer() != nullptr)
      {
        r_b.PutScalar(0.);
        r_b.Export(*ghosted, *schur->Importer(), Add);
      }
    else
      std::copy(ghosted->Values(), ghosted->Values() + r_b.MyLength(), r_b.Values());
    for (int i = 0; i < r_b.MyLength(); ++i)
      r_b[i] += r[remaining_dofs[i]];
  }

  void
  InteriorCondensation::extend_solution(double *x, const Epetra_Vector &x_b, const double *r) const
  {
    Teuchos::BLAS<int, double>   blas;
    Teuchos::LAPACK<int, double> lapack;
    std::vector<double>          x_i, y;
    if (schur->Importer() != nullptr)
      ghosted->Import(x_b, *schur->Importer(), Insert);
    else
      std::copy(x_b.Values(), x_b.Values() + x_b.MyLength(), ghosted->Values());
    for (const auto &interior : interiors)
      {
        const int n    = static_cast<int>(interior.dofs.size());
        const int m    = static_cast<int>(interior.neighbors.size());
        int       info = 0;
        x_i.resize(n);
        y.resize(m);
        for (int i = 0; i < n; ++i)
          x_i[i] = r[interior.dofs[i]];
        lapack.POTRS('L', n, 1, interior.cholesky.data(), n, x_i.data(), n, &info);
        for (int j = 0; j < m; ++j)
          y[j] = (*ghosted)[interior.neighbors[j]];
        if (m > 0)
          blas.GEMV(
            Teuchos::NO_TRANS, n, m, -1., interior.extension.data(), n, y.data(), 1, 1., x_i.data(), 1);
        for (int i = 0; i < n; ++i)
          x[interior.dofs[i]] = x_i[i];
      }
    for (int i = 0; i < x_b.MyLength(); ++i)
      x[remaining_dofs[i]] = x_b[i];
  }
} // namespace mortise
