// A small tied system without a mesh: two blocks of points joined by springs,
// each point with three displacements, tied point by point. It never needs more
// than a few milliseconds.
#pragma once

#include <deal.II/base/mpi.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <mortise/operators/block_system.h>

#include <vector>

namespace springs
{
  using namespace mortise;
  using Index = dealii::types::global_dof_index;

  struct Options
  {
    double stiffness  = 1.; ///< of all springs
    double length     = 1.; ///< unit of displacement: K / L^2 keeps energies
    double contrast   = 1.; ///< second block over first
    bool   tied       = true;
    bool   floating   = false; ///< the second block is held by the ties alone
    double gap        = 0.;    ///< g: the prescribed jump across the tie
    double load       = 1.;
    unsigned int size = 4;        ///< points per direction of a block
    unsigned int first_ranks = 0; ///< ranks that own dofs; 0: all
  };

  /// Points of block b are numbered after those of block 0; x runs fastest. The
  /// blocks lie side by side along x: the last layer of block 0 is tied to the
  /// first of block 1.
  class Builder
  {
  public:
    Builder(const Options &options, const MPI_Comm comm)
      : o(options)
      , n(options.size)
      , comm(comm)
    {
      const unsigned int rank  = dealii::Utilities::MPI::this_mpi_process(comm);
      unsigned int       ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
      if (o.first_ranks > 0)
        ranks = std::min(ranks, o.first_ranks);
      owned_points = share(2 * n * n * n, rank, ranks);
      owned_ties   = share(o.tied ? n * n : 0, rank, ranks);
    }

    /// f and g.
    SystemVector
    load(const BlockSystem &system) const
    {
      SystemVector rhs = system.zero_vector();
      for (unsigned int p = owned_points.first; p < owned_points.second; ++p)
        for (unsigned int d = 0; d < 3; ++d)
          if (!is_fixed(p))
            rhs.displacement[3 * p + d] =
              o.load * o.stiffness / o.length * ((p * 7 + d * 3) % 5 - 1.5);
      rhs.displacement.compress(dealii::VectorOperation::insert);
      for (unsigned int t = owned_ties.first; t < owned_ties.second; ++t)
        for (unsigned int d = 0; d < 3; ++d)
          rhs.multiplier[3 * t + d] = area(t) * o.gap * o.length * (1. + d);
      if (o.tied)
        rhs.multiplier.compress(dealii::VectorOperation::insert);
      return rhs;
    }

    BlockSystem
    build() const
    {
      BlockSystem system;
      system.communicator       = comm;
      system.owned_displacement = range(owned_points, 6 * n * n * n);
      system.owned_multiplier   = range(owned_ties, o.tied ? 3 * n * n : 0);
      fill_bulk(system);
      if (o.tied)
        fill_tie(system);
      for (unsigned int p = owned_points.first; p < owned_points.second; ++p)
        {
          system.entity_blocks.push_back({3 * p, 3 * p + 1, 3 * p + 2});
          for (unsigned int d = 0; d < 3; ++d)
            system.vertex_dofs.push_back(3 * p + d);
          system.vertex_points.push_back(position(p));
        }
      return system;
    }

  private:
    using Range = std::pair<unsigned int, unsigned int>;

    static Range
    share(const unsigned int total,
          const unsigned int rank,
          const unsigned int ranks)
    {
      if (rank >= ranks)
        return {total, total};
      return {total * rank / ranks, total * (rank + 1) / ranks};
    }

    static dealii::IndexSet
    range(const Range &points, const unsigned int size)
    {
      dealii::IndexSet set(size);
      set.add_range(3 * points.first, 3 * points.second);
      set.compress();
      return set;
    }

    unsigned int
    block(const unsigned int p) const
    {
      return p / (n * n * n);
    }

    dealii::Point<3>
    position(const unsigned int p) const
    {
      const unsigned int q = p % (n * n * n);
      return o.length * dealii::Point<3>(q % n + block(p) * (n - 1.),
                                         (q / n) % n,
                                         q / (n * n));
    }

    bool
    is_fixed(const unsigned int p) const
    {
      const unsigned int x = p % n;
      return (block(p) == 0 && x == 0) ||
             (block(p) == 1 && x == n - 1 && !o.floating);
    }

    /// What a tie counts.
    static double
    area(const unsigned int t)
    {
      return 1. + 0.1 * (t % 3);
    }

