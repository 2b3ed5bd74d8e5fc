// See vertex_selection.h.
#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <mortise/operators/levels/vertex_selection.h>
#include <mortise/operators/levels/vertex_transfer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = VertexCoarsening::Index;

    /// In [0, 1), by the place over @p size, whoever owns it and whatever
    /// rounding left.
    double
    draw(const Tensor<1, dim> &place, const double size)
    {
      std::uint64_t number = 0;
      for (unsigned int c = 0; c < dim; ++c)
        {
          const auto place_on_grid =
            static_cast<std::uint64_t>(std::llround(place[c] / size * 1e7));
          number = (number ^ place_on_grid) * 0x9E3779B97F4A7C15U;
          number ^= number >> 29;
        }
      return static_cast<double>(number >> 11) /
             static_cast<double>(1ULL << 53);
    }

    /// Weights of the first @p n of @p offsets, ascending by length, whose sum is one:
    /// the less the farther, and such that the mean of offsets is zero. False
    /// where that is not possible since they are a plane or a line, about.
    bool
    interpolate_linear(const std::vector<Tensor<1, dim>> &offsets,
                       const unsigned int                 n,
                       std::vector<double>               &weights)
    {
      /// Of the squares of distances along a direction, over the largest.
      constexpr double least_spread = 1e-2, exact = 1e-8;

      const double   nearest = offsets[0].norm_square();
      double         sum     = 0.;
      Tensor<1, dim> mean;
      weights.clear();
      for (unsigned int k = 0; k < n; ++k)
        {
          weights.push_back(std::pow(nearest / offsets[k].norm_square(), 2));
          sum += weights[k];
          mean += weights[k] * offsets[k];
        }
      mean /= sum;
      SymmetricTensor<2, dim> covariance;
      for (unsigned int k = 0; k < n; ++k)
        {
          weights[k] /= sum;
          const auto d = offsets[k] - mean;
          covariance += weights[k] * symmetrize(outer_product(d, d));
        }
      Tensor<1, dim> slope, left = mean;
      const auto     directions = eigenvectors(covariance);
      for (const auto &[spread, direction] : directions)
        if (spread > least_spread * directions[0].first)
          {
            const double along = mean * direction;
            slope -= along / spread * direction;
            left -= along * direction;
          }
      for (unsigned int k = 0; k < n; ++k)
        weights[k] *= 1. + slope * (offsets[k] - mean);
      return left.norm_square() < exact * exact * nearest;
    }

    class Selection
    {
    public:
      explicit Selection(const VertexMatrix &fine)
        : blocks(fine.blocks)
        , layout(*fine.blocks.layout)
        , n_owned(fine.blocks.size())
        , place(fine.blocks.layout)
        , body(fine.blocks.layout)
      {
        for (unsigned int i = 0; i < n_owned; ++i)
          {
            for (unsigned int c = 0; c < dim; ++c)
              place.local_element(dim * i + c) = fine.points[i][c];
            body.local_element(dim * i) = fine.bodies[i];
          }
        place.update_ghost_values();
        body.update_ghost_values();
      }

      VertexCoarsening
      run()
      {
        select();
        find_near();
        VertexCoarsening result = number_kept();
        interpolate(result);
        return result;
      }

    private:
      Tensor<1, dim>
      at(const unsigned int node) const
      {
        Tensor<1, dim> x;
        for (unsigned int c = 0; c < dim; ++c)
          x[c] = place.local_element(dim * node + c);
        return x;
      }

      /// Local nodes of the same body that an owned one is coupled with.
      template <typename Visit>
      void
      for_each_neighbour(const unsigned int i, const Visit &visit) const
      {
        for (std::size_t k = blocks.begin[i]; k < blocks.begin[i + 1]; ++k)
          if (const unsigned int j = blocks.columns[k];
              j != i &&
              body.local_element(dim * j) == body.local_element(dim * i))
            visit(j);
      }

      /// In the order in which nodes get to stay, does @p i come before @p j?
      bool
      is_before(const LevelVector<double> &rank_of,
                const unsigned int         i,
                const unsigned int         j) const
      {
        const double of_i = rank_of.local_element(dim * i),
                     of_j = rank_of.local_element(dim * j);
        return of_i > of_j ||
               (of_i == of_j && layout.local_to_global(dim * i) <
                                  layout.local_to_global(dim * j));
      }

      /// The lowest coordinates, and the largest extent along an axis.
      std::pair<Point<dim>, double>
      bounds() const
      {
        std::vector<double> extremes(2 * dim,
                                     -std::numeric_limits<double>::max());
        for (unsigned int k = 0; k < dim * n_owned; ++k)
          {
            const double x          = place.local_element(k);
            extremes[k % dim]       = std::max(extremes[k % dim], -x);
            extremes[dim + k % dim] = std::max(extremes[dim + k % dim], x);
          }
        Utilities::MPI::max(extremes, layout.get_mpi_communicator(), extremes);
        std::pair<Point<dim>, double> result;
        for (unsigned int c = 0; c < dim; ++c)
          {
            result.first[c] = -extremes[c];
            result.second =
              std::max(result.second, extremes[c] + extremes[dim + c]);
          }
        return result;
      }

      /// Nodes of each body, of all ranks.
      std::vector<unsigned int>
      body_sizes() const
      {
        const MPI_Comm comm = layout.get_mpi_communicator();
        unsigned int   n    = 0;
        for (unsigned int i = 0; i < n_owned; ++i)
          n = std::max<unsigned int>(n, body.local_element(dim * i) + 1);
        std::vector<unsigned int> sizes(Utilities::MPI::max(n, comm));
        for (unsigned int i = 0; i < n_owned; ++i)
          ++sizes[body.local_element(dim * i)];
        Utilities::MPI::sum(sizes, comm, sizes);
        return sizes;
      }

      /// 0 inside a body, 1 on its faces, 2 on edges, 3 in corners, about.
      int
      sharpness(const unsigned int i) const
      {
        Tensor<1, dim> sum;
        double         length = 0.;
        for_each_neighbour(i, [&](const unsigned int j) {
          const auto d = at(j) - at(i);
          sum += d;
          length += d.norm();
        });
        const double lean = length > 0. ? sum.norm() / length : 1.;
        return lean > 0.7 ? 3 : lean > 0.5 ? 2 : lean > 0.25 ? 1 : 0;
      }

      /// The first in its neighbourhood stays, its neighbours go, until all are
      /// one or the other.
      void
      select()
      {
        LevelVector<double> rank_of(blocks.layout);
        state.reinit(blocks.layout);
        const std::vector<unsigned int> sizes = body_sizes();
        const auto [lowest, size]             = bounds();
        for (unsigned int i = 0; i < n_owned; ++i)
          {
            rank_of.local_element(dim * i) =
              sharpness(i) + draw(at(i) - lowest, size);
            if (sizes[body.local_element(dim * i)] < least_size)
              state.local_element(dim * i) = stays;
          }
        rank_of.update_ghost_values();
        for (bool open = true; open;)
          {
            state.update_ghost_values();
            std::vector<unsigned int> first;
            for (unsigned int i = 0; i < n_owned; ++i)
              if (state.local_element(dim * i) == undecided)
                {
                  bool is_first = true;
                  for_each_neighbour(i, [&](const unsigned int j) {
                    is_first =
                      is_first && (state.local_element(dim * j) != undecided ||
                                   is_before(rank_of, i, j));
                  });
                  if (is_first)
                    first.push_back(i);
                }
            for (const unsigned int i : first)
              state.local_element(dim * i) = stays;
            state.zero_out_ghost_values();
            state.update_ghost_values();
            int n_open = 0;
            for (unsigned int i = 0; i < n_owned; ++i)
              if (state.local_element(dim * i) == undecided)
                {
                  for_each_neighbour(i, [&](const unsigned int j) {
                    if (state.local_element(dim * j) == stays)
                      state.local_element(dim * i) = goes;
                  });
                  n_open += state.local_element(dim * i) == undecided;
                }
            state.zero_out_ghost_values();
            open =
              Utilities::MPI::sum(n_open, layout.get_mpi_communicator()) > 0;
          }
        state.update_ghost_values();
      }

      /// By local node: those that stay next to it, numbers of the fine level.
      void
      find_near()
      {
        VertexCoarsening own;
        for (unsigned int i = 0; i < n_owned; ++i)
          {
            own.begin.push_back(own.nodes.size());
            const auto add = [&](const unsigned int j) {
              if (state.local_element(dim * j) == stays)
                own.nodes.push_back(layout.local_to_global(dim * j) / dim);
            };
            add(i);
            for_each_neighbour(i, add);
          }
        own.begin.push_back(own.nodes.size());
        own.weights.resize(own.nodes.size());
        near       = interpolation_rows(layout, own);
        near_begin = {0};
        for (const unsigned int length : near.lengths)
          near_begin.push_back(near_begin.back() + length);
      }

      VertexCoarsening
      number_kept()
      {
        VertexCoarsening result;
        for (unsigned int i = 0; i < n_owned; ++i)
          if (state.local_element(dim * i) == stays)
            result.kept.push_back(i);
        result.owned =
          next_range(result.kept.size(), layout.get_mpi_communicator());
        return result;
      }

      void
      interpolate(VertexCoarsening &result) const
      {
        // what is near to neighbours, with its place and number
        IndexSet           needed(layout.size());
        std::vector<Index> nodes = near.nodes;
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        for (const Index node : nodes)
          if (!layout.in_local_range(dim * node))
            needed.add_range(dim * node, dim * node + dim);
        const MPI_Comm      comm = layout.get_mpi_communicator();
        LevelVector<double> positions(layout.locally_owned_range(),
                                      needed,
                                      comm),
          numbers(layout.locally_owned_range(), needed, comm);
        for (unsigned int i = 0; i < dim * n_owned; ++i)
          positions.local_element(i) = place.local_element(i);
        for (unsigned int k = 0; k < result.kept.size(); ++k)
          numbers.local_element(dim * result.kept[k]) =
            result.owned.nth_index_in_set(k);
        positions.update_ghost_values();
        numbers.update_ghost_values();

        std::vector<Index> candidates;
        for (unsigned int i = 0; i < n_owned; ++i)
          {
            result.begin.push_back(result.nodes.size());
            if (state.local_element(dim * i) == stays)
              {
                result.nodes.push_back(
                  static_cast<Index>(numbers.local_element(dim * i)));
                result.weights.push_back(1.);
                continue;
              }
            candidates.clear();
            const auto add = [&](const unsigned int j) {
              candidates.insert(candidates.end(),
                                near.nodes.begin() + near_begin[j],
                                near.nodes.begin() + near_begin[j + 1]);
            };
            add(i);
            for_each_neighbour(i, add);
            std::sort(candidates.begin(), candidates.end());
            candidates.erase(std::unique(candidates.begin(), candidates.end()),
                             candidates.end());
            add_row(at(i), candidates, positions, numbers, result);
          }
        result.begin.push_back(result.nodes.size());
      }

      void
      add_row(const Tensor<1, dim>      &x,
              const std::vector<Index>  &candidates,
              const LevelVector<double> &positions,
              const LevelVector<double> &numbers,
              VertexCoarsening          &result) const
      {
        std::vector<std::pair<Tensor<1, dim>, Index>> nearest;
        for (const Index node : candidates)
          {
            nearest.emplace_back(-x, node);
            for (unsigned int c = 0; c < dim; ++c)
              nearest.back().first[c] += positions(dim * node + c);
          }
        std::sort(nearest.begin(),
                  nearest.end(),
                  [](const auto &a, const auto &b) {
                    return std::make_pair(a.first.norm_square(), a.second) <
                           std::make_pair(b.first.norm_square(), b.second);
                  });
        std::vector<Tensor<1, dim>> offsets;
        for (const auto &[offset, node] : nearest)
          offsets.push_back(offset);
        // the nearest may lie in a plane beside x
        std::size_t n = std::min<std::size_t>(offsets.size(), n_nearest);
        std::vector<double> weights;
        while (!interpolate_linear(offsets, n, weights) && n < offsets.size())
          ++n;
        for (unsigned int k = 0; k < n; ++k)
          {
            result.nodes.push_back(
              static_cast<Index>(numbers(dim * nearest[k].second)));
            result.weights.push_back(weights[k]);
          }
      }

      static constexpr double undecided = 0., stays = 1., goes = 2.;
      /// Bodies of fewer nodes keep them: what is left must still turn.
      static constexpr unsigned int least_size = 20;
      /// That a value follows from: doc/measurements/tuning.md.
      static constexpr unsigned int n_nearest = 6;

      const BlockCsrMatrix              &blocks;
      const Utilities::MPI::Partitioner &layout;
      const unsigned int                 n_owned;
      LevelVector<double>                place, body, state;
      InterpolationRows                  near;
      std::vector<unsigned int>          near_begin;
    };
  } // namespace

  VertexCoarsening
  select_vertices(const VertexMatrix &fine)
  {
    return Selection(fine).run();
  }
} // namespace mortise
