#include <mortise/body/elements/legendre_basis.h>
#include <mortise/body/spaces/conformity_lines.h>
#include <mortise/body/spaces/hp_constraints.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// In the hierarchical basis, where modes above the degree of a line or
    /// face are zero.
    class ModalLines : public ConformityLines
    {
    public:
      using ConformityLines::ConformityLines;

    private:
      void
      constrain_hanging_line(const CellIterator &cell,
                             const unsigned int  l,
                             const unsigned int  half,
                             const CellIterator &coarse,
                             const unsigned int  coarse_line) override
      {
        const FullMatrix<double> &restriction = lobatto_restriction(half);
        degrees.get_master_dofs(coarse, masters);
        for (unsigned int c = 0; c < cell->get_fe().n_components(); ++c)
          for (unsigned int i = 0; i <= cell->get_fe().degree; ++i)
            // The end that is one of the parent's as well does not hang.
            if (i != half && start_line(own[line_dof(cell, l, i, c)]))
              for (unsigned int a = 0; a <= coarse->get_fe().degree; ++a)
                add(masters[line_dof(coarse, coarse_line, a, c)],
                    restriction(i, a));
      }

      void
      constrain_hanging_face(const HangingFace &at) override
      {
        const FullMatrix<double> &along_i = lobatto_restriction(at.half[0]);
        const FullMatrix<double> &along_j = lobatto_restriction(at.half[1]);
        const unsigned int        p       = at.cell->get_fe().degree,
                           q              = at.coarse->get_fe().degree;
        degrees.get_master_dofs(at.coarse, masters);
        for (unsigned int c = 0; c < at.cell->get_fe().n_components(); ++c)
          for (unsigned int j = 0; j <= p; ++j)
            for (unsigned int i = 0; i <= p; ++i)
              // The corner that is one of the parent's as well does not hang.
              if (!(i == at.half[0] && j == at.half[1]) &&
                  start_line(own[face_dof(at.cell, at.face, i, j, c)]))
                for (unsigned int b = 0; b <= q; ++b)
                  for (unsigned int a = 0; a <= q; ++a)
                    add(masters[face_dof(at.coarse,
                                         at.coarse_face,
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

      std::vector<Index> masters;
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
    // the elements tell the shape: a rank without tetrahedra has no cells
    AssertThrow(
      dof_handler.get_fe_collection()[0].reference_cell() !=
          ReferenceCells::Hexahedron ||
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
