// Conversion between the unknowns of a scene and the fields of its bodies.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/operators/cells/cell_histories.h>
#include <mortise/operators/scene_system.h>

#include <vector>

namespace mortise
{
  /// A field of one body in the numbering of its DoFHandler, with ghost values.
  using BodyVector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// The solution on one body.
  struct BodySolution
  {
    BodyVector    displacement;
    BodyVector    pressure; ///< in mixed form, else empty
    ThermalStrain thermal_strain = {};
    CellHistories history        = {};
  };

  /// Zero solutions in the spaces of @p bodies.
  std::vector<BodySolution>
  zero_solutions(const Bodies &bodies);

  /// By body: the displacement with the values @p field(body, component, x) at
  /// vertices, linear between them. Collective.
  template <typename Field>
  std::vector<BodySolution>
  linear_displacements(const Bodies &bodies, const Field &field)
  {
    std::vector<BodySolution> result = zero_solutions(bodies);
    for (const auto &body : bodies)
      {
        BodyVector &u = result[body->index].displacement;
        for (const auto &cell : body->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            for (const unsigned int v : cell->vertex_indices())
              for (unsigned int c = 0; c < dim; ++c)
                if (const auto dof =
                      cell->vertex_dof_index(v, c, cell->active_fe_index());
                    u.in_local_range(dof))
                  u(dof) = field(body->index, c, cell->vertex(v));
        u.update_ghost_values();
      }
    return result;
  }

  /// The solution by body with constraints distributed and prescribed values
  /// added. Collective.
  std::vector<BodySolution>
  body_solutions(const Bodies       &bodies,
                 const SceneFields  &fields,
                 const BlockSystem  &system,
                 const SceneLoad    &load,
                 const SystemVector &solution);

  /// The inverse of body_solutions() for displacements and pressures:
  /// @p solutions less the @p prescribed values, as unknowns of @p system with
  /// multipliers of zero. Collective.
  SystemVector
  system_vector(const SceneFields               &fields,
                const BlockSystem               &system,
                const PrescribedValues          &prescribed,
                const std::vector<BodySolution> &solutions);
} // namespace mortise
