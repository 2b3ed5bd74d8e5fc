#include <deal.II/fe/fe_system.h>

#include <mortise/body/fe_legendre.h>
#include <mortise/body/legendre_elements.h>
#include <mortise/body/simplex_elements.h>

#include <algorithm>
#include <vector>

namespace mortise
{
  using namespace dealii;

  void
  distribute_legendre_dofs(
    const std::set<unsigned int> &degrees,
    const std::function<
      unsigned int(const DoFHandler<3>::active_cell_iterator &)> &degree_of,
    const unsigned int                                            n_components,
    hp::FECollection<3>                                          &fe,
    DoFHandler<3>                                                &dof_handler)
  {
    const std::vector<unsigned int> all(degrees.begin(), degrees.end());
    const bool                      tetrahedra =
      !dof_handler.get_triangulation().all_reference_cells_are_hyper_cube();
    const SimplexElements simplices(tetrahedra ? all :
                                                 std::vector<unsigned int>(),
                                    n_components);
    if (tetrahedra)
      for (unsigned int i = 0; i < simplices.collection.size(); ++i)
        fe.push_back(simplices.collection[i]);
    else
      for (const unsigned int p : all)
        if (n_components == 1)
          fe.push_back(FE_Legendre(p));
        else
          fe.push_back(FESystem<3>(FE_Legendre(p), n_components));

    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int p = degree_of(cell);
          cell->set_active_fe_index(
            tetrahedra ? simplices.index(cell, p) :
                         std::find(all.begin(), all.end(), p) - all.begin());
        }
    dof_handler.distribute_dofs(fe);
  }
} // namespace mortise
