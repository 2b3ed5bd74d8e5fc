// See block_smoother.h.
#include <mortise/solvers/block_smoother.h>
#include <mortise/solvers/epetra_tools.h>

#include <Epetra_SerialComm.h>
#include <Teuchos_LAPACK.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace mortise
{
  bool
  BlockSmoother::initialize(const Epetra_CrsMatrix                                          &global,
                            const std::vector<std::vector<dealii::types::global_dof_index>> &block_rows)
  {
    blocks.clear();
    matrix = &global;
    if (global.Comm().NumProc() > 1)
      create_local_matrix(global, block_rows);
    const Epetra_Map &map = local_map ? *local_map : global.RowMap();

    Teuchos::LAPACK<int, double> lapack;
    std::vector<int>             position(matrix->NumMyCols(), -1);
    bool                         valid   = true;
    std::size_t                  largest = 0;
    for (const auto &rows : block_rows)
      {
        Block block;
        for (const auto row : rows)
          block.rows.push_back(map.LID(static_cast<int>(row)));
        const int n = static_cast<int>(rows.size());
        largest     = std::max(largest, rows.size());
        block.cholesky.assign(n * n, 0.);
        for (int i = 0; i < n; ++i)
          position[block.rows[i]] = i;
        for (int i = 0; i < n; ++i)
          {
            const EpetraRow row(*matrix, block.rows[i]);
            for (int k = 0; k < row.length; ++k)
              if (const int j = position[row.columns[k]]; j >= 0)
                block.cholesky[i + j * n] = row.values[k];
          }
        for (int i = 0; i < n; ++i)
          position[block.rows[i]] = -1;
        int info = 0;
        lapack.POTRF('L', n, block.cholesky.data(), n, &info);
        valid = valid && info == 0;
        blocks.push_back(std::move(block));
      }
    workspace.resize(largest);
    return valid;
  }

  void
  BlockSmoother::create_local_matrix(
    const Epetra_CrsMatrix                                          &global,
    const std::vector<std::vector<dealii::types::global_dof_index>> &block_rows)
  {
    // Owned rows first, then those of other ranks that occur in the blocks.
    std::vector<int> rows(global.RowMap().MyGlobalElements(),
                          global.RowMap().MyGlobalElements() + global.NumMyRows());
    std::set<int>    foreign;
    for (const auto &block : block_rows)
      for (const auto row : block)
        if (!global.RowMap().MyGID(static_cast<int>(row)))
          foreign.insert(static_cast<int>(row));
    rows.insert(rows.end(), foreign.begin(), foreign.end());
    local_map =
      std::make_unique<Epetra_Map>(-1, static_cast<int>(rows.size()), rows.data(), 0, global.Comm());
    importer = std::make_unique<Epetra_Import>(*local_map, global.RowMap());
    x_local  = std::make_unique<Epetra_Vector>(*local_map);
    r_local  = std::make_unique<Epetra_Vector>(*local_map);

    // Each row's weight is one over the root of the number of ranks that hold it.
    Epetra_Vector count(global.RowMap());
    weight = std::make_unique<Epetra_Vector>(*local_map);
    weight->PutScalar(1.);
    count.Export(*weight, *importer, Add);
    weight->Import(count, *importer, Insert);
    for (int i = 0; i < weight->MyLength(); ++i)
      (*weight)[i] = 1. / std::sqrt((*weight)[i]);

    Epetra_CrsMatrix overlapping(Copy, *local_map, 0);
    overlapping.Import(global, *importer, Insert);
    overlapping.FillComplete(global.DomainMap(), global.RangeMap());

    // The square part of it, as a matrix of this rank alone.
    const Epetra_SerialComm self;
    const int               n = static_cast<int>(rows.size());
    const Epetra_Map        own_map(n, 0, self);
    local_matrix = std::make_unique<Epetra_CrsMatrix>(Copy, own_map, own_map, 0);
    std::vector<int>    columns;
    std::vector<double> values;
    for (int i = 0; i < n; ++i)
      {
        const EpetraRow row(overlapping, i);
        columns.clear();
        values.clear();
        for (int k = 0; k < row.length; ++k)
          if (const int column = local_map->LID(overlapping.ColMap().GID(row.columns[k])); column >= 0)
            {
              columns.push_back(column);
              values.push_back(row.values[k]);
            }
        local_matrix->InsertMyValues(i, static_cast<int>(columns.size()), values.data(), columns.data());
      }
    local_matrix->FillComplete();
    local_matrix->OptimizeStorage();
    matrix = local_matrix.get();
  }

  void
  BlockSmoother::relax(const Block &block, double *x, const double *r) const
  {
    const int n = static_cast<int>(block.rows.size());
    for (int i = 0; i < n; ++i)
      {
        const EpetraRow row(*matrix, block.rows[i]);
        double          sum = r[block.rows[i]];
        for (int k = 0; k < row.length; ++k)
          sum -= row.values[k] * x[row.columns[k]];
        workspace[i] = sum;
      }
    Teuchos::LAPACK<int, double> lapack;
    int                          info = 0;
    lapack.POTRS('L', n, 1, block.cholesky.data(), n, workspace.data(), n, &info);
    for (int i = 0; i < n; ++i)
      x[block.rows[i]] += workspace[i];
  }

  void
  BlockSmoother::sweep(double *x, const double *r) const
  {
    std::fill(x, x + matrix->NumMyRows(), 0.);
    for (const auto &block : blocks)
      relax(block, x, r);
    for (auto block = blocks.rbegin(); block != blocks.rend(); ++block)
      relax(*block, x, r);
  }

  void
  BlockSmoother::vmult(Epetra_Vector &x, const Epetra_Vector &r) const
  {
    if (!importer)
      {
        sweep(x.Values(), r.Values());
        return;
      }
    r_local->Import(r, *importer, Insert);
    r_local->Multiply(1., *weight, *r_local, 0.);
    sweep(x_local->Values(), r_local->Values());
    x_local->Multiply(1., *weight, *x_local, 0.);
    x.PutScalar(0.);
    x.Export(*x_local, *importer, Add);
  }
} // namespace mortise
