// The way from the unknowns of a scene to the fields of its bodies, and back.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/operators/scene_system.h>

#include <vector>

namespace mortise
{
  /// A field of one body in the numbering of its DoFHandler, with ghost values.
  using BodyVector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// What was solved for on one body.
  struct BodySolution
  {
    BodyVector    displacement;
    BodyVector    pressure; ///< in mixed form, else empty
    ThermalStrain thermal_strain = {};
  };

  /// Zero on all @p bodies, with room for their spaces.
  std::vector<BodySolution>
  zero_solutions(const Bodies &bodies);

  /// The solution by body: constraints distributed, what is prescribed added.
  /// Collective.
  std::vector<BodySolution>
  body_solutions(const Bodies       &bodies,
                 const SceneFields  &fields,
                 const BlockSystem  &system,
                 const SceneLoad    &load,
                 const SystemVector &solution);

  /// What undoes body_solutions(), for displacements and pressures: @p solutions less what is
  /// @p prescribed in them, as unknowns of @p system; multipliers are zero. Collective.
  SystemVector
  system_vector(const SceneFields               &fields,
                const BlockSystem               &system,
                const PrescribedValues          &prescribed,
                const std::vector<BodySolution> &solutions);
} // namespace mortise
