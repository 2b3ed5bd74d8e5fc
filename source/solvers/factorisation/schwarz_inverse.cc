// See schwarz_inverse.h.
#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <mortise/solvers/factorisation/schwarz_inverse.h>
#include <mortise/solvers/pseudo_random.h>

#include <algorithm>
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

    /// Owned nodes and those of others in the columns of @p rows. Collective.
    Utilities::MPI::Partitioner
    nodes_of(const RowsByNode &rows, const MPI_Comm comm)
    {
      const IndexSet   owned = owned_range(rows.size(), comm);
      std::vector<int> columns(rows.columns);
      std::sort(columns.begin(), columns.end());
      IndexSet relevant(owned.size());
      relevant.add_indices(columns.begin(),
                           std::unique(columns.begin(), columns.end()));
      return {owned, relevant, comm};
    }

    /// Appends rows to @p to, with columns that are local to @p nodes.
    class RowCollector
    {
    public:
      RowCollector(RowsByNode &to, const Utilities::MPI::Partitioner &nodes)
        : to(to)
        , nodes(nodes)
      {}

      void
      add(const int          length,
          const unsigned int variants,
          const int         *columns,
          const double      *values)
      {
        kept.clear();
        for (int k = 0; k < length; ++k)
          if (nodes.in_local_range(columns[k]) ||
              nodes.is_ghost_entry(columns[k]))
            {
              kept.push_back(k);
              to.columns.push_back(
                static_cast<int>(nodes.global_to_local(columns[k])));
            }
        to.lengths.push_back(kept.size());
        to.variants.push_back(variants);
        for (unsigned int v = 0; v < variants; ++v)
          for (const int k : kept)
            to.values.push_back(values[v * length + k]);
      }

    private:
      RowsByNode                        &to;
      const Utilities::MPI::Partitioner &nodes;
      std::vector<int>                   kept;
    };

    /// The rows of @p nodes, local.
    RowPackage
    pack(const RowsByNode               &rows,
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

    /// Submatrix of owned nodes and ghosts, in this order. Collective.
    RowsByNode
    overlapping_rows(const RowsByNode                  &rows,
                     const Utilities::MPI::Partitioner &nodes)
    {
      const MPI_Comm comm  = nodes.get_mpi_communicator();
      const int      n     = static_cast<int>(rows.size());
      const auto    &local = nodes.local_range();
      std::map<unsigned int, std::vector<int>> wanted;
      unsigned int                             ghost = 0;
      for (const auto &[rank, n_ghosts] : nodes.ghost_targets())
        for (unsigned int k = 0; k < n_ghosts; ++k)
          wanted[rank].push_back(
            static_cast<int>(nodes.ghost_indices().nth_index_in_set(ghost++)));

      std::vector<std::size_t> first_column(n + 1), first_value(n + 1);
      for (int i = 0; i < n; ++i)
        {
          first_column[i + 1] = first_column[i] + rows.lengths[i];
          first_value[i + 1] =
            first_value[i] + std::size_t(rows.lengths[i]) * rows.variants[i];
        }
      std::map<unsigned int, RowPackage> packages;
      for (auto &[rank, asked] : Utilities::MPI::some_to_some(comm, wanted))
        {
          for (int &node : asked)
            node -= static_cast<int>(local.first);
          packages[rank] = pack(rows, asked, first_column, first_value);
        }

      RowsByNode result;
      result.n_components = rows.n_components;
      RowCollector collector(result, nodes);
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
      result.entries.resize(result.size() * result.n_components);
      std::iota(result.entries.begin(), result.entries.end(), 0);
      return result;
    }
  } // namespace

  bool
  SchwarzInverse::initialize(const RowsByNode &rows,
                             Product           matrix_product,
                             const Vector     &zero)
  {
    entries              = rows.entries;
    product              = std::move(matrix_product);
    const MPI_Comm comm  = zero.get_mpi_communicator();
    const auto     nodes = nodes_of(rows, comm);
    nodal.reinit(by_component(nodes.locally_owned_range(), rows.n_components),
                 by_component(nodes.ghost_indices(), rows.n_components),
                 comm);
    RowsByNode overlapping = overlapping_rows(rows, nodes);
    local_x.resize(overlapping.entries.size());
    for (Vector *vector : {&r, &z, &q})
      vector->reinit(zero);
    const bool positive =
      local.initialize(std::move(overlapping), MPI_COMM_SELF);
    return Utilities::MPI::min(positive ? 1 : 0, comm) == 1 && count_solves();
  }

  bool
  SchwarzInverse::count_solves()
  {
    Vector x(r);
    for (const auto i : x.locally_owned_elements())
      x(i) = pseudo_random(i);
    product(r, x); // of the matrix's scale
    double first = 0.;
    for (n_solves = 0; n_solves < max_solves; ++n_solves)
      {
        solve_local(z, r);
        const double norm = z.l2_norm();
        if (n_solves == 0)
          first = norm;
        if (norm <= tolerance * first)
          {
            n_solves = std::max(n_solves, 1U);
            return true;
          }
        product(q, z);
        r -= q;
      }
    return false;
  }

  void
  SchwarzInverse::solve_local(Vector &to, const Vector &from) const
  {
    nodal.zero_out_ghost_values();
    for (unsigned int i = 0; i < entries.size(); ++i)
      nodal.local_element(i) =
        entries[i] < 0 ? 0. : from.local_element(entries[i]);
    nodal.update_ghost_values();
    local.solve(local_x.data(), nodal.begin());
    for (unsigned int i = 0; i < entries.size(); ++i)
      if (entries[i] >= 0)
        to.local_element(entries[i]) = local_x[i];
  }

  void
  SchwarzInverse::solve(Vector &x, const Vector &b) const
  {
    r = b;
    solve_local(x, r);
    for (unsigned int k = 1; k < n_solves; ++k)
      {
        product(q, k == 1 ? x : z);
        r -= q;
        solve_local(z, r);
        x += z;
      }
  }
} // namespace mortise
