// See thickness_coarsening.h.
#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <mortise/body/spaces/flat_bodies.h>
#include <mortise/body/spaces/thickness_coarsening.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index      = NodalSpace::Index;
    using NodeVector = LinearAlgebra::distributed::Vector<double>;

    /// A node on its way to where its line is put in order.
    struct LineNode
    {
      double       line = 0.; ///< the least of its nodes
      Index        node = 0;
      double       x = 0., y = 0., z = 0.;
      unsigned int degree = 1; ///< of a cell

      Point<dim>
      position() const
      {
        return {x, y, z};
      }

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &line &node &x &y &z &degree;
      }
    };

    /// What a node's value follows from; nothing: it stays.
    struct NodeRow
    {
      Index                     node = 0;
      VertexCoarsening::Entries entries;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &node &entries;
      }
    };

    /// Along the line between the two nodes that are farthest apart.
    void
    sort_line(std::vector<LineNode> &line, std::vector<double> &heights)
    {
      const auto farthest = [&](const Point<dim> &from) {
        return std::max_element(line.begin(),
                                line.end(),
                                [&](const auto &a, const auto &b) {
                                  return from.distance_square(a.position()) <
                                         from.distance_square(b.position());
                                })
          ->position();
      };
      const Point<dim>     start  = farthest(line.front().position());
      const Tensor<1, dim> along  = farthest(start) - start;
      const auto           height = [&](const LineNode &node) {
        return (node.position() - start) * along;
      };
      std::sort(line.begin(), line.end(), [&](const auto &a, const auto &b) {
        return height(a) < height(b);
      });
      heights.clear();
      for (const LineNode &node : line)
        heights.push_back(height(node));
    }

    /// Numbers of those that stay, of @p n in a line; between cells, @p degree
    /// steps each, if that is possible.
    std::vector<unsigned int>
    kept_of_line(const unsigned int n, const unsigned int degree)
    {
      constexpr unsigned int most   = ThicknessCoarsening::max_steps_across;
      const unsigned int     n_all  = n - 1;
      const bool             whole  = n_all % degree == 0;
      const unsigned int     unit   = whole ? degree : 1;
      const unsigned int     length = n_all / unit;
      for (unsigned int n_parts = (n_all + most - 1) / most;; ++n_parts)
        {
          std::vector<unsigned int> kept    = {0};
          unsigned int              longest = 0;
          for (unsigned int part = 1; part <= n_parts; ++part)
            {
              kept.push_back(unit * ((part * length + n_parts / 2) / n_parts));
              longest = std::max(longest, kept.back() - *(kept.end() - 2));
            }
          if (longest <= most)
            return kept;
        }
    }

    class Lines
    {
    public:
      Lines(const NodalSpace        &space,
            const std::vector<bool> &flat,
            const MPI_Comm           comm)
        : space(space)
        , flat(flat)
        , comm(comm)
        , label(space.owned_nodes(), space.relevant_nodes(), comm)
        , firsts(Utilities::MPI::all_gather(
            comm,
            label.get_partitioner()->local_range().first))
      {}

      /// By owned node; of bodies that are not flat they are left empty.
      std::vector<VertexCoarsening::Entries>
      rows(unsigned int &n_steps)
      {
        find_labels();
        std::map<unsigned int, std::vector<NodeRow>> found;
        n_steps = 1;
        for (auto &[number, line] : collect())
          add_rows(line, n_steps, found);
        n_steps = Utilities::MPI::max(n_steps, comm);
        std::vector<VertexCoarsening::Entries> result(
          space.owned_nodes().n_elements());
        for (auto &[rank, rows] : Utilities::MPI::some_to_some(comm, found))
          for (NodeRow &row : rows)
            result[space.owned_nodes().index_within_set(row.node)] =
              std::move(row.entries);
        return result;
      }

    private:
      template <typename Visit>
      void
      for_each_flat_cell(const Visit &visit) const
      {
        space.for_each_cell(
          [&](const Body &body, const auto &cell, const auto &nodes) {
            if (flat[body.index])
              visit(body, cell, nodes);
          });
      }

      bool
      hangs(const Index node) const
      {
        return space.hanging_nodes().is_constrained(node);
      }

      /// Each node gets the least number of those on its line.
      void
      find_labels()
      {
        std::vector<std::vector<unsigned int>> parts; // local, of single cells
        for_each_flat_cell(
          [&](const Body &body, const auto &cell, const auto &nodes) {
            for (const auto &line :
                 lines_across(cell, space.degree(body, cell)))
              {
                std::vector<unsigned int> part;
                for (const unsigned int i : line)
                  if (!hangs(nodes[i]))
                    part.push_back(
                      label.get_partitioner()->global_to_local(nodes[i]));
                if (!part.empty())
                  parts.push_back(std::move(part));
              }
          });
        for (unsigned int i = 0; i < label.locally_owned_size(); ++i)
          label.local_element(i) = space.owned_nodes().nth_index_in_set(i);
        std::vector<double> local(label.locally_owned_size() +
                                  label.get_partitioner()->n_ghost_indices());
        for (bool changed = true; changed;)
          {
            label.update_ghost_values();
            std::copy_n(label.begin(), local.size(), local.begin());
            const bool here = lower(parts, local);
            label.zero_out_ghost_values(); // else it could not be compressed
            std::copy_n(local.begin(), local.size(), label.begin());
            label.compress(VectorOperation::min);
            changed = Utilities::MPI::max(here ? 1 : 0, comm) == 1;
          }
        label.update_ghost_values();
      }

      static bool
      lower(const std::vector<std::vector<unsigned int>> &parts,
            std::vector<double>                          &local)
      {
        bool any = false;
        for (bool changed = true; changed;)
          {
            changed = false;
            for (const auto &part : parts)
              {
                double least = std::numeric_limits<double>::max();
                for (const unsigned int i : part)
                  least = std::min(least, local[i]);
                for (const unsigned int i : part)
                  if (local[i] > least)
                    {
                      local[i] = least;
                      changed  = true;
                    }
              }
            any = any || changed;
          }
        return any;
      }

      /// All nodes of the lines whose least one is here.
      std::map<double, std::vector<LineNode>>
      collect() const
      {
        const auto       &owned = space.owned_nodes();
        std::vector<bool> done(owned.n_elements());
        std::map<unsigned int, std::vector<LineNode>> packages;
        for_each_flat_cell(
          [&](const Body &body, const auto &cell, const auto &nodes) {
            const unsigned int degree    = space.degree(body, cell);
            const auto         positions = straight_positions(cell, degree);
            for (unsigned int i = 0; i < nodes.size(); ++i)
              if (owned.is_element(nodes[i]) && !hangs(nodes[i]))
                if (const auto k = owned.index_within_set(nodes[i]); !done[k])
                  {
                    done[k]           = true;
                    const double line = label.local_element(k);
                    packages[rank_of(line)].push_back({line,
                                                       nodes[i],
                                                       positions[i][0],
                                                       positions[i][1],
                                                       positions[i][2],
                                                       degree});
                  }
          });
        std::map<double, std::vector<LineNode>> lines;
        for (const auto &[rank, package] :
             Utilities::MPI::some_to_some(comm, packages))
          for (const LineNode &node : package)
            lines[node.line].push_back(node);
        return lines;
      }

      void
      add_rows(std::vector<LineNode>                        &line,
               unsigned int                                 &n_steps,
               std::map<unsigned int, std::vector<NodeRow>> &found) const
      {
        std::vector<double> heights;
        sort_line(line, heights);
        const auto kept = kept_of_line(line.size(), line.front().degree);
        for (unsigned int part = 0; part + 1 < kept.size(); ++part)
          {
            const unsigned int a = kept[part], b = kept[part + 1];
            n_steps = std::max(n_steps, b - a);
            for (unsigned int i = a + 1; i < b; ++i)
              {
                const double length = heights[b] - heights[a];
                const double s =
                  length > 0. ? (heights[i] - heights[a]) / length : 0.5;
                found[rank_of(line[i].node)].push_back(
                  {line[i].node, {{line[a].node, 1. - s}, {line[b].node, s}}});
              }
          }
      }

      unsigned int
      rank_of(const Index node) const
      {
        return std::upper_bound(firsts.begin(), firsts.end(), node) -
               firsts.begin() - 1;
      }

      const NodalSpace        &space;
      const std::vector<bool> &flat;
      const MPI_Comm           comm;
      NodeVector               label;
      std::vector<Index>       firsts; ///< by rank
    };

    /// Values of degree one at the nodes of bodies that are not flat, but for
    /// those of @p kept.
    void
    add_linear_rows(const NodalSpace                       &space,
                    const std::vector<bool>                &flat,
                    const NodeVector                       &kept,
                    std::vector<VertexCoarsening::Entries> &rows)
    {
      const auto &owned = space.owned_nodes();
      space.for_each_cell(
        [&](const Body &body, const auto &cell, const auto &nodes) {
          const unsigned int degree = space.degree(body, cell);
          if (flat[body.index] || degree == 1)
            return;
          const FullMatrix<double> values = linear_values(cell, degree);
          for (unsigned int i = cell->n_vertices(); i < nodes.size(); ++i)
            if (owned.is_element(nodes[i]))
              if (auto &row = rows[owned.index_within_set(nodes[i])];
                  row.empty() && kept(nodes[i]) == 0.)
                for (const unsigned int v : cell->vertex_indices())
                  if (values(i, v) > 1e-12)
                    row.emplace_back(nodes[v], values(i, v));
        });
    }

    /// 1 at those nodes, which are given on any rank.
    NodeVector
    marked(const std::vector<Index> &nodes,
           const NodalSpace         &space,
           const MPI_Comm            comm)
    {
      IndexSet relevant(space.owned_nodes().size());
      relevant.add_indices(nodes.begin(), nodes.end());
      NodeVector result(space.owned_nodes(), relevant, comm);
      for (const Index node : nodes)
        result(node) = 1.;
      result.compress(VectorOperation::max);
      return result;
    }
  } // namespace

  bool
  coarsens_across_thickness(const std::vector<const Body *> &bodies)
  {
    const std::vector<bool> flat = find_flat_bodies(bodies);
    bool                    any = false, all = true;
    for (unsigned int i = 0; i < bodies.size(); ++i)
      {
        any = any || flat[i];
        all = all && (flat[i] || bodies[i]->max_degree() == 1 ||
                      !bodies[i]->triangulation().has_hanging_nodes());
      }
    return any && all;
  }

  ThicknessCoarsening
  make_thickness_coarsening(const NodalSpace         &nodes,
                            const std::vector<Index> &kept,
                            const MPI_Comm            comm)
  {
    ThicknessCoarsening result;
    result.flat = find_flat_bodies(nodes.bodies());
    auto rows   = Lines(nodes, result.flat, comm).rows(result.n_steps);
    add_linear_rows(nodes, result.flat, marked(kept, nodes, comm), rows);
    std::vector<unsigned int> all(rows.size());
    std::iota(all.begin(), all.end(), 0);
    result.functions = coarsen_by(nodes, rows, all, comm);
    return result;
  }
} // namespace mortise
