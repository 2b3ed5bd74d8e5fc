#include <deal.II/fe/fe_system.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/legendre_elements.h>
#include <mortise/body/elements/simplex_elements.h>

#include <iterator>

namespace mortise
{
  using namespace dealii;

  void
  distribute_dofs_by_degree(
    const std::set<unsigned int> &degrees,
    const std::function<
      unsigned int(const DoFHandler<3>::active_cell_iterator &)> &degree_of,
    const std::function<std::unique_ptr<FiniteElement<3>>(unsigned int)>
                        &element,
    hp::FECollection<3> &fe,
    DoFHandler<3>       &dof_handler)
  {
    fe = hp::FECollection<3>();
    for (const unsigned int p : degrees)
      fe.push_back(*element(p));
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        cell->set_active_fe_index(
          std::distance(degrees.begin(), degrees.find(degree_of(cell))));
    dof_handler.distribute_dofs(fe);
  }

  namespace
  {
    /// Whether the owned cells of all ranks are hexahedra. What deal.II says of
    /// a rank without tetrahedra is not to be asked: it gives such a rank a
    /// hexahedron that stands for what it does not have. Collective.
    bool
    is_hexahedral(const Triangulation<3> &triangulation)
    {
      unsigned int others = 0;
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() &&
            cell->reference_cell() != ReferenceCells::Hexahedron)
          {
            others = 1;
            break;
          }
      return Utilities::MPI::max(others, triangulation.get_communicator()) == 0;
    }
  } // namespace

  void
  distribute_legendre_dofs(
    const std::set<unsigned int> &degrees,
    const std::function<
      unsigned int(const DoFHandler<3>::active_cell_iterator &)> &degree_of,
    const unsigned int                                            n_components,
    hp::FECollection<3>                                          &fe,
    DoFHandler<3>                                                &dof_handler)
  {
    // deal.II lets nobody go from one element to several
    dof_handler.reinit(dof_handler.get_triangulation());
    if (is_hexahedral(dof_handler.get_triangulation()))
      {
        distribute_dofs_by_degree(
          degrees,
          degree_of,
          [&](const unsigned int p) -> std::unique_ptr<FiniteElement<3>> {
            if (n_components == 1)
              return std::make_unique<FE_Legendre>(p);
            return std::make_unique<FESystem<3>>(FE_Legendre(p), n_components);
          },
          fe,
          dof_handler);
        return;
      }
    const SimplexElements simplices({degrees.begin(), degrees.end()},
                                    n_components);
    fe = hp::FECollection<3>();
    for (unsigned int i = 0; i < simplices.collection.size(); ++i)
      fe.push_back(simplices.collection[i]);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        cell->set_active_fe_index(simplices.index(cell, degree_of(cell)));
    dof_handler.distribute_dofs(fe);
  }

  std::vector<unsigned int>
  nested_modes(const ReferenceCell &cell,
               const unsigned int   lower,
               const unsigned int   higher)
  {
    std::vector<unsigned int> result;
    if (cell == ReferenceCells::Hexahedron)
      {
        const auto to        = cell_dof_indices(higher),
                   from      = cell_dof_indices(lower);
        const unsigned int n = lower + 1, m = higher + 1;
        result.resize(from.size());
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int i = 0; i < n; ++i)
              result[from[i + n * (j + n * k)]] = to[i + m * (j + m * k)];
        return result;
      }
    // the first ones of each vertex, line, face and of the inside
    unsigned int start    = 0;
    const auto   entities = [&](const unsigned int n_entities,
                              const unsigned int n_lower,
                              const unsigned int n_higher) {
      for (unsigned int e = 0; e < n_entities; ++e, start += n_higher)
        for (unsigned int i = 0; i < n_lower; ++i)
          result.push_back(start + i);
    };
    entities(4, 1, 1);
    entities(6, n_line_modes(lower), n_line_modes(higher));
    entities(4, n_face_modes(lower), n_face_modes(higher));
    entities(1, n_interior_modes(lower), n_interior_modes(higher));
    return result;
  }
} // namespace mortise
