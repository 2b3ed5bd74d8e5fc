#include <mortise/operators/cells/pressure_kernel.h>
#include <mortise/operators/constant_pressure.h>

#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Calls @p visit(cell of the displacement, cell of the pressure, indices of
    /// its pressures in the scene) for the owned cells.
    template <typename Visit>
    void
    for_each_pressure_cell(const Body       &body,
                           const SceneField &pressure,
                           const Visit      &visit)
    {
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const auto own = body.pressure->cell(cell);
            visit(cell, own, scene_dofs(body.index, own, pressure.numbering));
          }
    }
  } // namespace

  Vector
  constant_pressure(const Body        &body,
                    const SceneField  &pressure,
                    const BlockSystem &system)
  {
    Vector one(system.owned_pressure, system.communicator);
    if (system.nodal)
      {
        system.nodal->set_constant_pressure(body, one);
        return one;
      }
    // the functions of the vertices add up to one
    for_each_pressure_cell(
      body, pressure, [&](const auto &cell, const auto &, const auto &dofs) {
        for (unsigned int v = 0; v < cell->n_vertices(); ++v)
          if (system.owned_pressure.is_element(dofs[v]) &&
              !pressure.constraints.is_constrained(dofs[v]))
            one[dofs[v]] = 1.;
      });
    one.compress(VectorOperation::insert);
    return one;
  }

  Vector
  pressure_integrals(const Body        &body,
                     const SceneField  &pressure,
                     const BlockSystem &system,
                     const Vector      &one)
  {
    Vector integrals(system.owned_pressure, system.communicator);
    if (system.nodal)
      {
        system.nodal->apply_pressure_mass(integrals, one);
        integrals /= body.material.pressure_norm();
        return integrals;
      }
    std::map<unsigned int, std::unique_ptr<PressureKernel>> kernels;
    dealii::Vector<double>                                  local;
    for_each_pressure_cell(
      body, pressure, [&](const auto &cell, const auto &own, const auto &dofs) {
        auto &kernel = kernels[cell->active_fe_index()];
        if (!kernel)
          kernel = std::make_unique<PressureKernel>(body,
                                                    cell->get_fe(),
                                                    own->get_fe());
        kernel->compute(cell);
        local.reinit(dofs.size());
        for (unsigned int k = 0; k < dofs.size(); ++k)
          for (unsigned int v = 0; v < cell->n_vertices(); ++v)
            local(k) += kernel->mass()(k, v);
        pressure.constraints.distribute_local_to_global(local, dofs, integrals);
      });
    integrals.compress(VectorOperation::add);
    return integrals;
  }
} // namespace mortise
