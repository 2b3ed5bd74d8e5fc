#include <deal.II/dofs/dof_tools.h>

#include <mortise/body/fe_legendre.h>
#include <mortise/body/hp_constraints.h>
#include <mortise/body/legendre_basis.h>

#include <algorithm>
#include <unordered_map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using CellIterator = EntityDegrees::CellIterator;
    using Dofs         = std::vector<types::global_dof_index>;

    /// Direction of each line of a cell.
    constexpr unsigned int line_direction[12] =
      {1, 1, 0, 0, 1, 1, 0, 0, 2, 2, 2, 2};

    /// One degree of freedom as a combination of others (of none: zero).
    struct Line
    {
      types::global_dof_index                                 dof;
      std::vector<std::pair<types::global_dof_index, double>> entries;
    };

    /// Hexahedra: local degrees of freedom of one component of elements
    /// FESystem(FE_Legendre(p), n): tensor functions of lines and faces, in the
    /// order of evaluate_lobatto().
    class LocalNumbering
    {
    public:
      explicit LocalNumbering(const FiniteElement<3> &fe)
        : n(fe.degree + 1)
        , fe(fe)
      {
        for (unsigned int f = 0; f < 6; ++f)
          faces[f] = face_dof_indices(fe.degree, f);
      }

      unsigned int
      on_face(const unsigned int f,
              const unsigned int i,
              const unsigned int j,
              unsigned int       c) const
      {
        return fe.component_to_system_index(c, faces[f][i + n * j]);
      }

      unsigned int
      on_line(const unsigned int l,
              const unsigned int i,
              const unsigned int c) const
      {
        // A line's ends are its vertices, its bubbles its own.
        const unsigned int scalar =
          i < 2 ? GeometryInfo<3>::line_to_cell_vertices(l, i) :
                  8 + l * (n - 2) + i - 2;
        return fe.component_to_system_index(c, scalar);
      }

      const unsigned int n; ///< functions per direction

    private:
      const FiniteElement<3>   &fe;
      std::vector<unsigned int> faces[6];
    };

    /// Makes the lines of all constraints of this rank's cells.
    class ConformityLines
    {
    public:
      ConformityLines(const DoFHandler<3> &dof_handler,
                      const EntityDegrees &degrees);

      void
      make();

      std::vector<Line> lines;

    private:
      void
      find_coarse_lines();
      void
      constrain_hanging_face(const CellIterator &cell, unsigned int f);
      void
      constrain_hanging_line(const CellIterator &cell, unsigned int l);
      void
      constrain_mixed_degrees(const CellIterator &cell);
      bool
      start_line(types::global_dof_index dof);

      const DoFHandler<3>        &dof_handler;
      const EntityDegrees        &degrees;
      std::vector<LocalNumbering> numbering; ///< by element; hexahedra
      IndexSet                    owned;     ///< of this rank
      std::vector<bool> owned_done;          ///< constrained, by place in owned
      std::unordered_map<types::global_dof_index, bool> other_done;
      /// Refined lines of active cells: line index -> such a cell and its
      /// number there.
      std::unordered_map<unsigned int, std::pair<CellIterator, unsigned int>>
           coarse_lines;
      Dofs own, masters;
    };

    ConformityLines::ConformityLines(const DoFHandler<3> &dof_handler,
                                     const EntityDegrees &degrees)
      : dof_handler(dof_handler)
      , degrees(degrees)
      , owned(dof_handler.locally_owned_dofs())
      , owned_done(owned.n_elements(), false)
    {
      const auto &fes = dof_handler.get_fe_collection();
      numbering.reserve(fes.size());
      if (fes[0].reference_cell() == ReferenceCells::Hexahedron)
        for (unsigned int i = 0; i < fes.size(); ++i)
          numbering.emplace_back(fes[i]);
    }

    void
    ConformityLines::make()
    {
      find_coarse_lines();
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->level() > 0)
          {
            own.resize(cell->get_fe().n_dofs_per_cell());
            cell->get_dof_indices(own);
            for (const unsigned int l : cell->line_indices())
              constrain_hanging_line(cell, l);
            for (const unsigned int f : cell->face_indices())
              if (!cell->at_boundary(f) && cell->neighbor_is_coarser(f))
                constrain_hanging_face(cell, f);
          }
      if (!degrees.one_degree())
        for (const auto &cell : dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            constrain_mixed_degrees(cell);
    }

    void
    ConformityLines::find_coarse_lines()
    {
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          for (const unsigned int l : cell->line_indices())
            if (cell->line(l)->has_children())
              coarse_lines.emplace(cell->line_index(l),
                                   std::make_pair(cell, l));
    }

    /// Begin the constraint of @p dof unless it has one already.
    bool
    ConformityLines::start_line(const types::global_dof_index dof)
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

    /// Number of @p cell among the children of its parent: its bits say which half of the parent
    /// it fills in each direction.
    unsigned int
    child_number(const CellIterator &cell)
    {
      const auto parent = cell->parent();
      for (unsigned int c = 0; c < 8; ++c)
        if (parent->child_index(c) == cell->index())
          return c;
      Assert(false, ExcInternalError());
      return 0;
    }

    void
    ConformityLines::constrain_hanging_line(const CellIterator &cell,
                                            const unsigned int  l)
    {
      // The cell's line l is half of its parent's line l if the cell touches
      // that line.
      const unsigned int child = child_number(cell);
      const unsigned int d     = line_direction[l];
      const unsigned int half  = (child >> d) & 1;
      if (GeometryInfo<3>::line_to_cell_vertices(l, half) != child)
        return;
      const auto coarse = coarse_lines.find(cell->parent()->line_index(l));
      if (coarse == coarse_lines.end())
        return;

      const auto &[neighbor, line]    = coarse->second;
      const LocalNumbering &fine_dofs = numbering[cell->active_fe_index()];
      const LocalNumbering &coarse_dofs =
        numbering[neighbor->active_fe_index()];
      const FullMatrix<double> &restriction = lobatto_restriction(half);
      degrees.get_master_dofs(neighbor, masters);
      for (unsigned int c = 0; c < cell->get_fe().n_components(); ++c)
        for (unsigned int i = 0; i < fine_dofs.n; ++i)
          // The end that is one of the parent's as well does not hang.
          if (i != half && start_line(own[fine_dofs.on_line(l, i, c)]))
            for (unsigned int a = 0; a < coarse_dofs.n; ++a)
              {
                const types::global_dof_index master =
                  masters[coarse_dofs.on_line(line, a, c)];
                if (restriction(i, a) != 0. &&
                    master != numbers::invalid_dof_index)
                  lines.back().entries.emplace_back(master, restriction(i, a));
              }
    }

    void
    ConformityLines::constrain_hanging_face(const CellIterator &cell,
                                            const unsigned int  f)
    {
      const auto         parent   = cell->parent();
      const auto         neighbor = cell->neighbor(f);
      const unsigned int face     = cell->neighbor_of_coarser_neighbor(f).first;
      const bool         transposed =
        parent->face_orientation(f) != neighbor->face_orientation(face);
      const unsigned int        child     = child_number(cell);
      const unsigned int        half[2]   = {(child >> ((f / 2 + 1) % 3)) & 1,
                                             (child >> ((f / 2 + 2) % 3)) & 1};
      const FullMatrix<double> &along_i   = lobatto_restriction(half[0]);
      const FullMatrix<double> &along_j   = lobatto_restriction(half[1]);
      const LocalNumbering     &fine_dofs = numbering[cell->active_fe_index()];
      const LocalNumbering     &coarse_dofs =
        numbering[neighbor->active_fe_index()];
      degrees.get_master_dofs(neighbor, masters);
      for (unsigned int c = 0; c < cell->get_fe().n_components(); ++c)
        for (unsigned int j = 0; j < fine_dofs.n; ++j)
          for (unsigned int i = 0; i < fine_dofs.n; ++i)
            // The corner that is one of the parent's as well does not hang.
            if (!(i == half[0] && j == half[1]) &&
                start_line(own[fine_dofs.on_face(f, i, j, c)]))
              for (unsigned int b = 0; b < coarse_dofs.n; ++b)
                for (unsigned int a = 0; a < coarse_dofs.n; ++a)
                  {
                    const double weight = along_i(i, a) * along_j(j, b);
                    if (weight == 0.)
                      continue;
                    const types::global_dof_index master =
                      masters[transposed ? coarse_dofs.on_face(face, b, a, c) :
                                           coarse_dofs.on_face(face, a, b, c)];
                    if (master != numbers::invalid_dof_index)
                      lines.back().entries.emplace_back(master, weight);
                  }
    }

    void
    ConformityLines::constrain_mixed_degrees(const CellIterator &cell)
    {
      own.resize(cell->get_fe().n_dofs_per_cell());
      cell->get_dof_indices(own);
      degrees.get_master_dofs(cell, masters);
      for (unsigned int i = 0; i < own.size(); ++i)
        if (masters[i] != own[i] && start_line(own[i]))
          if (masters[i] != numbers::invalid_dof_index)
            lines.back().entries.emplace_back(masters[i], 1.);
    }

    /// Locally relevant degrees of freedom and every one that @p lines refer to.
    IndexSet
    all_dofs(const DoFHandler<3> &dof_handler, const std::vector<Line> &lines)
    {
      IndexSet set;
      DoFTools::extract_locally_relevant_dofs(dof_handler, set);
      std::vector<types::global_dof_index> more;
      for (const Line &line : lines)
        for (const auto &entry : line.entries)
          if (!set.is_element(entry.first))
            more.push_back(entry.first);
      std::sort(more.begin(), more.end());
      set.add_indices(more.begin(), std::unique(more.begin(), more.end()));
      set.compress();
      return set;
    }
  } // namespace

  void
  make_conformity_constraints(const DoFHandler<3>       &dof_handler,
                              AffineConstraints<double> &constraints)
  {
    make_conformity_constraints(dof_handler,
                                EntityDegrees(dof_handler),
                                constraints);
  }

  void
  make_conformity_constraints(const DoFHandler<3>       &dof_handler,
                              const EntityDegrees       &degrees,
                              AffineConstraints<double> &constraints)
  {
    AssertThrow(
      !dof_handler.get_triangulation().all_reference_cells_are_hyper_cube() ||
        is_consistently_ordered(dof_handler.get_triangulation()),
      ExcMessage(
        "make_conformity_constraints: the cells are not ordered consistently; "
        "try GridTools::consistently_order_cells on the coarse cells"));
    if (degrees.one_degree() &&
        !dof_handler.get_triangulation().has_hanging_nodes())
      {
        constraints.reinit(all_dofs(dof_handler, {}));
        return;
      }
    ConformityLines conformity(dof_handler, degrees);
    conformity.make();
    constraints.reinit(all_dofs(dof_handler, conformity.lines));
    for (const Line &line : conformity.lines)
      {
        constraints.add_line(line.dof);
        constraints.add_entries(line.dof, line.entries);
      }
    complete_constraints(dof_handler, constraints);
  }

  bool
  is_consistently_ordered(const Triangulation<3> &triangulation)
  {
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      {
        for (const unsigned int f : cell->face_indices())
          if (cell->face_flip(f) || cell->face_rotation(f))
            return false;
        for (const unsigned int l : cell->line_indices())
          if (!cell->line_orientation(l))
            return false;
      }
    return true;
  }
} // namespace mortise
