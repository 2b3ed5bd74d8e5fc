#include <deal.II/base/mpi.h>

#include <mortise/body/elements/legendre_elements.h>
#include <mortise/body/spaces/hp_constraints.h>
#include <mortise/body/spaces/pressure_space.h>

#include <set>

namespace mortise
{
  using namespace dealii;

  PressureSpace::PressureSpace(const DoFHandler<dim> &displacement)
    : dof_handler(displacement.get_triangulation())
  {
    std::set<unsigned int> used;
    const auto            &systems = displacement.get_fe_collection();
    for (unsigned int i = 0; i < systems.size(); ++i)
      used.insert(systems[i].degree - 1);
    distribute_legendre_dofs(
      used,
      [&](const CellIterator &cell) {
        return CellIterator(&displacement.get_triangulation(),
                            cell->level(),
                            cell->index(),
                            &displacement)
                 ->get_fe()
                 .degree -
               1;
      },
      1,
      fe,
      dof_handler);
    degrees = std::make_unique<EntityDegrees>(dof_handler);
    make_conformity_constraints(dof_handler, *degrees, conformity);
    relevant_dofs = conformity.get_local_lines();
  }
} // namespace mortise
