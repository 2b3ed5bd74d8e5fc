#include <deal.II/dofs/dof_tools.h>

#include <mortise/body/hp_constraints.h>
#include <mortise/body/simplex_constraints.h>
#include <mortise/body/simplex_elements.h>

#include <limits>
#include <utility>
#include <vector>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using CellIterator = DoFHandler<3>::active_cell_iterator;

    /// The element that stands for each vertex, line and face: one of least
    /// degree, of these the first in the collection, so that all ranks that
    /// own a cell there agree.
    class EntityElements
    {
    public:
      explicit EntityElements(const DoFHandler<3> &dof_handler);

      /// For each local degree of freedom of @p cell the global one that
      /// carries its mode, or numbers::invalid_dof_index if its mode is above
      /// the degree of the line or face.
      void
      get_master_dofs(const CellIterator                   &cell,
                      std::vector<types::global_dof_index> &masters) const;

    private:
      using Elements = std::vector<unsigned int>;

      void
      lower(unsigned int &element, unsigned int candidate) const;

      const DoFHandler<3> &dof_handler;
      Elements             vertices, lines, faces;
    };

    EntityElements::EntityElements(const DoFHandler<3> &dof_handler)
      : dof_handler(dof_handler)
    {
      const auto    &mesh = dof_handler.get_triangulation();
      constexpr auto none = std::numeric_limits<unsigned int>::max();
      vertices.assign(mesh.n_vertices(), none);
      lines.assign(mesh.n_raw_lines(), none);
      faces.assign(mesh.n_raw_quads(), none);
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          {
            const unsigned int element = cell->active_fe_index();
            SimplexElements::base(cell->get_fe());
            for (const unsigned int v : cell->vertex_indices())
              lower(vertices[cell->vertex_index(v)], element);
            for (const unsigned int l : cell->line_indices())
              lower(lines[cell->line_index(l)], element);
            for (const unsigned int f : cell->face_indices())
              lower(faces[cell->face_index(f)], element);
          }
    }

    void
    EntityElements::lower(unsigned int      &element,
                          const unsigned int candidate) const
    {
      const auto degree = [&](const unsigned int e) {
        return e < dof_handler.get_fe_collection().size() ?
                 dof_handler.get_fe(e).degree :
                 std::numeric_limits<unsigned int>::max();
      };
      if (std::make_pair(degree(candidate), candidate) <
          std::make_pair(degree(element), element))
        element = candidate;
    }

    void
    EntityElements::get_master_dofs(
      const CellIterator                   &cell,
      std::vector<types::global_dof_index> &masters) const
    {
      const FiniteElement<3> &fe           = cell->get_fe();
      const unsigned int      n_components = fe.n_components();
      masters.resize(fe.n_dofs_per_cell());
      cell->get_dof_indices(masters);

      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int c = 0; c < n_components; ++c)
          masters[v * n_components + c] =
            cell->vertex_dof_index(v, c, vertices[cell->vertex_index(v)]);

      // Modes of an entity: component by component, by rising degree.
      const auto fill = [&](const unsigned int first,
                            const unsigned int n,
                            const unsigned int n_master,
                            const auto        &master) {
        for (unsigned int c = 0; c < n_components; ++c)
          for (unsigned int i = 0; i < n; ++i)
            masters[first + c * n + i] = i < n_master ?
                                           master(c * n_master + i) :
                                           numbers::invalid_dof_index;
      };
      for (const unsigned int l : cell->line_indices())
        {
          const unsigned int element = lines[cell->line_index(l)];
          const auto         line    = cell->line(l);
          const unsigned int n       = n_line_modes(fe.degree);
          fill(fe.get_first_line_index() + l * n_components * n,
               n,
               n_line_modes(dof_handler.get_fe(element).degree),
               [&](const unsigned int i) {
                 return line->dof_index(i, element);
               });
        }
      for (const unsigned int f : cell->face_indices())
        {
          const unsigned int element = faces[cell->face_index(f)];
          const auto         face    = cell->quad(f);
          fill(fe.get_first_quad_index(f),
               n_face_modes(fe.degree),
               n_face_modes(dof_handler.get_fe(element).degree),
               [&](const unsigned int i) {
                 return face->dof_index(i, element);
               });
        }
    }

    /// One degree of freedom and the one it equals; invalid: it is zero.
    using Equality =
      std::pair<types::global_dof_index, types::global_dof_index>;

    std::vector<Equality>
    find_equalities(const DoFHandler<3> &dof_handler)
    {
      const EntityElements                 elements(dof_handler);
      std::vector<types::global_dof_index> own, masters;
      std::vector<Equality>                equalities;
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            own.resize(cell->get_fe().n_dofs_per_cell());
            cell->get_dof_indices(own);
            elements.get_master_dofs(cell, masters);
            for (unsigned int i = 0; i < own.size(); ++i)
              if (masters[i] != own[i])
                equalities.emplace_back(own[i], masters[i]);
          }
      return equalities;
    }
  } // namespace

  void
  make_simplex_constraints(const DoFHandler<3>       &dof_handler,
                           AffineConstraints<double> &constraints)
  {
    // What a mode of an owned cell equals belongs to a cell beside it, which
    // is owned or a ghost.
    const auto equalities = find_equalities(dof_handler);
    IndexSet   relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    constraints.reinit(relevant);
    for (const Equality &equality : equalities)
      if (!constraints.is_constrained(equality.first))
        {
          constraints.add_line(equality.first);
          if (equality.second != numbers::invalid_dof_index)
            constraints.add_entry(equality.first, equality.second, 1.);
        }
    complete_constraints(dof_handler, constraints);
  }
} // namespace mortise
