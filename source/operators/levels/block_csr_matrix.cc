// See block_csr_matrix.h.
#include <deal.II/base/mpi.h>

#include <mortise/body/spaces/nodal_space.h>
#include <mortise/operators/levels/block_csr_matrix.h>

#include <algorithm>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int block_size = dim * dim;

    /// Sparsity of rows for another rank: lengths, then nodes, row by row.
    struct RowPattern
    {
      std::vector<BlockCsrMatrixBuilder::Index> rows, columns;
      std::vector<unsigned int>                 lengths;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &rows &columns &lengths;
      }
    };

    /// visit(owned component, entry of the diagonal); not of nodes without a
    /// block.
    template <typename Visit>
    void
    for_each_diagonal(const BlockCsrMatrix &blocks, const Visit &visit)
    {
      for (unsigned int i = 0; i < blocks.size(); ++i)
        for (std::size_t k = blocks.begin[i]; k < blocks.begin[i + 1]; ++k)
          if (blocks.columns[k] == i)
            for (unsigned int c = 0; c < dim; ++c)
              visit(dim * i + c, blocks.values[block_size * k + (dim + 1) * c]);
    }
  } // namespace

  std::vector<unsigned int>
  constrained_components(const BlockCsrMatrix &blocks)
  {
    std::vector<bool> free(dim * blocks.size());
    for_each_diagonal(blocks, [&](const unsigned int i, const double value) {
      free[i] = value != 0.;
    });
    std::vector<unsigned int> constrained;
    for (unsigned int i = 0; i < free.size(); ++i)
      if (!free[i])
        constrained.push_back(i);
    return constrained;
  }

  SparseMatrix
  as_sparse_matrix(const BlockCsrMatrix &blocks)
  {
    const auto &layout = *blocks.layout;
    double      mean   = 0.; // of the diagonal
    for_each_diagonal(blocks, [&](const unsigned int, const double value) {
      mean += value / layout.size();
    });
    mean = Utilities::MPI::sum(mean, layout.get_mpi_communicator());
    if (mean == 0.) // all are constrained
      mean = 1.;
    SparseMatrix::CompressedRows rows;
    // nodes by their global numbers, and blocks
    std::vector<std::pair<SparseMatrix::Index, std::size_t>> order;
    for (unsigned int i = 0; i < blocks.size(); ++i)
      {
        order.clear();
        for (std::size_t k = blocks.begin[i]; k < blocks.begin[i + 1]; ++k)
          order.emplace_back(layout.local_to_global(dim * blocks.columns[k]),
                             k);
        std::sort(order.begin(), order.end());
        for (unsigned int r = 0; r < dim; ++r)
          {
            for (const auto &[first, k] : order)
              for (unsigned int c = 0; c < dim; ++c)
                {
                  const double value =
                    blocks.values[block_size * k + dim * c + r];
                  const bool is_constrained =
                    blocks.columns[k] == i && c == r && value == 0.;
                  rows.columns.push_back(first + c);
                  rows.values.push_back(is_constrained ? mean : value);
                }
            rows.begin.push_back(rows.columns.size());
          }
      }
    return {layout.locally_owned_range(),
            layout.locally_owned_range(),
            layout.get_mpi_communicator(),
            std::move(rows)};
  }

  BlockCsrMatrixBuilder::BlockCsrMatrixBuilder(const IndexSet &owned,
                                               const MPI_Comm  comm)
    : owned(owned)
    , comm(comm)
    , first(owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0)
    , n_owned(owned.n_elements())
  {}

  unsigned int
  BlockCsrMatrixBuilder::local_number(const Index node)
  {
    if (is_owned(node))
      return node - first;
    const auto [found, is_new] =
      index_of_other.emplace(node, n_owned + others.size());
    if (is_new)
      others.push_back(node);
    return found->second;
  }

  void
  BlockCsrMatrixBuilder::couple(const std::vector<unsigned int> &rows,
                                const std::vector<unsigned int> &more)
  {
    groups.push_back({members.size(),
                      static_cast<unsigned int>(rows.size()),
                      static_cast<unsigned int>(more.size())});
    members.insert(members.end(), rows.begin(), rows.end());
    members.insert(members.end(), more.begin(), more.end());
  }

  void
  BlockCsrMatrixBuilder::close()
  {
    unite_groups();
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      {
        exchange_pattern();
        unite_groups();
      }
    groups  = std::vector<Group>();
    members = std::vector<unsigned int>();
    values.assign(block_size * columns.size(), 0.);
  }

  void
  BlockCsrMatrixBuilder::unite_groups()
  {
    const unsigned int       n = n_owned + others.size();
    std::vector<std::size_t> first_group(n + 1); // by row
    for (const Group &group : groups)
      for (unsigned int r = 0; r < group.n_rows; ++r)
        ++first_group[members[group.begin + r] + 1];
    std::partial_sum(first_group.begin(),
                     first_group.end(),
                     first_group.begin());
    std::vector<unsigned int> of_rows(first_group.back());
    auto                      next = first_group;
    for (unsigned int g = 0; g < groups.size(); ++g)
      for (unsigned int r = 0; r < groups[g].n_rows; ++r)
        of_rows[next[members[groups[g].begin + r]]++] = g;

    begin.assign(1, 0);
    columns.clear();
    std::vector<unsigned int> last_row(n, numbers::invalid_unsigned_int);
    for (unsigned int row = 0; row < n; ++row)
      {
        for (std::size_t k = first_group[row]; k < first_group[row + 1]; ++k)
          {
            const Group        &group = groups[of_rows[k]];
            const bool          same  = group.n_columns == 0;
            const unsigned int *from =
              &members[group.begin + (same ? 0 : group.n_rows)];
            for (unsigned int c = 0;
                 c < (same ? group.n_rows : group.n_columns);
                 ++c)
              if (last_row[from[c]] != row)
                {
                  last_row[from[c]] = row;
                  columns.push_back(from[c]);
                }
          }
        std::sort(columns.begin() + begin.back(), columns.end());
        begin.push_back(columns.size());
      }
  }

  void
  BlockCsrMatrixBuilder::exchange_pattern()
  {
    IndexSet rows(owned.size());
    for (unsigned int i = 0; i < others.size(); ++i)
      if (begin[n_owned + i] < begin[n_owned + i + 1])
        rows.add_index(others[i]);
    const auto owners = Utilities::MPI::compute_index_owner(owned, rows, comm);
    std::map<unsigned int, RowPattern> patterns;
    unsigned int                       k = 0;
    for (const Index row : rows)
      {
        const unsigned int rank = owners[k++], at = index_of_other.at(row);
        RowPattern        &pattern = patterns[rank];
        pattern.rows.push_back(row);
        pattern.lengths.push_back(begin[at + 1] - begin[at]);
        for (std::size_t e = begin[at]; e < begin[at + 1]; ++e)
          pattern.columns.push_back(node(columns[e]));
        sent_rows[rank].push_back(at);
      }
    for (const auto &[rank, pattern] :
         Utilities::MPI::some_to_some(comm, patterns))
      {
        auto column = pattern.columns.begin();
        for (unsigned int r = 0; r < pattern.rows.size(); ++r)
          {
            const unsigned int        row = local_number(pattern.rows[r]);
            std::vector<unsigned int> list;
            for (unsigned int e = 0; e < pattern.lengths[r]; ++e)
              list.push_back(local_number(*column++));
            couple({row}, list);
            received_rows[rank].insert(received_rows[rank].end(),
                                       list.size(),
                                       row);
            received_columns[rank].insert(received_columns[rank].end(),
                                          list.begin(),
                                          list.end());
          }
      }
  }

  double *
  BlockCsrMatrixBuilder::block(const unsigned int row,
                               const unsigned int column)
  {
    const auto from = columns.begin() + begin[row],
               to   = columns.begin() + begin[row + 1];
    const auto at   = std::lower_bound(from, to, column);
    Assert(at != to && *at == column, ExcInternalError());
    return &values[block_size * (at - columns.begin())];
  }

  BlockCsrMatrix
  BlockCsrMatrixBuilder::finish(const IndexSet &ghosts)
  {
    std::map<unsigned int, std::vector<double>> packages;
    for (const auto &[rank, rows] : sent_rows)
      for (const unsigned int row : rows)
        packages[rank].insert(packages[rank].end(),
                              values.begin() + block_size * begin[row],
                              values.begin() + block_size * begin[row + 1]);
    for (const auto &[rank, package] :
         Utilities::MPI::some_to_some(comm, packages))
      for (unsigned int e = 0; e < received_rows[rank].size(); ++e)
        {
          double *to = block(received_rows[rank][e], received_columns[rank][e]);
          for (unsigned int k = 0; k < block_size; ++k)
            to[k] += package[block_size * e + k];
        }

    BlockCsrMatrix     result;
    std::vector<Index> used;
    columns.resize(begin[n_owned]);
    for (const unsigned int column : columns)
      if (column >= n_owned)
        used.push_back(node(column));
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    IndexSet relevant(ghosts);
    relevant.add_indices(used.begin(), used.end());
    result.layout = std::make_shared<const Utilities::MPI::Partitioner>(
      displacement_indices(owned), displacement_indices(relevant), comm);
    for (unsigned int &column : columns)
      if (column >= n_owned)
        column = result.layout->global_to_local(dim * node(column)) / dim;
    begin.resize(n_owned + 1);
    values.resize(block_size * columns.size());
    result.begin   = std::move(begin);
    result.columns = std::move(columns);
    result.values  = std::move(values);
    return result;
  }
} // namespace mortise
