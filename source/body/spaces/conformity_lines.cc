#include <deal.II/dofs/dof_tools.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/spaces/conformity_lines.h>
#include <mortise/body/spaces/hp_constraints.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  ConformityLines::ConformityLines(const DoFHandler<3> &dof_handler,
                                   const EntityDegrees &degrees)
    : dof_handler(dof_handler)
    , degrees(degrees)
    , owned(dof_handler.locally_owned_dofs())
    , owned_done(owned.n_elements(), false)
  {
    const auto &fes = dof_handler.get_fe_collection();
    if (fes[0].reference_cell() != ReferenceCells::Hexahedron)
      return;
    faces.resize(fes.size());
    for (unsigned int i = 0; i < fes.size(); ++i)
      for (unsigned int f = 0; f < 6; ++f)
        faces[i][f] = face_dof_indices(fes[i].degree, f);
  }

  unsigned int
  ConformityLines::line_dof(const CellIterator &cell,
                            const unsigned int  l,
                            const unsigned int  i,
                            const unsigned int  c) const
  {
    const auto &fe = cell->get_fe();
    return fe.component_to_system_index(
      c,
      i < 2 ? GeometryInfo<3>::line_to_cell_vertices(l, i) :
              GeometryInfo<3>::vertices_per_cell + l * (fe.degree - 1) + i - 2);
  }

  unsigned int
  ConformityLines::face_dof(const CellIterator &cell,
                            const unsigned int  f,
                            const unsigned int  i,
                            const unsigned int  j,
                            const unsigned int  c) const
  {
    const auto &fe = cell->get_fe();
    return fe.component_to_system_index(
      c, faces[cell->active_fe_index()][f][i + (fe.degree + 1) * j]);
  }

  void
  ConformityLines::make(AffineConstraints<double> &constraints)
  {
    if (degrees.one_degree() &&
        !dof_handler.get_triangulation().has_hanging_nodes())
      {
        constraints.reinit(all_dofs());
        return;
      }
    make_lines();
    constraints.reinit(all_dofs());
    for (const Line &line : lines)
      {
        constraints.add_line(line.dof);
        constraints.add_entries(line.dof, line.entries);
      }
    complete_constraints(dof_handler, constraints);
  }

  void
  ConformityLines::make_lines()
  {
    find_coarse_lines();
    const auto read = [&](const CellIterator &cell) {
      own.resize(cell->get_fe().n_dofs_per_cell());
      cell->get_dof_indices(own);
    };
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->level() > 0)
        {
          read(cell);
          for (const unsigned int l : cell->line_indices())
            find_hanging_line(cell, l);
          for (const unsigned int f : cell->face_indices())
            if (!cell->at_boundary(f) && cell->neighbor_is_coarser(f))
              find_hanging_face(cell, f);
        }
    if (!degrees.one_degree())
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            read(cell);
            constrain_mixed_degrees(cell);
          }
  }

  void
  ConformityLines::find_coarse_lines()
  {
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int l : cell->line_indices())
          if (cell->line(l)->has_children())
            coarse_lines.emplace(cell->line_index(l), std::make_pair(cell, l));
  }

  bool
  ConformityLines::start_line(const Index dof)
  {
    if (owned.is_element(dof))
      {
        const auto place = owned.index_within_set(dof);
        if (owned_done[place])
          return false;
        owned_done[place] = true;
      }
    else if (!other_done.emplace(dof, true).second)
      return false;
    lines.push_back({dof, {}});
    return true;
  }

  namespace
  {
    /// Direction of each line of a cell.
    constexpr unsigned int line_direction[12] =
      {1, 1, 0, 0, 1, 1, 0, 0, 2, 2, 2, 2};

    /// Number of @p cell among the children of its parent: its bits say which half of the parent
    /// it fills in each direction.
    unsigned int
    child_number(const ConformityLines::CellIterator &cell)
    {
      const auto parent = cell->parent();
      for (unsigned int c = 0; c < 8; ++c)
        if (parent->child_index(c) == cell->index())
          return c;
      Assert(false, ExcInternalError());
      return 0;
    }
  } // namespace

  void
  ConformityLines::find_hanging_line(const CellIterator &cell,
                                     const unsigned int  l)
  {
    // The cell's line l is half of its parent's line l if the cell touches
    // that line.
    const unsigned int child = child_number(cell);
    const unsigned int half  = (child >> line_direction[l]) & 1;
    if (GeometryInfo<3>::line_to_cell_vertices(l, half) != child)
      return;
    const auto coarse = coarse_lines.find(cell->parent()->line_index(l));
    if (coarse != coarse_lines.end())
      constrain_hanging_line(
        cell, l, half, coarse->second.first, coarse->second.second);
  }

  void
  ConformityLines::find_hanging_face(const CellIterator &cell,
                                     const unsigned int  f)
  {
    const auto         parent   = cell->parent();
    const CellIterator neighbor = cell->neighbor(f);
    const unsigned int face     = cell->neighbor_of_coarser_neighbor(f).first;
    const unsigned int child    = child_number(cell);
    constrain_hanging_face(
      {cell,
       f,
       {(child >> ((f / 2 + 1) % 3)) & 1, (child >> ((f / 2 + 2) % 3)) & 1},
       neighbor,
       face,
       parent->face_orientation(f) != neighbor->face_orientation(face)});
  }

  IndexSet
  ConformityLines::all_dofs() const
  {
    IndexSet set;
    DoFTools::extract_locally_relevant_dofs(dof_handler, set);
    std::vector<Index> more;
    for (const Line &line : lines)
      for (const auto &entry : line.entries)
        if (!set.is_element(entry.first))
          more.push_back(entry.first);
    std::sort(more.begin(), more.end());
    set.add_indices(more.begin(), std::unique(more.begin(), more.end()));
    set.compress();
    return set;
  }
} // namespace mortise
