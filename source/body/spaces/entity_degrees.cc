#include <deal.II/base/mpi.h>

#include <deal.II/fe/fe.h>

#include <deal.II/grid/grid_tools.h>

#include <mortise/base/compatibility.h>
#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/fe_simplex_legendre.h>
#include <mortise/body/spaces/entity_degrees.h>

#include <algorithm>
#include <array>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned char no_element = 255;
  } // namespace

  EntityDegrees::EntityDegrees(const DoFHandler<3> &dof_handler)
    : dof_handler(dof_handler)
  {
    AssertThrow(dof_handler.get_fe_collection().size() < no_element,
                ExcMessage("at most 254 elements in a collection"));
    for (unsigned int i = 0; i < dof_handler.get_fe_collection().size(); ++i)
      {
        const FiniteElement<3> &fe   = dof_handler.get_fe(i);
        const FiniteElement<3> &base = fe.base_element(0);
        AssertThrow(fe.n_base_elements() == 1 &&
                      (dynamic_cast<const FE_Legendre *>(&base) ||
                       dynamic_cast<const FE_SimplexLegendre *>(&base)),
                    ExcMessage(
                      "EntityDegrees: the elements must be FE_Legendre, "
                      "FE_SimplexLegendre or a system of one of them; got " +
                      fe.get_name()));
      }
    unsigned int smallest = no_element, largest = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          smallest = std::min<unsigned int>(smallest, cell->active_fe_index());
          largest  = std::max<unsigned int>(largest, cell->active_fe_index());
        }
    const MPI_Comm comm = dof_handler.get_communicator();
    smallest            = Utilities::MPI::min(smallest, comm);
    largest             = Utilities::MPI::max(largest, comm);
    // Of the elements of one degree for tetrahedra, deal.II gives equal modes
    // of two one index, but not of more.
    uniform = smallest >= largest ||
              (largest == smallest + 1 && dof_handler.get_fe(smallest).degree ==
                                            dof_handler.get_fe(largest).degree);
    if (uniform)
      return;

    collect_from_cells();
    spread_over_hanging_faces();
    spread_over_hanging_lines();
    // A hanging face far from this rank lowers its edges, which may be edges
    // here: the owner of the coarse cell knows. The second round brings the
    // ghost cells up to date.
    exchange_degrees();
    spread_over_hanging_lines();
    exchange_degrees();
  }

  void
  EntityDegrees::lower(unsigned char     &element,
                       const unsigned int candidate) const
  {
    const auto &fes = dof_handler.get_fe_collection();
    if (element == no_element ||
        std::make_pair(fes[candidate].degree, candidate) <
          std::make_pair(fes[element].degree,
                         static_cast<unsigned int>(element)))
      element = candidate;
  }

  void
  EntityDegrees::collect_from_cells()
  {
    const Triangulation<3> &triangulation = dof_handler.get_triangulation();
    line_degrees.assign(triangulation.n_raw_lines(), 255);
    quad_degrees.assign(triangulation.n_raw_quads(), 255);
    vertex_element.assign(triangulation.n_vertices(), no_element);
    line_element.assign(triangulation.n_raw_lines(), no_element);
    quad_element.assign(triangulation.n_raw_quads(), no_element);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          const unsigned int  element = cell->active_fe_index();
          const unsigned char degree  = cell->get_fe().degree;
          for (const unsigned int v : cell->vertex_indices())
            lower(vertex_element[cell->vertex_index(v)], element);
          for (const unsigned int l : cell->line_indices())
            {
              lower(line_element[cell->line_index(l)], element);
              line_degrees[cell->line_index(l)] =
                std::min(line_degrees[cell->line_index(l)], degree);
            }
          for (const unsigned int f : cell->face_indices())
            {
              lower(quad_element[cell->face_index(f)], element);
              quad_degrees[cell->face_index(f)] =
                std::min(quad_degrees[cell->face_index(f)], degree);
            }
        }
  }

  void
  EntityDegrees::spread_over_hanging_faces()
  {
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int f : cell->face_indices())
          {
            const auto face = cell->face(f);
            if (!face->has_children())
              continue;
            unsigned char degree = quad_degrees[face->index()];
            for (unsigned int c = 0; c < 4; ++c)
              degree = std::min(degree, quad_degrees[face->child(c)->index()]);
            quad_degrees[face->index()] = degree;
            for (unsigned int c = 0; c < 4; ++c)
              quad_degrees[face->child(c)->index()] = degree;
            for (unsigned int l = 0; l < 4; ++l)
              {
                unsigned char &edge = line_degrees[face->line(l)->index()];
                edge                = std::min(edge, degree);
              }
            // The four lines inside the face.
            for (const auto &[c, l] :
                 {std::pair<unsigned int, unsigned int>{0, 1},
                  {0, 3},
                  {3, 0},
                  {3, 2}})
              line_degrees[face->child(c)->line(l)->index()] = degree;
          }
  }

  void
  EntityDegrees::spread_over_hanging_lines()
  {
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int l : cell->line_indices())
          {
            const auto line = cell->line(l);
            if (!line->has_children())
              continue;
            unsigned char &degree = line_degrees[line->index()];
            for (unsigned int c = 0; c < 2; ++c)
              degree = std::min(degree, line_degrees[line->child(c)->index()]);
            for (unsigned int c = 0; c < 2; ++c)
              line_degrees[line->child(c)->index()] = degree;
          }
  }

  void
  EntityDegrees::exchange_degrees()
  {
    using Degrees = std::array<unsigned char, 18>;
    if (Utilities::MPI::n_mpi_processes(dof_handler.get_communicator()) == 1)
      return;
    const auto pack =
      [&](const CellIterator &cell) -> compatibility::optional<Degrees> {
      Degrees degrees;
      for (const unsigned int l : cell->line_indices())
        degrees[l] = line_degrees[cell->line_index(l)];
      for (const unsigned int f : cell->face_indices())
        degrees[12 + f] = quad_degrees[cell->face_index(f)];
      return degrees;
    };
    const auto unpack = [&](const CellIterator &cell, const Degrees &degrees) {
      for (const unsigned int l : cell->line_indices())
        {
          unsigned char &degree = line_degrees[cell->line_index(l)];
          degree                = std::min(degree, degrees[l]);
        }
      for (const unsigned int f : cell->face_indices())
        {
          unsigned char &degree = quad_degrees[cell->face_index(f)];
          degree                = std::min(degree, degrees[12 + f]);
        }
    };
    GridTools::exchange_cell_data_to_ghosts<Degrees, DoFHandler<3>>(dof_handler,
                                                                    pack,
                                                                    unpack);
  }

  void
  EntityDegrees::get_master_dofs(
    const CellIterator                   &cell,
    std::vector<types::global_dof_index> &masters) const
  {
    Assert(!cell->is_artificial(), ExcMessage("owned and ghost cells only"));
    masters.resize(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(masters);
    if (uniform)
      return;

    const FiniteElement<3> &fe         = cell->get_fe();
    const auto             &fes        = dof_handler.get_fe_collection();
    const unsigned int      components = fe.n_components();
    const unsigned int      n          = fe.degree - 1;
    constexpr auto          zero       = numbers::invalid_dof_index;

    for (const unsigned int v : cell->vertex_indices())
      for (unsigned int c = 0; c < components; ++c)
        masters[v * components + c] =
          cell->vertex_dof_index(v, c, vertex_element[cell->vertex_index(v)]);

    for (const unsigned int l : cell->line_indices())
      {
        const unsigned int element = line_element[cell->line_index(l)];
        const unsigned int degree  = line_degrees[cell->line_index(l)];
        const unsigned int m       = fes[element].degree - 1;
        for (unsigned int c = 0; c < components; ++c)
          for (unsigned int i = 0; i < n; ++i)
            masters[fe.get_first_line_index() + (l * components + c) * n + i] =
              i + 2 > degree ? zero :
                               cell->line(l)->dof_index(c * m + i, element);
      }

    for (const unsigned int f : cell->face_indices())
      if (cell->reference_cell() == ReferenceCells::Hexahedron)
        get_quadrilateral_masters(cell, f, masters);
      else
        get_triangle_masters(cell, f, masters);
  }

  void
  EntityDegrees::get_quadrilateral_masters(
    const CellIterator                   &cell,
    const unsigned int                    f,
    std::vector<types::global_dof_index> &masters) const
  {
    const FiniteElement<3> &fe       = cell->get_fe();
    const unsigned int      n        = fe.degree - 1;
    const unsigned int      element  = quad_element[cell->face_index(f)];
    const unsigned int      degree   = quad_degrees[cell->face_index(f)];
    const unsigned int      m        = dof_handler.get_fe(element).degree - 1;
    const bool              standard = cell->face_orientation(f);
    auto master = masters.begin() + fe.get_first_quad_index(f);
    for (unsigned int c = 0; c < fe.n_components(); ++c)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          *master++ =
            std::max(i, j) + 2 > degree ?
              numbers::invalid_dof_index :
              cell->quad(f)->dof_index((c * m + (standard ? j : i)) * m +
                                         (standard ? i : j),
                                       element);
  }

  void
  EntityDegrees::get_triangle_masters(
    const CellIterator                   &cell,
    const unsigned int                    f,
    std::vector<types::global_dof_index> &masters) const
  {
    // modes of low degree come first, whatever the element
    const FiniteElement<3> &fe      = cell->get_fe();
    const unsigned int      element = quad_element[cell->face_index(f)];
    const unsigned int      n = n_face_modes(quad_degrees[cell->face_index(f)]);
    const unsigned int m = n_face_modes(dof_handler.get_fe(element).degree);
    auto               master = masters.begin() + fe.get_first_quad_index(f);
    for (unsigned int c = 0; c < fe.n_components(); ++c)
      for (unsigned int i = 0; i < n_face_modes(fe.degree); ++i)
        *master++ = i < n ? cell->quad(f)->dof_index(c * m + i, element) :
                            numbers::invalid_dof_index;
  }
} // namespace mortise
