#include <deal.II/base/mpi.h>

#include <mortise/operators/matrix_free/tensor_kernel.h>
#include <mortise/solvers/multipliers/coupling_clusters.h>
#include <mortise/solvers/multipliers/coupling_product.h>
#include <mortise/solvers/register_blocks.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Calls visit(k, index in a padded row) for the nodes of a block.
    template <typename Block, typename Visit>
    void
    for_each_node(const Block       &block,
                  const CoupledNodes which,
                  const Visit       &visit)
    {
      for (unsigned int k = 0; k < block.n_dependent; ++k)
        visit(k, k);
      if (which == CoupledNodes::dependent)
        return;
      const unsigned int first = block.width(CoupledNodes::dependent);
      for (unsigned int k = block.n_dependent; k < block.nodes.size(); ++k)
        visit(k, first + k - block.n_dependent);
    }
  } // namespace

  template <typename Number>
  CouplingProduct<Number>::CouplingProduct(const BlockSystem  &system,
                                           const RowsByEntity &rows)
  {
    take_frames(system);
    make_layout(system, rows);
    make_blocks(rows, independent_nodes(system, rows));
  }

  template <typename Number>
  void
  CouplingProduct<Number>::take_frames(const BlockSystem &system)
  {
    const CouplingMatrix &B = system.directed_constraint();
    frames                  = B.has_frames() ? &B.frames() : nullptr;
    by_component.resize(frames ? B.scalar().n_rows() : 0);
  }

  template <typename Number>
  void
  CouplingProduct<Number>::make_layout(const BlockSystem  &system,
                                       const RowsByEntity &rows)
  {
    const IndexSet      touched = coupled_displacements(system, rows);
    LevelVector<double> number(system.owned_displacement,
                               touched,
                               system.communicator);
    for (const auto index : touched)
      number(index) = 1.;
    number.compress(VectorOperation::add);
    for (unsigned int i = 0; i < number.locally_owned_size(); ++i)
      if (number.local_element(i) > 0.)
        coupled_indices.push_back(i);

    // number what is moved by itself; exact in double precision
    using Index = types::global_dof_index;
    const IndexSet owned =
      owned_range(coupled_indices.size(), system.communicator);
    for (unsigned int k = 0; k < coupled_indices.size(); ++k)
      number.local_element(coupled_indices[k]) = owned.nth_index_in_set(k);
    number.update_ghost_values();
    IndexSet relevant(owned.size());
    for (const auto index : touched)
      relevant.add_index(static_cast<Index>(number(index)));
    layout =
      std::make_shared<const Utilities::MPI::Partitioner>(owned,
                                                          relevant,
                                                          system.communicator);
    values.resize(rows.displacements.size());
    for (const int displacement : rows.displacements)
      entry_of_value.push_back(displacement < 0 ?
                                 -1 :
                                 static_cast<int>(layout->global_to_local(
                                   static_cast<Index>(number(displacement)))));
  }

  template <typename Number>
  unsigned int
  CouplingProduct<Number>::Block::width(const CoupledNodes which) const
  {
    const unsigned int dependent = padded<Number>(n_dependent);
    return which == CoupledNodes::dependent ?
             dependent :
             dependent + padded<Number>(nodes.size() - n_dependent);
  }

  template <typename Number>
  void
  CouplingProduct<Number>::make_blocks(const RowsByEntity      &rows,
                                       const std::vector<bool> &is_independent)
  {
    std::vector<SplitEntityRows> all;
    for (const auto &of_entity : rows.rows)
      for (const EntityRows &shared : of_entity)
        all.emplace_back(shared, is_independent);
    const auto  clusters = make_clusters(all);
    std::size_t size = 0, widest = 0;
    for (const CouplingCluster &cluster : clusters)
      {
        Block &block      = blocks.emplace_back();
        block.nodes       = cluster.nodes[0];
        block.n_dependent = block.nodes.size();
        block.nodes.insert(block.nodes.end(),
                           cluster.nodes[1].begin(),
                           cluster.nodes[1].end());
        for (auto s = cluster.begin; s < cluster.end; ++s)
          {
            const EntityRows  &shared  = *all[s].shared;
            const unsigned int n_nodes = shared.nodes.size();
            for (int r = 0; r < shared.n_rows; ++r)
              {
                for (unsigned int c = 0; c < dim; ++c)
                  if (const int first = shared.first_row[c]; first < 0)
                    block.rows.push_back(-1);
                  else
                    block.rows.push_back(first + r);
                const int own = all[s].own[r];
                block.own_node.push_back(
                  own < 0 ? -1 : static_cast<int>(shared.nodes[own]));
                block.own_entry.push_back(
                  own < 0 ?
                    0 :
                    static_cast<Number>(shared.values[r * n_nodes + own]));
              }
          }
        const std::size_t width = block.width(CoupledNodes::all);
        size += block.own_node.size() * width;
        widest = std::max(widest, width);
      }
    entries.resize(size);
    workspace.resize(dim * widest);
    Number *to = entries.data();
    for (unsigned int b = 0; b < blocks.size(); ++b)
      for (auto s = clusters[b].begin; s < clusters[b].end; ++s)
        {
          const EntityRows  &shared  = *all[s].shared;
          const unsigned int n_nodes = shared.nodes.size();
          for (int r = 0; r < shared.n_rows; ++r)
            {
              for (unsigned int i = 0; i < 2; ++i)
                for (const unsigned int k : all[s].columns[i])
                  {
                    const auto &nodes = clusters[b].nodes[i];
                    to[(i == 0 ? 0 : padded<Number>(blocks[b].n_dependent)) +
                       (std::lower_bound(
                          nodes.begin(), nodes.end(), shared.nodes[k]) -
                        nodes.begin())] =
                      static_cast<Number>(shared.values[r * n_nodes + k]);
                  }
              to += blocks[b].width(CoupledNodes::all);
            }
        }
  }

  template <typename Number>
  void
  CouplingProduct<Number>::multiply_block(const Block       &block,
                                          const Number      *block_entries,
                                          double            *jump,
                                          const CoupledNodes which) const
  {
    using V                  = typename Batch<Number>::Vector;
    constexpr unsigned int w = Batch<Number>::size;
    const unsigned int     m = block.width(which) / w,
                       m_all = block.width(CoupledNodes::all) / w;
    const V *row             = reinterpret_cast<const V *>(block_entries);
    V       *gathered        = reinterpret_cast<V *>(workspace.data());
    Number  *to              = workspace.data();
    std::fill(gathered, gathered + dim * m, V{});
    for_each_node(block,
                  which,
                  [&](const unsigned int k, const unsigned int at) {
                    for (unsigned int c = 0; c < dim; ++c)
                      to[c * m * w + at] = values[dim * block.nodes[k] + c];
                  });
    for_each_register_block<n_register_rows>(
      block.own_node.size(), [&](const unsigned int i, const auto n_rows) {
        const V *const from = row + std::size_t(i) * m_all;
        V              sums[n_rows][dim];
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int c = 0; c < dim; ++c)
            sums[r][c] = V{};
        for (unsigned int k = 0; k < m; ++k)
          for (unsigned int r = 0; r < n_rows; ++r)
            for (unsigned int c = 0; c < dim; ++c)
              sums[r][c] += from[r * m_all + k] * gathered[c * m + k];
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int c = 0; c < dim; ++c)
            if (const int j = block.rows[dim * (i + r) + c]; j >= 0)
              {
                const int own = block.own_node[i + r];
                Number    sum =
                  own < 0 ? 0 : block.own_entry[i + r] * values[dim * own + c];
                sum += sum_of_batch(reinterpret_cast<Number *>(&sums[r][c]));
                jump[j] = sum;
              }
      });
  }

  template <typename Number>
  void
  CouplingProduct<Number>::multiply_block_transposed(
    const Block       &block,
    const Number      *block_entries,
    const double      *y,
    const CoupledNodes which) const
  {
    using V                  = typename Batch<Number>::Vector;
    constexpr unsigned int w = Batch<Number>::size;
    const unsigned int     m = block.width(which) / w,
                       m_all = block.width(CoupledNodes::all) / w;
    const V *row             = reinterpret_cast<const V *>(block_entries);
    V       *sums            = reinterpret_cast<V *>(workspace.data());
    std::fill(sums, sums + dim * m, V{});
    for_each_register_block<n_register_rows>(
      block.own_node.size(), [&](const unsigned int i, const auto n_rows) {
        const V *const from = row + std::size_t(i) * m_all;
        Number         factor[n_rows][dim];
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int c = 0; c < dim; ++c)
            {
              const int j  = block.rows[dim * (i + r) + c];
              factor[r][c] = j < 0 ? Number() : static_cast<Number>(y[j]);
              if (const int own = block.own_node[i + r]; own >= 0)
                values[dim * own + c] += block.own_entry[i + r] * factor[r][c];
            }
        for (unsigned int k = 0; k < m; ++k)
          for (unsigned int c = 0; c < dim; ++c)
            {
              V sum = sums[c * m + k];
              for (unsigned int r = 0; r < n_rows; ++r)
                sum += factor[r][c] * from[r * m_all + k];
              sums[c * m + k] = sum;
            }
      });
    const Number *from = workspace.data();
    for_each_node(block,
                  which,
                  [&](const unsigned int k, const unsigned int at) {
                    for (unsigned int c = 0; c < dim; ++c)
                      values[dim * block.nodes[k] + c] += from[c * m * w + at];
                  });
  }

  template <typename Number>
  template <typename Visit>
  void
  CouplingProduct<Number>::for_each_block(const Visit &visit) const
  {
    const Number *block_entries = entries.data();
    for (const Block &block : blocks)
      {
        visit(block, block_entries);
        block_entries += block.own_node.size() * block.width(CoupledNodes::all);
      }
  }

  template <typename Number>
  void
  CouplingProduct<Number>::multiply(Vector                    &jump,
                                    const LevelVector<Number> &coupled_values,
                                    const CoupledNodes         nodes) const
  {
    coupled_values.update_ghost_values();
    for (unsigned int v = 0; v < values.size(); ++v)
      values[v] = entry_of_value[v] < 0 ?
                    Number() :
                    coupled_values.local_element(entry_of_value[v]);
    coupled_values.zero_out_ghost_values();
    double *to = frames ? by_component.data() : jump.begin();
    for_each_block([&](const Block &block, const Number *from) {
      multiply_block(block, from, to, nodes);
    });
    if (frames)
      frames->vmult(jump.begin(), to);
  }

  template <typename Number>
  void
  CouplingProduct<Number>::multiply_transposed(
    LevelVector<Number> &coupled_values,
    const Vector        &y,
    const CoupledNodes   nodes) const
  {
    if (frames)
      {
        std::fill(by_component.begin(), by_component.end(), 0.);
        frames->Tvmult_add(by_component.data(), y.begin());
      }
    const double *factors = frames ? by_component.data() : y.begin();
    std::fill(values.begin(), values.end(), Number());
    for_each_block([&](const Block &block, const Number *from) {
      multiply_block_transposed(block, from, factors, nodes);
    });
    coupled_values = 0;
    for (unsigned int v = 0; v < values.size(); ++v)
      if (entry_of_value[v] >= 0)
        coupled_values.local_element(entry_of_value[v]) = values[v];
    coupled_values.compress(VectorOperation::add);
  }

  template class CouplingProduct<float>;
  template class CouplingProduct<double>;
} // namespace mortise
