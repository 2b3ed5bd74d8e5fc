// See constraint_penalty.h.
#include <mortise/operators/levels/constraint_penalty.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// f of the header.
    constexpr double strength = 300.;

    /// The sum of b^2 over displacements that are free, b the entries of B, and
    /// the least of their D^{-1}: of a row of B_c, or of a multiplier.
    struct Reach
    {
      double square = 0., least = std::numeric_limits<double>::max();

      void
      add(const Reach &other, const double factor)
      {
        square += factor * factor * other.square;
        if (factor != 0.)
          least = std::min(least, other.least);
      }
    };

    std::vector<Reach>
    reach_of_rows(const CouplingMatrix &B, const Vector &diagonal)
    {
      Vector inverse(diagonal);
      for (unsigned int i = 0; i < inverse.locally_owned_size(); ++i)
        inverse.local_element(i) = 1. / inverse.local_element(i);
      const std::vector<double> flexibility = B.on_columns(inverse);
      std::vector<Reach>        result(B.scalar().n_rows());
      for (unsigned int i = 0; i < result.size(); ++i)
        {
          const auto row = B.scalar().row(B.representative(i));
          for (unsigned int k = 0; k < row.length; ++k)
            if (const double of_node =
                  flexibility[dim * row.columns[k] + B.component(i)];
                of_node > 0.)
              result[i].add({1., of_node}, row.values[k]);
        }
      return result;
    }

    /// By owned multiplier.
    std::vector<Reach>
    reach_of_multipliers(const CouplingMatrix     &B,
                         const std::vector<Reach> &of_rows)
    {
      if (!B.has_frames())
        return of_rows;
      std::vector<double> squares, least;
      for (const Reach &reach : of_rows)
        {
          squares.push_back(reach.square);
          least.push_back(reach.least);
        }
      squares = B.frames().on_columns(squares.data());
      least   = B.frames().on_columns(least.data());
      std::vector<Reach> result(B.frames().n_rows());
      for (unsigned int m = 0; m < result.size(); ++m)
        {
          const auto row = B.frames().row(m);
          for (unsigned int k = 0; k < row.length; ++k)
            result[m].add({squares[row.columns[k]], least[row.columns[k]]},
                          row.values[k]);
        }
      return result;
    }

    /// By row of the scalar matrix, of the owned ones that multipliers with
    /// @p stiffness move.
    std::map<unsigned int, Tensor<2, dim>>
    stiffness_of_rows(const CouplingMatrix      &B,
                      const std::vector<double> &stiffness)
    {
      std::map<unsigned int, Tensor<2, dim>> result;
      if (!B.has_frames())
        {
          for (unsigned int i = 0; i < stiffness.size(); ++i)
            if (stiffness[i] > 0.)
              result[B.representative(i)][B.component(i)][B.component(i)] +=
                stiffness[i];
          return result;
        }
      const SparseMatrix        frames = B.frames().transposed();
      const std::vector<double> on_columns =
        frames.on_columns(stiffness.data());
      std::map<std::pair<unsigned int, unsigned int>, Tensor<1, dim>>
        directions; // by row and multiplier
      for (unsigned int i = 0; i < frames.n_rows(); ++i)
        {
          const auto row = frames.row(i);
          for (unsigned int k = 0; k < row.length; ++k)
            if (on_columns[row.columns[k]] > 0.)
              directions[{B.representative(i), row.columns[k]}]
                        [B.component(i)] += row.values[k];
        }
      for (const auto &[at, direction] : directions)
        result[at.first] +=
          on_columns[at.second] * outer_product(direction, direction);
      return result;
    }
  } // namespace

  std::vector<ConstraintPenalty>
  find_constraint_penalties(const CouplingMatrix                   &coupling,
                            const Vector                           &diagonal,
                            const std::vector<double>              &compliance,
                            const std::optional<std::vector<bool>> &active)
  {
    const std::vector<Reach> reach =
      reach_of_multipliers(coupling, reach_of_rows(coupling, diagonal));
    std::vector<double> stiffness(reach.size());
    for (unsigned int m = 0; m < reach.size(); ++m)
      if (reach[m].square > 0. && (!active || (*active)[m]))
        stiffness[m] = 1. / (reach[m].square * reach[m].least / strength +
                             (compliance.empty() ? 0. : compliance[m]));
    std::vector<ConstraintPenalty> jumps;
    for (const auto &[i, of_row] : stiffness_of_rows(coupling, stiffness))
      {
        jumps.push_back({{}, of_row});
        const auto row = coupling.scalar().row(i);
        for (unsigned int k = 0; k < row.length; ++k)
          jumps.back().entries.emplace_back(
            coupling.scalar().global_column(row.columns[k]), row.values[k]);
      }
    return jumps;
  }

  std::vector<types::global_dof_index>
  nodes_beside_flat_bodies(const std::vector<ConstraintPenalty> &jumps,
                           const NodalSpace                     &space,
                           const std::vector<bool>              &flat,
                           const MPI_Comm                        comm)
  {
    std::vector<types::global_dof_index> nodes;
    for (const ConstraintPenalty &jump : jumps)
      for (const auto &entry : jump.entries)
        nodes.push_back(entry.first);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    IndexSet relevant(space.owned_nodes().size());
    relevant.add_indices(nodes.begin(), nodes.end());
    LevelVector<double> is_flat(space.owned_nodes(), relevant, comm);
    space.for_each_cell(
      [&](const Body &body, const auto &, const auto &of_cell) {
        for (const auto node : of_cell)
          if (flat[body.index] && space.owned_nodes().is_element(node))
            is_flat(node) = 1.;
      });
    is_flat.update_ghost_values();
    std::vector<types::global_dof_index> result;
    for (const ConstraintPenalty &jump : jumps)
      {
        const auto is = [&](const auto &entry) {
          return is_flat(entry.first) != 0.;
        };
        if (std::any_of(jump.entries.begin(), jump.entries.end(), is))
          for (const auto &entry : jump.entries)
            if (!is(entry))
              result.push_back(entry.first);
      }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }
} // namespace mortise
