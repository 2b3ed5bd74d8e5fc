// See refined_corners.h.
#include <deal.II/base/mpi.h>

#include <deal.II/grid/cell_id.h>

#include <mortise/base/look_up.h>
#include <mortise/body/spaces/refined_corners.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index   = RefinedCorners::Index;
    using Entries = RefinedCorners::Entries;
    using Key     = std::array<unsigned int, 6>;

    /// What a rank knows of a corner.
    struct KnownCorner
    {
      Index   node = numbers::invalid_dof_index;
      Entries entries; ///< where it hangs

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &node &entries;
      }
    };

    unsigned int
    meeting_rank(const Key &key, const unsigned int n_ranks)
    {
      std::size_t hash = 0;
      for (const unsigned int part : key)
        hash = hash * 1000003 + part;
      return hash % n_ranks;
    }
  } // namespace

  RefinedCorners::RefinedCorners(const NodalSpace &vertices,
                                 const MPI_Comm    comm)
    : vertices(vertices)
  {
    for (const Body *body : vertices.bodies())
      {
        const unsigned int n = body->index + 1;
        parts.resize(std::max<std::size_t>(parts.size(), n));
        cell_nodes.resize(parts.size());
        find_parts(*body);
        cell_nodes[body->index].resize(
          body->triangulation().n_global_levels() > 1 ?
            body->triangulation().n_active_cells() :
            0);
      }
    vertices.for_each_cell(
      [&](const Body &body, const auto &cell, const auto &nodes) {
        if (auto &of_body = cell_nodes[body.index]; !of_body.empty())
          std::copy_n(nodes.begin(),
                      8,
                      of_body[cell->active_cell_index()].begin());
      });
    exchange(comm);
  }

  void
  RefinedCorners::find_parts(const Body &body)
  {
    const auto &mesh     = body.triangulation();
    auto       &by_level = parts[body.index];
    by_level.resize(mesh.n_levels());
    for (unsigned int level = mesh.n_levels(); level-- > 0;)
      {
        by_level[level].resize(mesh.n_raw_cells(level), none);
        for (const auto &cell : mesh.cell_iterators_on_level(level))
          {
            Part &part = by_level[level][cell->index()];
            if (cell->is_active())
              part = cell->is_locally_owned() ? all : none;
            else
              {
                unsigned int n_all = 0, n_none = 0;
                for (const auto &child : cell->child_iterators())
                  {
                    const Part of_child = by_level[level + 1][child->index()];
                    n_all += of_child == all;
                    n_none += of_child == none;
                  }
                part = n_all == cell->n_children()  ? all :
                       n_none == cell->n_children() ? none :
                                                      some;
              }
          }
      }
  }

  RefinedCorners::Index
  RefinedCorners::own_node(const Body         &body,
                           const CellIterator &cell,
                           const unsigned int  v) const
  {
    CellIterator at_corner = cell;
    while (at_corner->has_children())
      at_corner = at_corner->child(v);
    return at_corner->is_locally_owned() ?
             cell_nodes[body.index][at_corner->active_cell_index()][v] :
             numbers::invalid_dof_index;
  }

  RefinedCorners::Corner
  RefinedCorners::corner(const Body         &body,
                         const CellIterator &cell,
                         const unsigned int  v)
  {
    return {{body.index,
             static_cast<unsigned int>(cell->level()),
             static_cast<unsigned int>(cell->index()),
             v}};
  }

  RefinedCorners::Index
  RefinedCorners::node(const Body         &body,
                       const CellIterator &cell,
                       const unsigned int  v) const
  {
    const Index own = own_node(body, cell, v);
    if (own != numbers::invalid_dof_index)
      return own;
    const auto found = foreign.find(corner(body, cell, v));
    return found == foreign.end() ? numbers::invalid_dof_index : found->second;
  }

  void
  RefinedCorners::exchange(const MPI_Comm comm)
  {
    const unsigned int         n_ranks = Utilities::MPI::n_mpi_processes(comm);
    const auto                &hanging = vertices.hanging_nodes();
    std::map<Key, KnownCorner> known;
    std::map<Key, Corner>      wanted;
    std::set<Key>              asked;
    for (const Body *body : vertices.bodies())
      for (const auto &cell : body->triangulation().cell_iterators())
        if (parts[body->index][cell->level()][cell->index()] == some)
          for (unsigned int v = 0; v < 8; ++v)
            {
              Key        key;
              const auto id = cell->id().template to_binary<dim>();
              std::copy(id.begin(), id.end(), key.begin());
              key[4]          = body->index;
              key[5]          = v;
              const Index own = own_node(*body, cell, v);
              if (own == numbers::invalid_dof_index)
                {
                  asked.insert(key);
                  wanted[key] = corner(*body, cell, v);
                  continue;
                }
              KnownCorner &mine = known[key];
              mine.node         = own;
              if (const auto *entries = hanging.get_constraint_entries(own))
                mine.entries = *entries;
            }
    for (const auto &[key, found] : look_up(
           asked,
           known,
           [&](const Key &any) { return meeting_rank(any, n_ranks); },
           comm))
      {
        foreign[wanted.at(key)] = found.node;
        if (!found.entries.empty())
          foreign_lines[found.node] = found.entries;
      }
  }

  void
  RefinedCorners::add(const Index  node,
                      const double weight,
                      Entries     &entries) const
  {
    const auto add_one = [&](const Index index, const double value) {
      for (auto &entry : entries)
        if (entry.first == index)
          {
            entry.second += value;
            return;
          }
      entries.emplace_back(index, value);
    };
    const Entries *line = nullptr;
    if (const auto found = foreign_lines.find(node);
        found != foreign_lines.end())
      line = &found->second;
    else if (vertices.relevant_nodes().is_element(node))
      line = vertices.hanging_nodes().get_constraint_entries(node);
    if (line == nullptr)
      add_one(node, weight);
    else
      for (const auto &[master, factor] : *line)
        add_one(master, weight * factor);
  }
} // namespace mortise
