// See sparse_cholesky.h.
#include <deal.II/base/mpi.h>

#include <mortise/base/types.h>
#include <mortise/operators/matrix_free/tensor_kernel.h>
#include <mortise/solvers/factorisation/sparse_cholesky.h>
#include <mortise/solvers/register_blocks.h>

#include <cmath>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  double
  factorisation_work(const RowsByNode &rows, const MPI_Comm comm)
  {
    const GatheredRows all(rows, comm);
    double             sum = 0.;
    for (const Supernode &supernode : EliminationTree(all).supernodes)
      sum += supernode.width * std::pow(supernode.height(), 2);
    return sum;
  }

  template <typename Number, typename Work>
  bool
  SparseCholesky<Number, Work>::initialize(const RowsByNode &rows,
                                           const MPI_Comm    communicator)
  {
    comm = communicator;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &n_ranks);
    n_components = rows.n_components;
    entries      = rows.entries;
    counts = Utilities::MPI::all_gather(comm, static_cast<int>(entries.size()));
    const GatheredRows all(rows, comm);
    starts.assign(n_ranks + 1, 0);
    std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
    if (std::find(all.scale.begin(), all.scale.end(), 0.) != all.scale.end())
      return false;
    scale.assign(all.scale.begin() + starts[rank] / n_components,
                 all.scale.begin() + starts[rank + 1] / n_components);
    EliminationTree tree(all);
    supernodes  = std::move(tree.supernodes);
    permutation = std::move(tree.permutation);
    owner       = distribute_supernodes(supernodes, n_ranks);
    if (n_components == dim && n_ranks >= static_cast<int>(dim))
      common_component = rank % static_cast<int>(dim);
    list_parts();
    vector.resize(permutation.size() * n_components);
    exchange.resize(vector.size());
    unsigned int highest = 0;
    for (const Supernode &supernode : supernodes)
      highest = std::max(highest, supernode.height());
    workspace.resize(n_components * padded<Number>(highest));
    return factorise(all);
  }

  template <typename Number, typename Work>
  void
  SparseCholesky<Number, Work>::list_parts()
  {
    const unsigned int n = supernodes.size();
    part_counts.assign(n_ranks, 0);
    part_starts.assign(n_ranks + 1, 0);
    for (int r = 0; r < n_ranks; ++r)
      {
        for (unsigned int s = 0; s < n; ++s)
          if (owner[s] == r)
            for (unsigned int i = 0; i < supernodes[s].width; ++i)
              part_positions.push_back(supernodes[s].first + i);
        part_starts[r + 1] = part_positions.size() * n_components;
        part_counts[r]     = part_starts[r + 1] - part_starts[r];
      }
    for (unsigned int s = 0; s < n; ++s)
      if (owner[s] == rank)
        own.push_back(s);
      else if (owner[s] == on_all_ranks)
        {
          common.push_back(s);
          for (unsigned int i = 0; i < supernodes[s].width; ++i)
            common_indices.push_back(supernodes[s].first + i);
        }
  }

  template <typename Number, typename Work>
  template <unsigned int n>
  void
  SparseCholesky<Number, Work>::forward(const unsigned int s,
                                        const Number      *values,
                                        const unsigned int first) const
  {
    using V                          = typename Batch<Number>::Vector;
    constexpr unsigned int size      = Batch<Number>::size;
    const Supernode       &node      = supernodes[s];
    const unsigned int     batches   = padded<Number>(node.height()) / size;
    const V               *panel     = reinterpret_cast<const V *>(values);
    V                     *sums      = reinterpret_cast<V *>(workspace.data());
    Number                *component = vector.data() + first;
    std::fill(sums, sums + n * batches, V{});
    for_each_register_block<n == 1 ? 8 : 4>(
      node.width, [&](const unsigned int j, const auto n_columns) {
        const V *column = panel + std::size_t(j) * batches;
        Number   x[n_columns][n];
        for (unsigned int k = 0; k < n_columns; ++k)
          for (unsigned int c = 0; c < n; ++c)
            x[k][c] = component[(node.first + j + k) * n_components + c];
        for (unsigned int i = j / size; i < batches; ++i)
          for (unsigned int c = 0; c < n; ++c)
            {
              V sum = sums[c * batches + i];
              for (unsigned int k = 0; k < n_columns; ++k)
                sum += x[k][c] * column[k * batches + i];
              sums[c * batches + i] = sum;
            }
      });
    for (unsigned int c = 0; c < n; ++c)
      {
        const Number *sum = workspace.data() + c * batches * size;
        for (unsigned int i = 0; i < node.width; ++i)
          component[(node.first + i) * n_components + c] = sum[i];
        for (unsigned int i = 0; i < node.rows.size(); ++i)
          component[node.rows[i] * n_components + c] += sum[node.width + i];
      }
  }

  template <typename Number, typename Work>
  template <unsigned int n>
  void
  SparseCholesky<Number, Work>::backward(const unsigned int s,
                                         const Number      *values,
                                         const unsigned int first) const
  {
    using V                        = typename Batch<Number>::Vector;
    constexpr unsigned int size    = Batch<Number>::size;
    const Supernode       &node    = supernodes[s];
    const unsigned int     batches = padded<Number>(node.height()) / size;
    const V               *panel   = reinterpret_cast<const V *>(values);
    const V *known     = reinterpret_cast<const V *>(workspace.data());
    Number  *component = vector.data() + first;
    for (unsigned int c = 0; c < n; ++c)
      {
        Number *to = workspace.data() + c * batches * size;
        for (unsigned int i = 0; i < node.width; ++i)
          to[i] = component[(node.first + i) * n_components + c];
        for (unsigned int i = 0; i < node.rows.size(); ++i)
          to[node.width + i] = component[node.rows[i] * n_components + c];
        std::fill(to + node.height(), to + batches * size, Number());
      }
    for_each_register_block<n == 1 ? 8 : 4>(
      node.width, [&](const unsigned int j, const auto n_columns) {
        const V *column = panel + std::size_t(j) * batches;
        V        sums[n_columns][n];
        for (unsigned int k = 0; k < n_columns; ++k)
          std::fill_n(sums[k], n, V{});
        for (unsigned int i = j / size; i < batches; ++i)
          for (unsigned int k = 0; k < n_columns; ++k)
            for (unsigned int c = 0; c < n; ++c)
              sums[k][c] += column[k * batches + i] * known[c * batches + i];
        for (unsigned int k = 0; k < n_columns; ++k)
          for (unsigned int c = 0; c < n; ++c)
            {
              Number sum = 0;
              for (unsigned int l = 0; l < size; ++l)
                sum += sums[k][c][l];
              component[(node.first + j + k) * n_components + c] = sum;
            }
      });
  }

  template <typename Number, typename Work>
  template <typename Visit>
  void
  SparseCholesky<Number, Work>::for_each_panel(const unsigned int s,
                                               const Visit       &visit) const
  {
    const std::size_t size =
      padded<Number>(supernodes[s].height()) * supernodes[s].width;
    const Number *panel    = panels[s].begin();
    const bool    is_alike = panels[s].size() == size;
    if (owner[s] == on_all_ranks && common_component >= 0)
      visit(panel + (is_alike ? 0 : common_component * size),
            std::integral_constant<unsigned int, 1>(),
            common_component);
    else if (n_components == dim && is_alike)
      visit(panel, std::integral_constant<unsigned int, dim>(), 0);
    else
      for (unsigned int c = 0; c < n_components; ++c)
        visit(panel + c * size, std::integral_constant<unsigned int, 1>(), c);
  }

  template <typename Number, typename Work>
  void
  SparseCholesky<Number, Work>::add_up_common() const
  {
    const unsigned int n = common_indices.size();
    pack(common_indices.data(), n, exchange.data());
    MPI_Allreduce(MPI_IN_PLACE,
                  exchange.data(),
                  static_cast<int>(n * n_components),
                  Utilities::MPI::mpi_type_id_for_type<Number>,
                  MPI_SUM,
                  comm);
    unpack(common_indices.data(), n, exchange.data());
  }

  template <typename Number, typename Work>
  void
  SparseCholesky<Number, Work>::solve(double *x, const double *b) const
  {
    const auto type   = Utilities::MPI::mpi_type_id_for_type<Number>;
    const auto gather = [&](const std::vector<int> &counts,
                            const std::vector<int> &starts) {
      if (n_ranks > 1)
        MPI_Allgatherv(MPI_IN_PLACE,
                       0,
                       MPI_DATATYPE_NULL,
                       exchange.data(),
                       counts.data(),
                       starts.data(),
                       type,
                       comm);
    };
    Number *mine = exchange.data() + starts[rank];
    for (unsigned int i = 0; i < entries.size(); ++i)
      mine[i] = entries[i] < 0 ?
                  Number() :
                  static_cast<Number>(scale[i / n_components] * b[entries[i]]);
    gather(counts, starts);
    unpack(permutation.data(), permutation.size(), exchange.data());

    if (rank > 0) // what all have counts once
      for (const unsigned int i : common_indices)
        std::fill_n(&vector[i * n_components], n_components, Number());
    for (const unsigned int s : own)
      forward(s);
    if (!common.empty())
      {
        add_up_common();
        for (const unsigned int s : common)
          forward(s);
        for (auto s = common.rbegin(); s != common.rend(); ++s)
          backward(*s);
        if (common_component >= 0)
          {
            // each component from one rank
            for (const unsigned int i : common_indices)
              for (unsigned int c = 0; c < dim; ++c)
                if (static_cast<int>(c) != rank)
                  vector[i * dim + c] = 0;
            add_up_common();
          }
      }
    for (auto s = own.rbegin(); s != own.rend(); ++s)
      backward(*s);
    if (n_ranks > 1)
      {
        const int first = part_starts[rank];
        pack(part_positions.data() + first / n_components,
             part_counts[rank] / n_components,
             exchange.data() + first);
        gather(part_counts, part_starts);
        unpack(part_positions.data(), part_positions.size(), exchange.data());
      }
    const unsigned int first = starts[rank] / n_components;
    for (unsigned int i = 0; i < entries.size(); ++i)
      if (entries[i] >= 0)
        x[entries[i]] =
          scale[i / n_components] *
          vector[permutation[first + i / n_components] * n_components +
                 i % n_components];
  }

  template class SparseCholesky<float, float>;
  template class SparseCholesky<float, double>;
  template class SparseCholesky<double, double>;
} // namespace mortise
