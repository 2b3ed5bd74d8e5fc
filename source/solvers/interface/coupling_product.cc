#include <deal.II/base/mpi.h>

#include <mortise/operators/matrix_free/tensor_kernel.h>
#include <mortise/solvers/interface/coupling_product.h>
#include <mortise/solvers/register_blocks.h>

#include <algorithm>
#include <iterator>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Each column of a block, which is gathered and scattered, counts as so
    /// many entries: with 6, 16 and 40 products take the same time, with 0, an
    /// entity for a block, two and a half times as long in the smallest scenes.
    constexpr double entries_per_column = 8.;

    /// Neighbouring rows that are one block, since they move nearly the same
    /// nodes.
    struct Cluster
    {
      std::size_t               begin = 0, end = 0; ///< of shared rows
      int                       n_rows = 0;
      std::vector<unsigned int> nodes; ///< ascending

      static double
      work(const double n_rows, const double n_columns)
      {
        return (n_rows + entries_per_column) * n_columns;
      }

      /// Unless that takes longer than apart.
      bool
      add(const SharedRows &rows)
      {
        std::vector<unsigned int> united;
        std::set_union(nodes.begin(),
                       nodes.end(),
                       rows.nodes.begin(),
                       rows.nodes.end(),
                       std::back_inserter(united));
        if (end > begin &&
            work(n_rows + rows.n_rows, united.size()) >
              work(n_rows, nodes.size()) + work(rows.n_rows, rows.nodes.size()))
          return false;
        nodes = std::move(united);
        n_rows += rows.n_rows;
        ++end;
        return true;
      }
    };

    std::vector<Cluster>
    make_clusters(const std::vector<const SharedRows *> &all)
    {
      std::vector<Cluster> result;
      for (std::size_t s = 0; s < all.size(); ++s)
        if (result.empty() || !result.back().add(*all[s]))
          {
            result.push_back({s, s, 0, {}});
            result.back().add(*all[s]);
          }
      return result;
    }
  } // namespace

  template <typename Number>
  CouplingProduct<Number>::CouplingProduct(const BlockSystem  &system,
                                           const CouplingRows &rows)
    : n_components(rows.moved.n_components)
  {
    make_layout(system, rows);
    make_blocks(rows);
  }

  template <typename Number>
  void
  CouplingProduct<Number>::make_layout(const BlockSystem  &system,
                                       const CouplingRows &rows)
  {
    IndexSet touched(system.owned_displacement.size());
    for (const int column : rows.moved.column_of_value)
      if (column >= 0)
        touched.add_index(rows.matrix.GCID(column));
    touched.compress();
    LevelVector<double> number(system.owned_displacement,
                               touched,
                               system.communicator);
    for (const auto index : touched)
      number(index) = 1.;
    number.compress(VectorOperation::add);
    for (unsigned int i = 0; i < number.locally_owned_size(); ++i)
      if (number.local_element(i) > 0.)
        moved_indices.push_back(i);

    // number what is moved by itself; exact in double precision
    using Index      = types::global_dof_index;
    const Index mine = moved_indices.size(),
                size = Utilities::MPI::sum(mine, system.communicator);
    Index first      = 0;
    MPI_Scan(&mine,
             &first,
             1,
             DEAL_II_DOF_INDEX_MPI_TYPE,
             MPI_SUM,
             system.communicator);
    first -= mine;
    for (unsigned int k = 0; k < moved_indices.size(); ++k)
      number.local_element(moved_indices[k]) = first + k;
    number.update_ghost_values();
    IndexSet owned(size), relevant(size);
    owned.add_range(first, first + moved_indices.size());
    for (const auto index : touched)
      relevant.add_index(static_cast<Index>(number(index)));
    layout =
      std::make_shared<const Utilities::MPI::Partitioner>(owned,
                                                          relevant,
                                                          system.communicator);
    values.resize(rows.moved.column_of_value.size());
    for (const int column : rows.moved.column_of_value)
      entry_of_value.push_back(
        column < 0 ? -1 :
                     static_cast<int>(layout->global_to_local(
                       static_cast<Index>(number(rows.matrix.GCID(column))))));
  }

  template <typename Number>
  void
  CouplingProduct<Number>::make_blocks(const CouplingRows &rows)
  {
    std::vector<const SharedRows *> all;
    for (const auto &of_entity : rows.rows)
      for (const SharedRows &shared : of_entity)
        all.push_back(&shared);
    const auto  clusters = make_clusters(all);
    std::size_t size = 0, widest = 0;
    for (const Cluster &cluster : clusters)
      {
        Block &block = blocks.emplace_back();
        block.nodes  = cluster.nodes;
        for (auto s = cluster.begin; s < cluster.end; ++s)
          for (int r = 0; r < all[s]->n_rows; ++r)
            for (unsigned int c = 0; c < n_components; ++c)
              if (const int first = all[s]->first_row[c]; first < 0)
                block.rows.push_back(-1);
              else
                block.rows.push_back(first + r);
        const std::size_t width = padded<Number>(block.nodes.size());
        size += block.rows.size() / n_components * width;
        widest = std::max(widest, width);
      }
    entries.resize(size);
    workspace.resize(n_components * widest);
    Number *to = entries.data();
    for (const Cluster &cluster : clusters)
      for (auto s = cluster.begin; s < cluster.end; ++s)
        {
          std::vector<unsigned int> indices;
          for (const unsigned int node : all[s]->nodes)
            indices.push_back(std::lower_bound(cluster.nodes.begin(),
                                               cluster.nodes.end(),
                                               node) -
                              cluster.nodes.begin());
          auto from = all[s]->values.begin();
          for (int r = 0; r < all[s]->n_rows; ++r)
            {
              for (const unsigned int index : indices)
                to[index] = static_cast<Number>(*from++);
              to += padded<Number>(cluster.nodes.size());
            }
        }
  }

  template <typename Number>
  template <unsigned int n_components>
  void
  CouplingProduct<Number>::multiply_block(const Block   &block,
                                          const Number  *block_entries,
                                          Epetra_Vector &jump) const
  {
    using V                  = typename Batch<Number>::Vector;
    constexpr unsigned int w = Batch<Number>::size;
    const unsigned int     n = block.nodes.size(), m = padded<Number>(n) / w;
    const V               *row = reinterpret_cast<const V *>(block_entries);
    V                     *gathered = reinterpret_cast<V *>(workspace.data());
    Number                *to       = workspace.data();
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int c = 0; c < n_components; ++c)
        to[c * m * w + k] = values[n_components * block.nodes[k] + c];
    for (unsigned int c = 0; c < n_components; ++c)
      std::fill(to + c * m * w + n, to + (c + 1) * m * w, Number());
    for_each_register_block<n_register_rows>(
      block.rows.size() / n_components,
      [&](const unsigned int i, const auto n_rows) {
        const V *const from = row + std::size_t(i) * m;
        V              sums[n_rows][n_components];
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int c = 0; c < n_components; ++c)
            sums[r][c] = V{};
        for (unsigned int k = 0; k < m; ++k)
          for (unsigned int r = 0; r < n_rows; ++r)
            for (unsigned int c = 0; c < n_components; ++c)
              sums[r][c] += from[r * m + k] * gathered[c * m + k];
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int c = 0; c < n_components; ++c)
            if (const int j = block.rows[n_components * (i + r) + c]; j >= 0)
              {
                Number sum = 0;
                for (unsigned int l = 0; l < w; ++l)
                  sum += sums[r][c][l];
                jump[j] = sum;
              }
      });
  }

  template <typename Number>
  template <unsigned int n_components>
  void
  CouplingProduct<Number>::multiply_block_transposed(
    const Block         &block,
    const Number        *block_entries,
    const Epetra_Vector &y) const
  {
    using V                  = typename Batch<Number>::Vector;
    constexpr unsigned int w = Batch<Number>::size;
    const unsigned int     n = block.nodes.size(), m = padded<Number>(n) / w;
    const V               *row  = reinterpret_cast<const V *>(block_entries);
    V                     *sums = reinterpret_cast<V *>(workspace.data());
    std::fill(sums, sums + n_components * m, V{});
    for_each_register_block<n_register_rows>(
      block.rows.size() / n_components,
      [&](const unsigned int i, const auto n_rows) {
        const V *const from = row + std::size_t(i) * m;
        Number         factor[n_rows][n_components];
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int c = 0; c < n_components; ++c)
            {
              const int j  = block.rows[n_components * (i + r) + c];
              factor[r][c] = j < 0 ? Number() : static_cast<Number>(y[j]);
            }
        for (unsigned int k = 0; k < m; ++k)
          for (unsigned int c = 0; c < n_components; ++c)
            {
              V sum = sums[c * m + k];
              for (unsigned int r = 0; r < n_rows; ++r)
                sum += factor[r][c] * from[r * m + k];
              sums[c * m + k] = sum;
            }
      });
    const Number *from = workspace.data();
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int c = 0; c < n_components; ++c)
        values[n_components * block.nodes[k] + c] += from[c * m * w + k];
  }

  template <typename Number>
  template <typename Visit>
  void
  CouplingProduct<Number>::for_each_block(const Visit &visit) const
  {
    const Number *block_entries = entries.data();
    for (const Block &block : blocks)
      {
        if (n_components == dim)
          visit(block,
                block_entries,
                std::integral_constant<unsigned int, dim>());
        else
          visit(block,
                block_entries,
                std::integral_constant<unsigned int, 1>());
        block_entries +=
          block.rows.size() / n_components * padded<Number>(block.nodes.size());
      }
  }

  template <typename Number>
  void
  CouplingProduct<Number>::multiply(Epetra_Vector             &jump,
                                    const LevelVector<Number> &trace) const
  {
    trace.update_ghost_values();
    for (unsigned int v = 0; v < values.size(); ++v)
      values[v] = entry_of_value[v] < 0 ?
                    Number() :
                    trace.local_element(entry_of_value[v]);
    trace.zero_out_ghost_values();
    for_each_block([&](const Block &block, const Number *from, const auto n) {
      multiply_block<n()>(block, from, jump);
    });
  }

  template <typename Number>
  void
  CouplingProduct<Number>::multiply_transposed(LevelVector<Number> &trace,
                                               const Epetra_Vector &y) const
  {
    std::fill(values.begin(), values.end(), Number());
    for_each_block([&](const Block &block, const Number *from, const auto n) {
      multiply_block_transposed<n()>(block, from, y);
    });
    trace = 0;
    for (unsigned int v = 0; v < values.size(); ++v)
      if (entry_of_value[v] >= 0)
        trace.local_element(entry_of_value[v]) = values[v];
    trace.compress(VectorOperation::add);
  }

  template class CouplingProduct<float>;
  template class CouplingProduct<double>;
} // namespace mortise
