// See schwarz_inverse.h.
#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <mortise/solvers/schwarz_inverse.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr double       tolerance  = 1e-6;
    constexpr unsigned int max_solves = 20;

    /// Lengths, variants and columns of rows, and their values.
    using RowPackage = std::pair<std::vector<int>, std::vector<double>>;

    /// Appends rows to @p to, with columns numbered by @p local, others left
    /// out.
    class RowCollector
    {
    public:
      RowCollector(NodeRows &to, const std::map<int, int> &local)
        : to(to)
        , local(local)
      {}

      void
      add(const int          length,
          const unsigned int variants,
          const int         *columns,
          const double      *values)
      {
        kept.clear();
        for (int k = 0; k < length; ++k)
          if (const auto known = local.find(columns[k]); known != local.end())
            {
              kept.push_back(k);
              to.columns.push_back(known->second);
            }
        to.lengths.push_back(kept.size());
        to.variants.push_back(variants);
        for (unsigned int v = 0; v < variants; ++v)
          for (const int k : kept)
            to.values.push_back(values[v * length + k]);
      }

    private:
      NodeRows                 &to;
      const std::map<int, int> &local;
      std::vector<int>          kept;
    };

    /// The rows of @p nodes, local.
    RowPackage
    pack(const NodeRows                 &rows,
         const std::vector<int>         &nodes,
         const std::vector<std::size_t> &first_column,
         const std::vector<std::size_t> &first_value)
    {
      RowPackage package;
      for (const int i : nodes)
        {
          const int length = static_cast<int>(rows.lengths[i]);
          package.first.push_back(length);
          package.first.push_back(static_cast<int>(rows.variants[i]));
          const int *columns = &rows.columns[first_column[i]];
          package.first.insert(package.first.end(), columns, columns + length);
          const double *values = &rows.values[first_value[i]];
          package.second.insert(package.second.end(),
                                values,
                                values + length * rows.variants[i]);
        }
      return package;
    }

    /// The square matrix of the owned nodes of @p rows and @p ghosts, sorted,
    /// numbered in this order. @p starts: first node by rank. Collective.
    NodeRows
    overlapping_matrix(const NodeRows         &rows,
                       const std::vector<int> &ghosts,
                       const std::vector<int> &starts,
                       const MPI_Comm          comm)
    {
      const int first = starts[Utilities::MPI::this_mpi_process(comm)],
                n     = static_cast<int>(rows.size());
      std::map<int, int> local;
      for (int i = 0; i < n; ++i)
        local.emplace_hint(local.end(), first + i, i);
      std::map<unsigned int, std::vector<int>> wanted;
      for (unsigned int g = 0; g < ghosts.size(); ++g)
        {
          local.emplace(ghosts[g], n + static_cast<int>(g));
          const auto rank =
            std::upper_bound(starts.begin(), starts.end(), ghosts[g]) -
            starts.begin() - 1;
          wanted[rank].push_back(ghosts[g] - starts[rank]);
        }

      std::vector<std::size_t> first_column(n + 1), first_value(n + 1);
      for (int i = 0; i < n; ++i)
        {
          first_column[i + 1] = first_column[i] + rows.lengths[i];
          first_value[i + 1] =
            first_value[i] + std::size_t(rows.lengths[i]) * rows.variants[i];
        }
      std::map<unsigned int, RowPackage> packages;
      for (const auto &[rank, nodes] :
           Utilities::MPI::some_to_some(comm, wanted))
        packages[rank] = pack(rows, nodes, first_column, first_value);

      NodeRows matrix;
      matrix.n_components = rows.n_components;
      RowCollector collector(matrix, local);
      for (int i = 0; i < n; ++i)
        collector.add(rows.lengths[i],
                      rows.variants[i],
                      &rows.columns[first_column[i]],
                      &rows.values[first_value[i]]);
      // ranks ascend, and so do the nodes of each
      for (const auto &[rank, package] :
           Utilities::MPI::some_to_some(comm, packages))
        {
          const int    *column = package.first.data();
          const double *value  = package.second.data();
          for (unsigned int k = 0; k < wanted[rank].size(); ++k)
            {
              const int length = column[0], variants = column[1];
              collector.add(length, variants, column + 2, value);
              column += 2 + length;
              value += length * variants;
            }
        }
      matrix.entries.resize(matrix.size() * matrix.n_components);
      std::iota(matrix.entries.begin(), matrix.entries.end(), 0);
      return matrix;
    }
  } // namespace

  bool
  SchwarzInverse::initialize(const NodeRows   &rows,
                             Product           matrix_product,
                             const Epetra_Map &map)
  {
    const MPI_Comm comm =
      dynamic_cast<const Epetra_MpiComm &>(map.Comm()).Comm();
    product = std::move(matrix_product);
    entries = rows.entries;
    const auto counts =
      Utilities::MPI::all_gather(comm, static_cast<int>(rows.size()));
    std::vector<int> starts(counts.size() + 1);
    std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    std::vector<int>   ghosts;
    for (const int node : rows.columns)
      if (node < starts[rank] || node >= starts[rank + 1])
        ghosts.push_back(node);
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());

    const unsigned int n_components = rows.n_components;
    IndexSet           owned(starts.back() * n_components),
      relevant(starts.back() * n_components);
    owned.add_range(starts[rank] * n_components,
                    starts[rank + 1] * n_components);
    for (const int node : ghosts)
      relevant.add_range(node * n_components, (node + 1) * n_components);
    owned.compress();
    relevant.compress();
    residual.reinit(owned, relevant, comm);
    correction.reinit(residual);

    const NodeRows overlapping = overlapping_matrix(rows, ghosts, starts, comm);
    const Epetra_Map local_map(static_cast<int>(overlapping.entries.size()),
                               0,
                               Epetra_MpiComm(MPI_COMM_SELF));
    local_residual =
      std::make_unique<Epetra_Vector>(View, local_map, residual.begin());
    local_correction =
      std::make_unique<Epetra_Vector>(View, local_map, correction.begin());
    for (auto *vector : {&r, &z, &q})
      *vector = std::make_unique<Epetra_Vector>(map);
    const bool positive = local.initialize(overlapping, MPI_COMM_SELF);
    if (Utilities::MPI::min(positive ? 1 : 0, comm) == 0)
      return false;

    return count_solves();
  }

  bool
  SchwarzInverse::count_solves()
  {
    Epetra_Vector x(*r);
    for (int i = 0; i < x.MyLength(); ++i)
      x[i] = (x.Map().GID(i) * 2654435761U) % 1000 / 500. - 1.;
    product(*r, x); // of the matrix's scale
    double first = 0., norm = 0.;
    for (n_solves = 0; n_solves < max_solves; ++n_solves)
      {
        solve_local(*z, *r);
        z->Norm2(&norm);
        if (n_solves == 0)
          first = norm;
        if (norm <= tolerance * first)
          {
            n_solves = std::max(n_solves, 1U);
            return true;
          }
        product(*q, *z);
        r->Update(-1., *q, 1.);
      }
    return false;
  }

  void
  SchwarzInverse::solve_local(Epetra_Vector       &to,
                              const Epetra_Vector &from) const
  {
    residual.zero_out_ghost_values();
    for (unsigned int i = 0; i < entries.size(); ++i)
      residual.local_element(i) = entries[i] < 0 ? 0. : from[entries[i]];
    residual.update_ghost_values();
    local.solve(*local_correction, *local_residual);
    for (unsigned int i = 0; i < entries.size(); ++i)
      if (entries[i] >= 0)
        to[entries[i]] = correction.local_element(i);
  }

  void
  SchwarzInverse::solve(Epetra_Vector &x, const Epetra_Vector &b) const
  {
    *r = b;
    solve_local(x, *r);
    for (unsigned int k = 1; k < n_solves; ++k)
      {
        product(*q, k == 1 ? x : *z);
        r->Update(-1., *q, 1.);
        solve_local(*z, *r);
        x.Update(1., *z, 1.);
      }
  }
} // namespace mortise
