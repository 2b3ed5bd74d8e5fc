#include <deal.II/fe/fe_system.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/legendre_elements.h>
#include <mortise/body/elements/simplex_elements.h>

#include <iterator>

namespace mortise
{
  using namespace dealii;

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
    DoFHandler<3>                                                &dof_handler,
    const bool                                                    nodal)
  {
    // deal.II lets nobody go from one element to several
    dof_handler.reinit(dof_handler.get_triangulation());
    fe                   = hp::FECollection<3>();
    const bool hexahedra = is_hexahedral(dof_handler.get_triangulation());
    std::vector<unsigned int> of_simplices;
    for (const unsigned int p : degrees)
      if (!hexahedra)
        of_simplices.push_back(p);
      else if (nodal)
        fe.push_back(NodesOf<FE_Legendre>(p));
      else if (n_components == 1)
        fe.push_back(FE_Legendre(p));
      else
        fe.push_back(FESystem<3>(FE_Legendre(p), n_components));
    const SimplexElements simplices(of_simplices, n_components);
    for (unsigned int i = 0; i < simplices.collection.size(); ++i)
      if (const auto &element = simplices.collection[i]; nodal)
        fe.push_back(
          NodesOf<FE_SimplexLegendre>(SimplexElements::base(element)));
      else
        fe.push_back(element);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int p = degree_of(cell);
          cell->set_active_fe_index(
            hexahedra ? std::distance(degrees.begin(), degrees.find(p)) :
                        simplices.index(cell, p));
        }
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
