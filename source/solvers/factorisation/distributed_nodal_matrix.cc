// See distributed_nodal_matrix.h.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/factorisation/distributed_nodal_matrix.h>

#include <algorithm>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  DistributedNodalMatrix::DistributedNodalMatrix(NodalMatrix    rows,
                                                 const MPI_Comm comm)
    : node_rows(std::move(rows))
  {
    const auto counts =
      Utilities::MPI::all_gather(comm, static_cast<int>(node_rows.size()));
    rank_starts.resize(counts.size() + 1);
    std::partial_sum(counts.begin(), counts.end(), rank_starts.begin() + 1);
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    first                   = rank_starts[rank];
    end                     = rank_starts[rank + 1];
    find_ghosts();
    const unsigned int n = node_rows.n_components;
    IndexSet owned(rank_starts.back() * n), relevant(rank_starts.back() * n);
    owned.add_range(first * n, end * n);
    for (const int node : ghost_nodes)
      relevant.add_range(node * n, (node + 1) * n);
    owned.compress();
    relevant.compress();
    nodal.reinit(owned, relevant, comm);
  }

  void
  DistributedNodalMatrix::find_ghosts()
  {
    for (const int node : node_rows.columns)
      if (!is_owned(node))
        ghost_nodes.push_back(node);
    std::sort(ghost_nodes.begin(), ghost_nodes.end());
    ghost_nodes.erase(std::unique(ghost_nodes.begin(), ghost_nodes.end()),
                      ghost_nodes.end());
  }

  int
  DistributedNodalMatrix::local(const int node) const
  {
    if (is_owned(node))
      return node - first;
    const auto ghost =
      std::lower_bound(ghost_nodes.begin(), ghost_nodes.end(), node);
    if (ghost == ghost_nodes.end() || *ghost != node)
      return -1;
    return end - first + static_cast<int>(ghost - ghost_nodes.begin());
  }

  const Vector &
  DistributedNodalMatrix::at_nodes(const Vector &x) const
  {
    const auto &entries = node_rows.entries;
    nodal.zero_out_ghost_values();
    for (unsigned int i = 0; i < entries.size(); ++i)
      nodal.local_element(i) =
        entries[i] < 0 ? 0. : x.local_element(entries[i]);
    nodal.update_ghost_values();
    return nodal;
  }

  void
  DistributedNodalMatrix::drop_rows()
  {
    NodalMatrix none;
    none.n_components = node_rows.n_components;
    none.entries      = std::move(node_rows.entries);
    node_rows         = std::move(none);
  }

  void
  DistributedNodalMatrix::vmult(Vector &y, const Vector &x) const
  {
    const unsigned int n      = node_rows.n_components;
    const double      *from   = at_nodes(x).begin();
    const int         *column = node_rows.columns.data();
    const double      *values = node_rows.values.data();
    std::vector<int>   indices; // of the columns of a row
    for (unsigned int i = 0; i < node_rows.size(); ++i)
      {
        const unsigned int length   = node_rows.lengths[i],
                           variants = node_rows.variants[i];
        indices.clear();
        for (unsigned int k = 0; k < length; ++k)
          indices.push_back(local(column[k]) * static_cast<int>(n));
        for (unsigned int c = 0; c < n; ++c)
          {
            const double *variant = values + (variants == 1 ? 0 : c * length);
            double        sum     = 0.;
            for (unsigned int k = 0; k < length; ++k)
              sum += variant[k] * from[indices[k] + c];
            if (const int entry = node_rows.entries[i * n + c]; entry >= 0)
              y.local_element(entry) = sum;
          }
        column += length;
        values += std::size_t(length) * variants;
      }
  }
} // namespace mortise
