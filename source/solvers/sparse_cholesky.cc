// See sparse_cholesky.h.
#include <deal.II/base/mpi.h>

#include <Epetra_MpiComm.h>
#include <mortise/operators/tensor_kernel.h>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/front.h>
#include <mortise/solvers/register_blocks.h>
#include <mortise/solvers/sparse_cholesky.h>

#include <cmath>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    template <typename T>
    std::vector<T>
    gather_on_all(std::vector<T> mine, const MPI_Comm comm)
    {
      int n_ranks = 1, n_mine = mine.size();
      MPI_Comm_size(comm, &n_ranks);
      if (n_ranks == 1)
        return mine;
      std::vector<int> counts(n_ranks), starts(n_ranks + 1);
      MPI_Allgather(&n_mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
      std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
      std::vector<T> all(starts.back());
      const auto     type = Utilities::MPI::mpi_type_id_for_type<T>;
      MPI_Allgatherv(mine.data(),
                     n_mine,
                     type,
                     all.data(),
                     counts.data(),
                     starts.data(),
                     type,
                     comm);
      return all;
    }

    SparseRows
    owned_rows(const Epetra_CrsMatrix &matrix)
    {
      SparseRows rows;
      for (int i = 0; i < matrix.NumMyRows(); ++i)
        {
          const EpetraRow row(matrix, i);
          rows.lengths.push_back(row.length);
          for (int k = 0; k < row.length; ++k)
            rows.columns.push_back(matrix.GCID(row.columns[k]));
          rows.values.insert(rows.values.end(),
                             row.values,
                             row.values + row.length);
        }
      return rows;
    }
  } // namespace

  /// Rows of all ranks.
  template <typename Number>
  struct SparseCholesky<Number>::GatheredMatrix : MatrixGraph
  {
    GatheredMatrix(SparseRows rows, const MPI_Comm comm)
    {
      const auto lengths = gather_on_all(std::move(rows.lengths), comm);
      columns            = gather_on_all(std::move(rows.columns), comm);
      values             = gather_on_all(std::move(rows.values), comm);
      begin.assign(lengths.size() + 1, 0);
      std::partial_sum(lengths.begin(), lengths.end(), begin.begin() + 1);
      scale.assign(lengths.size(), 0.);
      for (unsigned int i = 0; i < size(); ++i)
        for (unsigned int k = begin[i]; k < begin[i + 1]; ++k)
          if (columns[k] == static_cast<int>(i) && values[k] > 0.)
            scale[i] = 1. / std::sqrt(values[k]);
    }

    std::vector<double> values;
    std::vector<double> scale; ///< to a diagonal of ones; 0: not possible
  };

  template <typename Number>
  bool
  SparseCholesky<Number>::initialize(const Epetra_CrsMatrix &matrix)
  {
    return initialize(
      owned_rows(matrix),
      dynamic_cast<const Epetra_MpiComm &>(matrix.Comm()).Comm());
  }

  template <typename Number>
  bool
  SparseCholesky<Number>::initialize(SparseRows     rows,
                                     const MPI_Comm communicator)
  {
    comm = communicator;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &n_ranks);
    counts =
      gather_on_all(std::vector<int>{static_cast<int>(rows.lengths.size())},
                    comm);
    const GatheredMatrix all(std::move(rows), comm);
    starts.assign(n_ranks + 1, 0);
    std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
    if (std::find(all.scale.begin(), all.scale.end(), 0.) != all.scale.end())
      return false;
    scale.assign(all.scale.begin() + starts[rank],
                 all.scale.begin() + starts[rank + 1]);
    EliminationTree tree(all);
    supernodes = std::move(tree.supernodes);
    place      = std::move(tree.place);
    owner      = deal_out(supernodes, n_ranks);
    list_parts();
    vector.resize(place.size());
    exchange.resize(place.size());
    unsigned int highest = 0;
    for (const Supernode &supernode : supernodes)
      highest = std::max(highest, supernode.height());
    workspace.resize(padded<Number>(highest));
    return factorise(all);
  }

  template <typename Number>
  void
  SparseCholesky<Number>::list_parts()
  {
    const unsigned int n = supernodes.size();
    part_counts.assign(n_ranks, 0);
    part_starts.assign(n_ranks + 1, 0);
    for (int r = 0; r < n_ranks; ++r)
      {
        for (unsigned int s = 0; s < n; ++s)
          if (owner[s] == r)
            for (unsigned int i = 0; i < supernodes[s].width; ++i)
              part_place.push_back(supernodes[s].first + i);
        part_starts[r + 1] = part_place.size();
        part_counts[r]     = part_starts[r + 1] - part_starts[r];
      }
    for (unsigned int s = 0; s < n; ++s)
      if (owner[s] == rank)
        own.push_back(s);
      else if (owner[s] == on_all_ranks)
        {
          common.push_back(s);
          for (unsigned int i = 0; i < supernodes[s].width; ++i)
            common_places.push_back(supernodes[s].first + i);
        }
  }

  template <typename Number>
  bool
  SparseCholesky<Number>::factorise(const GatheredMatrix &matrix)
  {
    const unsigned int               n = supernodes.size();
    std::vector<unsigned int>        row_at(place.size());
    std::vector<int>                 local(place.size(), -1);
    std::vector<std::vector<double>> updates(n);
    for (unsigned int i = 0; i < place.size(); ++i)
      row_at[place[i]] = i;
    panels.resize(n);

    const auto process = [&](const unsigned int s) {
      const Supernode &supernode = supernodes[s];
      Front            front(supernode);
      for (int i = 0; i < front.width; ++i)
        local[supernode.first + i] = i;
      for (unsigned int i = 0; i < supernode.rows.size(); ++i)
        local[supernode.rows[i]] = front.width + i;
      for (int j = 0; j < front.width; ++j)
        {
          const unsigned int row = row_at[supernode.first + j];
          for (unsigned int k = matrix.begin[row]; k < matrix.begin[row + 1];
               ++k)
            if (const int column = matrix.columns[k];
                place[column] >= supernode.first + j)
              front(local[place[column]], j) =
                matrix.values[k] * matrix.scale[row] * matrix.scale[column];
        }
      for (const unsigned int child : supernode.children)
        {
          const auto &rows   = supernodes[child].rows;
          auto       &update = updates[child];
          if (owner[s] == on_all_ranks && owner[child] != on_all_ranks)
            {
              update.resize(rows.size() * rows.size());
              MPI_Bcast(
                update.data(), update.size(), MPI_DOUBLE, owner[child], comm);
            }
          for (unsigned int j = 0; j < rows.size(); ++j)
            for (unsigned int i = j; i < rows.size(); ++i)
              front(local[rows[i]], local[rows[j]]) +=
                update[i + rows.size() * j];
          update = std::vector<double>();
        }
      if (!front.eliminate())
        return false;
      updates[s] = front.update();
      panels[s]  = front.panel<Number>();
      return true;
    };
    bool positive = true;
    for (const unsigned int s : own)
      positive = positive && process(s);
    positive = Utilities::MPI::min(positive ? 1 : 0, comm) == 1;
    for (const unsigned int s : common)
      positive = positive && process(s);
    return positive;
  }

  template <typename Number>
  void
  SparseCholesky<Number>::forward(const unsigned int s) const
  {
    using V                        = typename Batch<Number>::Vector;
    constexpr unsigned int size    = Batch<Number>::size;
    const Supernode       &node    = supernodes[s];
    const unsigned int     batches = padded<Number>(node.height()) / size;
    const V               *panel   = reinterpret_cast<const V *>(&panels[s][0]);
    V                     *sums    = reinterpret_cast<V *>(workspace.data());
    std::fill(sums, sums + batches, V{});
    for_each_register_block<8>(
      node.width, [&](const unsigned int j, const auto n) {
        const V *column = panel + std::size_t(j) * batches;
        Number   x[n];
        std::copy_n(&vector[node.first + j], n(), x);
        for (unsigned int i = j / size; i < batches; ++i)
          {
            V sum = sums[i];
            for (unsigned int k = 0; k < n; ++k)
              sum += x[k] * column[k * batches + i];
            sums[i] = sum;
          }
      });
    std::copy_n(workspace.data(), node.width, &vector[node.first]);
    for (unsigned int i = 0; i < node.rows.size(); ++i)
      vector[node.rows[i]] += workspace[node.width + i];
  }

  template <typename Number>
  void
  SparseCholesky<Number>::backward(const unsigned int s) const
  {
    using V                        = typename Batch<Number>::Vector;
    constexpr unsigned int size    = Batch<Number>::size;
    const Supernode       &node    = supernodes[s];
    const unsigned int     batches = padded<Number>(node.height()) / size;
    const V               *panel   = reinterpret_cast<const V *>(&panels[s][0]);
    const V *values = reinterpret_cast<const V *>(workspace.data());
    std::copy_n(&vector[node.first], node.width, workspace.data());
    for (unsigned int i = 0; i < node.rows.size(); ++i)
      workspace[node.width + i] = vector[node.rows[i]];
    std::fill(workspace.data() + node.height(),
              workspace.data() + batches * size,
              Number());
    for_each_register_block<8>(
      node.width, [&](const unsigned int j, const auto n) {
        const V *column = panel + std::size_t(j) * batches;
        V        sums[n];
        std::fill_n(sums, n(), V{});
        for (unsigned int i = j / size; i < batches; ++i)
          for (unsigned int k = 0; k < n; ++k)
            sums[k] += column[k * batches + i] * values[i];
        for (unsigned int k = 0; k < n; ++k)
          {
            Number sum = 0;
            for (unsigned int l = 0; l < size; ++l)
              sum += sums[k][l];
            vector[node.first + j + k] = sum;
          }
      });
  }

  template <typename Number>
  void
  SparseCholesky<Number>::solve(Epetra_Vector &x, const Epetra_Vector &b) const
  {
    const auto type = Utilities::MPI::mpi_type_id_for_type<Number>;
    const int  n    = scale.size();
    for (int i = 0; i < n; ++i)
      exchange[starts[rank] + i] = static_cast<Number>(scale[i] * b[i]);
    if (n_ranks > 1)
      MPI_Allgatherv(MPI_IN_PLACE,
                     0,
                     MPI_DATATYPE_NULL,
                     exchange.data(),
                     counts.data(),
                     starts.data(),
                     type,
                     comm);
    for (unsigned int i = 0; i < place.size(); ++i)
      vector[place[i]] = exchange[i];

    if (rank > 0) // what all have counts once
      for (const unsigned int i : common_places)
        vector[i] = 0;
    for (const unsigned int s : own)
      forward(s);
    if (!common.empty())
      {
        for (unsigned int i = 0; i < common_places.size(); ++i)
          exchange[i] = vector[common_places[i]];
        MPI_Allreduce(MPI_IN_PLACE,
                      exchange.data(),
                      static_cast<int>(common_places.size()),
                      type,
                      MPI_SUM,
                      comm);
        for (unsigned int i = 0; i < common_places.size(); ++i)
          vector[common_places[i]] = exchange[i];
        for (const unsigned int s : common)
          forward(s);
        for (auto s = common.rbegin(); s != common.rend(); ++s)
          backward(*s);
      }
    for (auto s = own.rbegin(); s != own.rend(); ++s)
      backward(*s);
    if (n_ranks > 1)
      {
        for (int i = part_starts[rank]; i < part_starts[rank + 1]; ++i)
          exchange[i] = vector[part_place[i]];
        MPI_Allgatherv(MPI_IN_PLACE,
                       0,
                       MPI_DATATYPE_NULL,
                       exchange.data(),
                       part_counts.data(),
                       part_starts.data(),
                       type,
                       comm);
        for (unsigned int i = 0; i < part_place.size(); ++i)
          vector[part_place[i]] = exchange[i];
      }
    for (int i = 0; i < n; ++i)
      x[i] = scale[i] * vector[place[starts[rank] + i]];
  }

  template class SparseCholesky<float>;
  template class SparseCholesky<double>;
} // namespace mortise
