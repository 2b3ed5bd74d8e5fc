// See block_smoother.h.
#include <Epetra_SerialComm.h>
#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/multigrid/block_smoother.h>

#include <algorithm>
#include <set>

namespace mortise
{
  bool
  BlockSmoother::initialize(
    const Epetra_CrsMatrix                                          &global,
    const std::vector<std::vector<dealii::types::global_dof_index>> &block_rows)
  {
    patches.clear();
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
        block.inverse.assign(n * n, 0.);
        for (int i = 0; i < n; ++i)
          position[block.rows[i]] = i;
        for (int i = 0; i < n; ++i)
          {
            const EpetraRow row(*matrix, block.rows[i]);
            for (int k = 0; k < row.length; ++k)
              if (const int j = position[row.columns[k]]; j >= 0)
                block.inverse[i + j * n] = row.values[k];
          }
        for (int i = 0; i < n; ++i)
          position[block.rows[i]] = -1;
        int info = 0;
        lapack.POTRF('L', n, block.inverse.data(), n, &info);
        // The inverse itself: a product streams it once, two triangular solves
        // wait at each row.
        if (info == 0)
          lapack.POTRI('L', n, block.inverse.data(), n, &info);
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < j; ++i)
            block.inverse[i + j * n] = block.inverse[j + i * n];
        valid = valid && info == 0;
        patches.push_back(std::move(block));
      }
    workspace.resize(2 * largest);
    if (to_local)
      find_damping();
    return valid;
  }

  void
  BlockSmoother::find_damping()
  {
    Epetra_Vector n_ranks(to_local->SourceMap());
    x_local->PutScalar(1.);
    n_ranks.Export(*x_local, *to_local, Add);
    double largest = 1.;
    n_ranks.MaxValue(&largest);
    damping = 1.1 / largest;
  }

  void
  BlockSmoother::create_local_matrix(
    const Epetra_CrsMatrix                                          &global,
    const std::vector<std::vector<dealii::types::global_dof_index>> &block_rows)
  {
    // Owned rows first, then those of other ranks that occur in the blocks.
    std::vector<int> rows(global.RowMap().MyGlobalElements(),
                          global.RowMap().MyGlobalElements() +
                            global.NumMyRows());
    std::set<int>    foreign;
    for (const auto &block : block_rows)
      for (const auto row : block)
        if (!global.RowMap().MyGID(static_cast<int>(row)))
          foreign.insert(static_cast<int>(row));
    rows.insert(rows.end(), foreign.begin(), foreign.end());
    local_map = std::make_unique<Epetra_Map>(
      -1, static_cast<int>(rows.size()), rows.data(), 0, global.Comm());
    to_local = std::make_unique<Epetra_Import>(*local_map, global.RowMap());
    x_local  = std::make_unique<Epetra_Vector>(*local_map);
    r_local  = std::make_unique<Epetra_Vector>(*local_map);

    Epetra_CrsMatrix overlapping(Copy, *local_map, 0);
    overlapping.Import(global, *to_local, Insert);
    overlapping.FillComplete(global.DomainMap(), global.RangeMap());

    // The square part of it, as a matrix of this rank alone.
    const Epetra_SerialComm self;
    const int               n = static_cast<int>(rows.size());
    const Epetra_Map        own_map(n, 0, self);
    local_matrix =
      std::make_unique<Epetra_CrsMatrix>(Copy, own_map, own_map, 0);
    std::vector<int>    columns;
    std::vector<double> values;
    for (int i = 0; i < n; ++i)
      {
        const EpetraRow row(overlapping, i);
        columns.clear();
        values.clear();
        for (int k = 0; k < row.length; ++k)
          if (const int column =
                local_map->LID(overlapping.ColMap().GID(row.columns[k]));
              column >= 0)
            {
              columns.push_back(column);
              values.push_back(row.values[k]);
            }
        local_matrix->InsertMyValues(i,
                                     static_cast<int>(columns.size()),
                                     values.data(),
                                     columns.data());
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
        // Four sums: a single one would wait for itself at each addition.
        double        a = r[block.rows[i]], b = 0., c = 0., d = 0.;
        const int    *j = row.columns;
        const double *v = row.values;
        int           k = 0;
        for (; k + 3 < row.length; k += 4)
          {
            a -= v[k] * x[j[k]];
            b -= v[k + 1] * x[j[k + 1]];
            c -= v[k + 2] * x[j[k + 2]];
            d -= v[k + 3] * x[j[k + 3]];
          }
        for (; k < row.length; ++k)
          a -= v[k] * x[j[k]];
        workspace[i] = (a + b) + (c + d);
      }
    add_solution(block, x);
  }

  void
  BlockSmoother::add_solution(const Block &block, double *x) const
  {
    const Teuchos::BLAS<int, double> blas;
    const int                        n = static_cast<int>(block.rows.size());
    double                          *y = workspace.data() + n;
    blas.GEMV(Teuchos::NO_TRANS,
              n,
              n,
              1.,
              block.inverse.data(),
              n,
              workspace.data(),
              1,
              0.,
              y,
              1);
    for (int i = 0; i < n; ++i)
      x[block.rows[i]] += y[i];
  }

  void
  BlockSmoother::sweep(double *x, const double *r, const Sweep direction) const
  {
    std::fill(x, x + matrix->NumMyRows(), 0.);
    if (direction == Sweep::forward)
      for (const auto &block : patches)
        relax(block, x, r);
    else
      for (auto block = patches.rbegin(); block != patches.rend(); ++block)
        relax(*block, x, r);
  }

  void
  BlockSmoother::solve_blocks(Epetra_Vector                   &x,
                              const Epetra_Vector             &r,
                              const std::vector<unsigned int> &selected) const
  {
    if (to_local)
      r_local->Import(r, *to_local, Insert);
    const double *source = to_local ? r_local->Values() : r.Values();
    double       *target = to_local ? x_local->Values() : x.Values();
    std::fill(target, target + matrix->NumMyRows(), 0.);
    for (const unsigned int b : selected)
      {
        const Block &block = patches[b];
        for (unsigned int i = 0; i < block.rows.size(); ++i)
          workspace[i] = source[block.rows[i]];
        add_solution(block, target);
      }
    if (to_local)
      {
        x.PutScalar(0.);
        x.Export(*x_local, *to_local, Add);
      }
  }

  void
  BlockSmoother::vmult(Epetra_Vector       &x,
                       const Epetra_Vector &r,
                       const Sweep          direction) const
  {
    if (!to_local)
      {
        sweep(x.Values(), r.Values(), direction);
        return;
      }
    r_local->Import(r, *to_local, Insert);
    sweep(x_local->Values(), r_local->Values(), direction);
    x.PutScalar(0.);
    x.Export(*x_local, *to_local, Add);
    x.Scale(damping);
  }
} // namespace mortise
