// See interior_condensation.h.
#include <mortise/solvers/interior_condensation.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <Epetra_IntVector.h>
#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>

#include <algorithm>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    struct Row
    {
      int     length  = 0;
      int    *columns = nullptr;
      double *values  = nullptr;

      Row(const Epetra_CrsMatrix &matrix, const int row)
      {
        matrix.ExtractMyRowView(row, length, values, columns);
      }
    };

    /// One integer per owned row, also on the columns of the matrix.
    std::vector<int>
    on_columns(const Epetra_CrsMatrix &matrix, const std::vector<int> &owned)
    {
      Epetra_IntVector source(matrix.DomainMap()), target(matrix.ColMap());
      std::copy(owned.begin(), owned.end(), source.Values());
      if (matrix.Importer() != nullptr)
        target.Import(source, *matrix.Importer(), Insert);
      else
        std::copy(owned.begin(), owned.end(), target.Values());
      return std::vector<int>(target.Values(), target.Values() + target.MyLength());
    }

    /// The matrices whose sum is A.
    std::vector<const Epetra_CrsMatrix *>
    summands(const BlockSystem &system)
    {
      std::vector<const Epetra_CrsMatrix *> result{&system.stiffness.trilinos_matrix()};
      if (system.owned_multiplier.size() > 0)
        result.push_back(&system.jump_penalty.trilinos_matrix());
      return result;
    }

    /// Block (a number of the whole scene) of each owned dof.
    std::vector<int>
    block_of_dofs(const BlockSystem &system, const int first_block)
    {
      const auto       first = *system.owned_displacement.begin();
      std::vector<int> block(system.owned_displacement.n_elements(), -1);
      for (unsigned int b = 0; b < system.entity_blocks.size(); ++b)
        for (const auto i : system.entity_blocks[b])
          block[i - first] = first_block + b;
      return block;
    }
  } // namespace

  InteriorCondensation::InteriorCondensation(const BlockSystem &system)
  {
    find_interiors(system);
    build_base(system);
    eliminate(system);
  }

  void
  InteriorCondensation::find_interiors(const BlockSystem &system)
  {
    const auto         counts = Utilities::MPI::all_gather(system.communicator,
                                                   static_cast<int>(system.entity_blocks.size()));
    const unsigned int rank   = Utilities::MPI::this_mpi_process(system.communicator);
    const int          first_block = std::accumulate(counts.begin(), counts.begin() + rank, 0);
    const auto first = system.owned_displacement.n_elements() > 0 ? *system.owned_displacement.begin() :
                                                                    0;
    const std::vector<int> owned_block =
      system.owned_displacement.n_elements() > 0 ? block_of_dofs(system, first_block) :
                                                   std::vector<int>();

    // The graph of the blocks.
    const int                     n_blocks = system.entity_blocks.size();
    std::vector<std::vector<int>> neighbors(n_blocks);
    for (const auto *matrix : summands(system))
      {
        const std::vector<int> column_block = on_columns(*matrix, owned_block);
        std::vector<int>       last_seen; // per block: found for which block of ours
        std::map<int, int>     seen;
        for (int b = 0; b < n_blocks; ++b)
          {
            auto &list = neighbors[b];
            for (const auto i : system.entity_blocks[b])
              {
                const Row row(*matrix, static_cast<int>(i - first));
                int       previous = -1;
                for (int k = 0; k < row.length; ++k)
                  if (const int other = column_block[row.columns[k]]; other != previous)
                    {
                      list.push_back(other);
                      previous = other;
                    }
              }
            std::sort(list.begin(), list.end());
            list.erase(std::unique(list.begin(), list.end()), list.end());
          }
      }

    if (getenv("STAR")) stars.assign(n_blocks, {});
    for (int b = 0; b < n_blocks && getenv("STAR"); ++b)
      for (const int o : neighbors[b])
        if (o >= first_block && o < first_block + n_blocks &&
            std::includes(neighbors[b].begin(), neighbors[b].end(), neighbors[o - first_block].begin(), neighbors[o - first_block].end()))
          stars[b].push_back(o - first_block);
    // Blocks whose neighbours are a clique; of neighbours among them, the larger.
    std::vector<bool> is_vertex(n_blocks, false);
    for (const auto i : system.vertex_dofs)
      is_vertex[owned_block[i - first] - first_block] = true;
    std::vector<int> candidate(owned_block.size(), 0);
    block_is_interior.assign(n_blocks, false);
    for (int b = 0; b < n_blocks; ++b)
      {
        bool clique = !is_vertex[b];
        for (const int other : neighbors[b])
          {
            const int local = other - first_block;
            if (!clique)
              break;
            if (local >= 0 && local < n_blocks && local != b)
              clique = std::includes(neighbors[local].begin(),
                                     neighbors[local].end(),
                                     neighbors[b].begin(),
                                     neighbors[b].end());
          }
        block_is_interior[b] = clique;
        if (clique)
          for (const auto i : system.entity_blocks[b])
            candidate[i - first] = system.entity_blocks[b].size();
      }
    const std::vector<bool> is_candidate = block_is_interior;
    for (const auto *matrix : summands(system))
      {
        const std::vector<int> column_block     = on_columns(*matrix, owned_block);
        const std::vector<int> column_candidate = on_columns(*matrix, candidate);
        for (int b = 0; b < n_blocks; ++b)
          if (is_candidate[b])
            for (const auto i : system.entity_blocks[b])
              {
                const Row row(*matrix, static_cast<int>(i - first));
                const int size = system.entity_blocks[b].size();
                for (int k = 0; k < row.length; ++k)
                  {
                    const int other = column_block[row.columns[k]];
                    const int other_size = column_candidate[row.columns[k]];
                    if (other != first_block + b &&
                        (other_size > size || (other_size == size && other < first_block + b)))
                      block_is_interior[b] = false;
                  }
              }
      }
  }

  void
  InteriorCondensation::build_base(const BlockSystem &system)
  {
    const auto &k_matrix = system.stiffness.trilinos_matrix();
    const int   n        = k_matrix.NumMyRows();
    const auto  first    = n > 0 ? *system.owned_displacement.begin() : 0;

    std::vector<int> remains(n, 1);
    for (unsigned int b = 0; b < system.entity_blocks.size(); ++b)
      if (block_is_interior[b])
        for (const auto i : system.entity_blocks[b])
          remains[i - first] = 0;
    std::vector<int> position(n, -1), global;
    for (int i = 0; i < n; ++i)
      if (remains[i] == 1)
        {
          position[i] = remaining_dofs.size();
          remaining_dofs.push_back(i);
          global.push_back(static_cast<int>(first) + i);
        }
    for (unsigned int b = 0; b < system.entity_blocks.size(); ++b)
      if (!block_is_interior[b])
        {
          blocks_of_schur.emplace_back();
          for (const auto i : system.entity_blocks[b])
            blocks_of_schur.back().push_back(position[i - first]);
        }

    if (!stars.empty())
      {
        const int mode = atoi(getenv("STAR"));
        std::vector<bool> is_vertex(stars.size(), false);
        std::vector<int> own(n);
        for (unsigned int b = 0; b < system.entity_blocks.size(); ++b) for (auto i : system.entity_blocks[b]) own[i - first] = b;
        for (auto i : system.vertex_dofs) is_vertex[own[i - first]] = true;
        blocks_of_schur.clear();
        for (unsigned int b = 0; b < stars.size(); ++b)
          {
            if (block_is_interior[b]) continue;
            std::vector<int> rows;
            if (mode == 2 && !is_vertex[b]) continue;
            if (mode == 1 && is_vertex[b]) { for (auto i : system.entity_blocks[b]) rows.push_back(position[i - first]); }
            else for (int o : stars[b]) if (!block_is_interior[o]) for (auto i : system.entity_blocks[o]) rows.push_back(position[i - first]);
            blocks_of_schur.push_back(rows);
          }
        if (mode == 1) { // drop blocks contained in the star of another
          std::vector<bool> covered(stars.size(), false);
          for (unsigned int b = 0; b < stars.size(); ++b) if (!is_vertex[b]&&!block_is_interior[b]) for (int o : stars[b]) if (o != (int)b && !(std::find(stars[o].begin(),stars[o].end(),(int)b)!=stars[o].end() && o > (int)b)) covered[o] = true;
          std::vector<std::vector<int>> keep; unsigned k = 0;
          for (unsigned int b = 0; b < stars.size(); ++b) if (!block_is_interior[b]) { if (!covered[b]) keep.push_back(blocks_of_schur[k]); ++k; }
          blocks_of_schur = keep; }
        size_t mx = 0; double sq = 0; for (auto &b : blocks_of_schur) { mx = std::max(mx, b.size()); sq += 1. * b.size() * b.size(); }
        printf("stars %zu, largest %zu, dense entries %.3g\n", blocks_of_schur.size(), mx, sq);
      }
    const Epetra_Map map(-1, static_cast<int>(global.size()), global.data(), 0, k_matrix.Comm());
    std::vector<std::vector<int>> column_remains;
    for (const auto *matrix : summands(system))
      column_remains.push_back(on_columns(*matrix, remains));
    // Row by row K + J without the interiors.
    std::vector<int> lengths(global.size(), 0);
    const auto       visit = [&](auto &&action) {
      for (unsigned int row = 0; row < global.size(); ++row)
        {
          std::map<int, double>                  dummy;
          std::vector<std::pair<int, double>>    entries;
          unsigned int                           m = 0;
          for (const auto *matrix : summands(system))
            {
              const Row r(*matrix, remaining_dofs[row]);
              for (int k = 0; k < r.length; ++k)
                if (column_remains[m][r.columns[k]] == 1)
                  entries.emplace_back(matrix->ColMap().GID(r.columns[k]), r.values[k]);
              ++m;
            }
          std::sort(entries.begin(), entries.end());
          unsigned int end = 0;
          for (unsigned int k = 0; k < entries.size(); ++k)
            if (end > 0 && entries[end - 1].first == entries[k].first)
              entries[end - 1].second += entries[k].second;
            else
              entries[end++] = entries[k];
          entries.resize(end);
          action(row, entries);
        }
    };
    visit([&](const unsigned int row, const auto &entries) { lengths[row] = entries.size(); });
    schur = std::make_unique<Epetra_CrsMatrix>(Copy, map, lengths.data(), true);
    std::vector<int>    columns;
    std::vector<double> values;
    visit([&](const unsigned int row, const auto &entries) {
      columns.clear();
      values.clear();
      for (const auto &e : entries)
        {
          columns.push_back(e.first);
          values.push_back(e.second);
        }
      schur->InsertGlobalValues(global[row], columns.size(), values.data(), columns.data());
    });
    schur->FillComplete();
    schur->OptimizeStorage();
    ghosted = std::make_unique<Epetra_Vector>(schur->ColMap());
  }

  void
  InteriorCondensation::eliminate(const BlockSystem &system)
  {
    const auto &k_matrix = system.stiffness.trilinos_matrix();
    const auto  first = k_matrix.NumMyRows() > 0 ? *system.owned_displacement.begin() : 0;
    const auto &s_columns = schur->ColMap();
    const int   n_owned   = schur->NumMyRows();
    Teuchos::LAPACK<int, double> lapack;
    Teuchos::BLAS<int, double>   blas;

    std::map<unsigned int, std::vector<std::pair<std::vector<int>, std::vector<double>>>> to_send;
    const auto add_row = [&](const int row, const std::vector<int> &columns, const double *values) {
      const Row   r(*schur, row);
      int         k = 0;
      for (unsigned int j = 0; j < columns.size(); ++j)
        {
          while (k < r.length && r.columns[k] < columns[j])
            ++k;
          Assert(k < r.length && r.columns[k] == columns[j], ExcInternalError());
          if (k<r.length && r.columns[k]==columns[j]) r.values[k] += values[j];
        }
    };

    std::vector<double> a_ib, update;
    for (unsigned int b = 0; b < system.entity_blocks.size(); ++b)
      if (block_is_interior[b])
        {
          Interior interior;
          for (const auto i : system.entity_blocks[b])
            interior.dofs.push_back(static_cast<int>(i - first));
          const int n = interior.dofs.size();
          // Columns: own block, and the remaining neighbours sorted by their position in S.
          std::map<int, int> own;
          for (int i = 0; i < n; ++i)
            own[interior.dofs[i]] = i;
          std::vector<std::vector<std::pair<int, double>>> rows(n);
          std::vector<int> &                               nb = interior.neighbors;
          interior.cholesky.assign(n * n, 0.);
          for (int i = 0; i < n; ++i)
            {
              const Row row(k_matrix, interior.dofs[i]);
              for (int k = 0; k < row.length; ++k)
                {
                  const auto it = own.find(row.columns[k]);
                  if (it != own.end())
                    interior.cholesky[i + it->second * n] = row.values[k];
                  else if (row.values[k] != 0.)
                    rows[i].emplace_back(s_columns.LID(k_matrix.ColMap().GID(row.columns[k])),
                                         row.values[k]);
                }
              for (const auto &e : rows[i])
                nb.push_back(e.first);
              std::sort(nb.begin(), nb.end());
              nb.erase(std::unique(nb.begin(), nb.end()), nb.end());
            }
          const int m = nb.size();
          a_ib.assign(n * m, 0.); // column major, n x m
          for (int i = 0; i < n; ++i)
            for (const auto &e : rows[i])
              a_ib[i + n * (std::lower_bound(nb.begin(), nb.end(), e.first) - nb.begin())] = e.second;
          interior.extension = a_ib;
          int info           = 0;
          lapack.POTRF('L', n, interior.cholesky.data(), n, &info);
          AssertThrow(info == 0, ExcMessage("interior not positive definite"));
          if (m > 0)
            {
              lapack.POTRS('L', n, m, interior.cholesky.data(), n, interior.extension.data(), n, &info);
              update.resize(m * m);
              blas.GEMM(Teuchos::TRANS,
                        Teuchos::NO_TRANS,
                        m,
                        m,
                        n,
                        -1.,
                        a_ib.data(),
                        n,
                        interior.extension.data(),
                        n,
                        0.,
                        update.data(),
                        m);
            }
          for (int j = 0; j < m; ++j)
            if (nb[j] < n_owned)
              add_row(nb[j], nb, update.data() + j * m);
            else
              {
                std::vector<int> ids{s_columns.GID(nb[j])};
                for (const int c : nb)
                  ids.push_back(s_columns.GID(c));
                to_send[system.stiffness.trilinos_matrix().Comm().NumProc()]; // placeholder
                (void)ids;
              }
          interiors.push_back(std::move(interior));
        }
    // TODO exchange
  }

  void
  InteriorCondensation::restrict_residual(Epetra_Vector &r_b, const double *r) const
  {
    Teuchos::BLAS<int, double> blas;
    ghosted->PutScalar(0.);
    std::vector<double> r_i, y;
    for (const auto &interior : interiors)
      {
        const int n = interior.dofs.size(), m = interior.neighbors.size();
        if (m == 0)
          continue;
        r_i.resize(n);
        y.resize(m);
        for (int i = 0; i < n; ++i)
          r_i[i] = r[interior.dofs[i]];
        blas.GEMV(Teuchos::TRANS, n, m, -1., interior.extension.data(), n, r_i.data(), 1, 0., y.data(), 1);
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
    if (schur->Importer() != nullptr)
      ghosted->Import(x_b, *schur->Importer(), Insert);
    else
      std::copy(x_b.Values(), x_b.Values() + x_b.MyLength(), ghosted->Values());
    std::vector<double> x_i, y;
    for (const auto &interior : interiors)
      {
        const int n = interior.dofs.size(), m = interior.neighbors.size();
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
