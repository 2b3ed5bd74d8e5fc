#include <mortise/operators/constant_pressure.h>

namespace mortise
{
  using namespace dealii;

  ConstantPressure
  constant_pressure(const Body        &body,
                    const SceneField  &pressure,
                    const BlockSystem &system)
  {
    ConstantPressure result;
    result.one.reinit(system.owned_pressure, system.communicator);
    result.mass.reinit(result.one);
    if (system.nodal)
      system.nodal->set_constant_pressure(body, result.one);
    else
      {
        // the functions of the vertices add up to one
        std::vector<types::global_dof_index> dofs;
        for (const auto &cell :
             body.pressure->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              dofs.resize(cell->get_fe().n_dofs_per_cell());
              cell->get_dof_indices(dofs);
              for (unsigned int v = 0; v < cell->n_vertices(); ++v)
                if (const auto dof = pressure.numbering(body.index, dofs[v]);
                    system.owned_pressure.is_element(dof) &&
                    !pressure.constraints.is_constrained(dof))
                  result.one[dof] = 1.;
            }
        result.one.compress(VectorOperation::insert);
      }
    system.apply_pressure_norm(result.mass, result.one);
    result.mass /= body.material.pressure_norm();
    return result;
  }
} // namespace mortise
