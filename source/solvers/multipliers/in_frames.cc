// The Schur complement of multipliers along normals, in_frames().
#include <deal.II/base/mpi.h>

#include <mortise/base/types.h>
#include <mortise/solvers/multipliers/weighted_square.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// What of a node a multiplier is.
    struct RowFrame
    {
      SparseMatrix::Index     multiplier;
      std::array<double, dim> weight;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &multiplier &weight[0] & weight[1] & weight[2];
      }
    };

    /// The frames at the nodes of the rows by component, by global node: those
    /// of other ranks as far as columns refer to them.
    class FramesOfNodes
    {
    public:
      FramesOfNodes(const NodalMatrix &C, const SparseMatrix &frames)
        : comm(frames.communicator())
        , of_owned(C.size())
      {
        const auto sizes = Utilities::MPI::all_gather(comm, int(C.size()));
        firsts           = {0};
        for (const int size : sizes)
          firsts.push_back(firsts.back() + size);
        first = firsts[Utilities::MPI::this_mpi_process(comm)];
        collect_owned(C, frames);
        fetch_others(C);
      }

      const std::vector<RowFrame> &
      owned(const unsigned int node) const
      {
        return of_owned[node];
      }

      const std::vector<RowFrame> &
      operator()(const int node) const
      {
        return is_owned(node) ? of_owned[node - first] : others.at(node);
      }

    private:
      bool
      is_owned(const int node) const
      {
        return node >= first &&
               node < first + static_cast<int>(of_owned.size());
      }

      void
      collect_owned(const NodalMatrix &C, const SparseMatrix &frames)
      {
        const SparseMatrix transposed = frames.transposed();
        for (unsigned int i = 0; i < C.entries.size(); ++i)
          if (C.entries[i] >= 0)
            {
              const auto row  = transposed.row(C.entries[i]);
              auto      &list = of_owned[i / dim];
              for (unsigned int k = 0; k < row.length; ++k)
                {
                  const auto multiplier =
                    transposed.global_column(row.columns[k]);
                  auto found =
                    std::find_if(list.begin(), list.end(), [&](const auto &f) {
                      return f.multiplier == multiplier;
                    });
                  if (found == list.end())
                    found = list.insert(list.end(), {multiplier, {}});
                  found->weight[i % dim] = row.values[k];
                }
            }
      }

      void
      fetch_others(const NodalMatrix &C)
      {
        std::map<unsigned int, std::vector<int>> wanted;
        for (const int node : C.columns)
          if (!is_owned(node) &&
              others.emplace(node, std::vector<RowFrame>()).second)
            wanted[std::upper_bound(firsts.begin(), firsts.end(), node) -
                   firsts.begin() - 1]
              .push_back(node);
        std::map<unsigned int, std::vector<std::vector<RowFrame>>> answers;
        for (const auto &[rank, nodes] :
             Utilities::MPI::some_to_some(comm, wanted))
          for (const int node : nodes)
            answers[rank].push_back(of_owned[node - first]);
        for (const auto &[rank, lists] :
             Utilities::MPI::some_to_some(comm, answers))
          for (unsigned int i = 0; i < lists.size(); ++i)
            others[wanted[rank][i]] = lists[i];
      }

      const MPI_Comm                       comm;
      std::vector<int>                     firsts; ///< nodes, by rank
      int                                  first = 0;
      std::vector<std::vector<RowFrame>>   of_owned;
      std::map<int, std::vector<RowFrame>> others;
    };
  } // namespace

  NodalMatrix
  in_frames(const NodalMatrix &C, const SparseMatrix &frames)
  {
    const FramesOfNodes              frames_of(C, frames);
    std::vector<SparseMatrix::Entry> entries;
    const int                       *columns = C.columns.data();
    const double                    *values  = C.values.data();
    for (unsigned int i = 0; i < C.size(); ++i)
      {
        const unsigned int n = C.lengths[i];
        for (const RowFrame &row : frames_of.owned(i))
          for (unsigned int k = 0; k < n; ++k)
            for (const RowFrame &column : frames_of(columns[k]))
              {
                double sum = 0.;
                for (unsigned int c = 0; c < dim; ++c)
                  sum += row.weight[c] * column.weight[c] *
                         values[(C.variants[i] == 1 ? 0 : c * n) + k];
                entries.push_back({row.multiplier, column.multiplier, sum});
              }
        columns += n;
        values += n * C.variants[i];
      }
    return rows_as_nodes(SparseMatrix(
      frames.rows(), frames.rows(), frames.communicator(), entries));
  }
} // namespace mortise
