#include <mortise/body/conformity_lines.h>
#include <mortise/body/fe_legendre.h>
#include <mortise/body/hp_constraints.h>
#include <mortise/body/legendre_basis.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
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

    /// In the hierarchical basis, where modes above the degree of a line or
    /// face are zero.
    class ModalLines : public ConformityLines
    {
    public:
      ModalLines(const DoFHandler<3> &dof_handler, const EntityDegrees &degrees)
        : ConformityLines(dof_handler, degrees)
      {
        const auto &fes = dof_handler.get_fe_collection();
        numbering.reserve(fes.size());
        if (fes[0].reference_cell() == ReferenceCells::Hexahedron)
          for (unsigned int i = 0; i < fes.size(); ++i)
            numbering.emplace_back(fes[i]);
      }

    private:
      void
      constrain_hanging_line(const CellIterator &cell,
                             const unsigned int  l,
                             const unsigned int  half,
                             const CellIterator &coarse,
                             const unsigned int  coarse_line) override
      {
        const LocalNumbering &fine_dofs = numbering[cell->active_fe_index()],
                             &coarse_dofs =
                               numbering[coarse->active_fe_index()];
        const FullMatrix<double> &restriction = lobatto_restriction(half);
        degrees.get_master_dofs(coarse, masters);
        for (unsigned int c = 0; c < cell->get_fe().n_components(); ++c)
          for (unsigned int i = 0; i < fine_dofs.n; ++i)
            // The end that is one of the parent's as well does not hang.
            if (i != half && start_line(own[fine_dofs.on_line(l, i, c)]))
              for (unsigned int a = 0; a < coarse_dofs.n; ++a)
                add(masters[coarse_dofs.on_line(coarse_line, a, c)],
                    restriction(i, a));
      }

      void
      constrain_hanging_face(const HangingFace &at) override
      {
        const FullMatrix<double> &along_i = lobatto_restriction(at.half[0]);
        const FullMatrix<double> &along_j = lobatto_restriction(at.half[1]);
        const LocalNumbering &fine_dofs = numbering[at.cell->active_fe_index()];
        const LocalNumbering &coarse_dofs =
          numbering[at.coarse->active_fe_index()];
        degrees.get_master_dofs(at.coarse, masters);
        for (unsigned int c = 0; c < at.cell->get_fe().n_components(); ++c)
          for (unsigned int j = 0; j < fine_dofs.n; ++j)
            for (unsigned int i = 0; i < fine_dofs.n; ++i)
              // The corner that is one of the parent's as well does not hang.
              if (!(i == at.half[0] && j == at.half[1]) &&
                  start_line(own[fine_dofs.on_face(at.face, i, j, c)]))
                for (unsigned int b = 0; b < coarse_dofs.n; ++b)
                  for (unsigned int a = 0; a < coarse_dofs.n; ++a)
                    add(masters[coarse_dofs.on_face(at.coarse_face,
                                                    at.transposed ? b : a,
                                                    at.transposed ? a : b,
                                                    c)],
                        along_i(i, a) * along_j(j, b));
      }

      void
      constrain_mixed_degrees(const CellIterator &cell) override
      {
        degrees.get_master_dofs(cell, masters);
        for (unsigned int i = 0; i < own.size(); ++i)
          if (masters[i] != own[i] && start_line(own[i]))
            add(masters[i], 1.);
      }

      void
      add(const Index master, const double weight)
      {
        if (weight != 0. && master != numbers::invalid_dof_index)
          entries().emplace_back(master, weight);
      }

      std::vector<LocalNumbering> numbering; ///< by element; hexahedra
      std::vector<Index>          masters;
    };
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
    ModalLines(dof_handler, degrees).make(constraints);
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
