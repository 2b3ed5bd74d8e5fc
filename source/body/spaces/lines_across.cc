// See lines_across.h.
#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <mortise/body/spaces/flat_bodies.h>
#include <mortise/body/spaces/lines_across.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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

    /// Between two nodes of a line that stay.
    constexpr unsigned int most_steps = 12;

    /// Numbers of those that stay, of @p n in a line; between cells, @p degree
    /// steps each, if that is possible.
    std::vector<unsigned int>
    kept_of_line(const unsigned int n, const unsigned int degree)
    {
      const unsigned int n_all  = n - 1;
      const bool         whole  = n_all % degree == 0;
      const unsigned int unit   = whole ? degree : 1;
      const unsigned int length = n_all / unit;
      for (unsigned int n_parts = (n_all + most_steps - 1) / most_steps;;
           ++n_parts)
        {
          std::vector<unsigned int> kept    = {0};
          unsigned int              longest = 0;
          for (unsigned int part = 1; part <= n_parts; ++part)
            {
              kept.push_back(unit * ((part * length + n_parts / 2) / n_parts));
              longest = std::max(longest, kept.back() - *(kept.end() - 2));
            }
          if (longest <= most_steps)
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
        add_others(result);
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
                 nodes_across(cell, space.degree(body, cell)).lines)
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

      /// Rows of the nodes that are on no line, from those of nodes that are.
      void
      add_others(std::vector<VertexCoarsening::Entries> &rows) const
      {
        // ends of lines, of any rank, and where between them a node is
        NodeVector first(label), second(label), part(label);
        for (unsigned int i = 0; i < rows.size(); ++i)
          {
            const double own        = space.owned_nodes().nth_index_in_set(i);
            first.local_element(i)  = rows[i].empty() ? own : rows[i][0].first;
            second.local_element(i) = rows[i].empty() ? own : rows[i][1].first;
            part.local_element(i)   = rows[i].empty() ? 0. : rows[i][1].second;
          }
        for (NodeVector *vector : {&first, &second, &part})
          vector->update_ghost_values();
        for_each_flat_cell(
          [&](const Body &body, const auto &cell, const auto &nodes) {
            if (!body.mesh.tetrahedra)
              return; // all its nodes lie on lines
            const auto across = nodes_across(cell, space.degree(body, cell));
            for (const auto &[i, entries] : across.others)
              if (space.owned_nodes().is_element(nodes[i]))
                {
                  std::map<Index, double> sum;
                  for (const auto &[k, weight] : entries)
                    {
                      const Index node = nodes[k];
                      sum[first(node)] += weight * (1. - part(node));
                      sum[second(node)] += weight * part(node);
                    }
                  auto &row =
                    rows[space.owned_nodes().index_within_set(nodes[i])];
                  row.clear();
                  for (const auto &entry : sum)
                    if (std::abs(entry.second) > 1e-12)
                      row.push_back(entry);
                }
          });
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
  } // namespace

  std::vector<VertexCoarsening::Entries>
  find_rows_across(const NodalSpace        &space,
                   const std::vector<bool> &flat,
                   const MPI_Comm           comm,
                   unsigned int            &n_steps)
  {
    return Lines(space, flat, comm).rows(n_steps);
  }
} // namespace mortise