    /// Each spring between near points p, q: k (d (x) d + 0.2 I) on u_p - u_q.
    void
    fill_bulk(BlockSystem &system) const
    {
      const unsigned int             n_points = 2 * n * n * n;
      dealii::DynamicSparsityPattern pattern(3 * n_points,
                                             3 * n_points,
                                             system.owned_displacement);
      const auto near = [&](const unsigned int p, const unsigned int q) {
        return block(p) == block(q) &&
               position(p).distance(position(q)) < 1.8 * o.length;
      };
      for (unsigned int p = owned_points.first; p < owned_points.second; ++p)
        for (unsigned int q = 0; q < n_points; ++q)
          if (p == q || (near(p, q) && !is_fixed(p) && !is_fixed(q)))
            for (unsigned int c = 0; c < 9; ++c)
              pattern.add(3 * p + c / 3, 3 * q + c % 3);
      system.stiffness.reinit(system.owned_displacement,
                              system.owned_displacement,
                              pattern,
                              comm);
      for (unsigned int p = owned_points.first; p < owned_points.second; ++p)
        {
          const double k = o.stiffness / (o.length * o.length) *
                           (block(p) == 1 ? o.contrast : 1.);
          if (is_fixed(p))
            for (unsigned int d = 0; d < 3; ++d)
              system.stiffness.set(3 * p + d, 3 * p + d, k);
          else
            {
              dealii::SymmetricTensor<2, 3> diagonal;
              for (unsigned int q = 0; q < n_points; ++q)
                if (q != p && near(p, q))
                  {
                    const auto direction =
                      (position(p) - position(q)) / o.length;
                    const auto spring =
                      k * (dealii::symmetrize(
                             dealii::outer_product(direction, direction)) +
                           0.2 * dealii::unit_symmetric_tensor<3>());
                    diagonal += spring;
                    if (!is_fixed(q))
                      for (unsigned int c = 0; c < 9; ++c)
                        system.stiffness.set(3 * p + c / 3,
                                             3 * q + c % 3,
                                             -spring[c / 3][c % 3]);
                  }
              for (unsigned int c = 0; c < 9; ++c)
                system.stiffness.set(3 * p + c / 3,
                                     3 * p + c % 3,
                                     diagonal[c / 3][c % 3]);
            }
        }
      system.stiffness.compress(dealii::VectorOperation::insert);
    }

    /// Tie t joins one point of each block; scaled as a mass matrix would be.
    void
    fill_tie(BlockSystem &system) const
    {
      const auto slave = [&](const unsigned int t) {
        return (t % n) * n + (t / n) * n * n + n - 1;
      };
      const auto master = [&](const unsigned int t) {
        return slave(t) + n * n * n - (n - 1);
      };
      const double gamma =
        o.stiffness * std::min(1., o.contrast) / (o.length * o.length);
      const auto                     n_u = 6 * n * n * n, n_l = 3 * n * n;
      dealii::DynamicSparsityPattern b(n_l, n_u, system.owned_multiplier);
      dealii::DynamicSparsityPattern j(n_u, n_u, system.owned_displacement);
      for (unsigned int t = 0; t < n * n; ++t)
        for (unsigned int d = 0; d < 3; ++d)
          {
            const Index l = 3 * t + d, s = 3 * slave(t) + d,
                        m = 3 * master(t) + d;
            if (system.owned_multiplier.is_element(l))
              {
                b.add(l, s);
                b.add(l, m);
              }
            for (const Index row : {s, m})
              if (system.owned_displacement.is_element(row))
                for (const Index column : {s, m})
                  j.add(row, column);
          }
      for (const Index i : system.owned_displacement)
        j.add(i, i);
      SparseMatrix coupling;
      coupling.reinit(system.owned_multiplier,
                      system.owned_displacement,
                      b,
                      comm);
      system.jump_penalty.reinit(system.owned_displacement,
                                 system.owned_displacement,
                                 j,
                                 comm);
      for (unsigned int t = 0; t < n * n; ++t)
        for (unsigned int d = 0; d < 3; ++d)
          {
            const Index l = 3 * t + d, s = 3 * slave(t) + d,
                        m = 3 * master(t) + d;
            if (system.owned_multiplier.is_element(l))
              {
                coupling.set(l, s, area(t));
                coupling.set(l, m, -area(t));
              }
            for (const Index row : {s, m})
              if (system.owned_displacement.is_element(row))
                for (const Index column : {s, m})
                  system.jump_penalty.set(row,
                                          column,
                                          row == column ? gamma : -gamma);
          }
      for (auto *matrix : {&coupling, &system.jump_penalty})
        matrix->compress(dealii::VectorOperation::insert);
      system.coupling = CouplingMatrix(std::move(coupling));
    }

    const Options      o;
    const unsigned int n;
    const MPI_Comm     comm;
    Range              owned_points, owned_ties;
  };
} // namespace springs
