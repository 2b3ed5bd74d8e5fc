// The bodies of a scene with their meshes and spaces, in one numbering.
#pragma once

#include <mortise/body/boundary_faces.h>
#include <mortise/operators/scene_system.h>
#include <mortise/problem/input/run_context.h>
#include <mortise/problem/scene/scene_data.h>
#include <mortise/solvers/solve.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace mortise
{
  /// By body and active cell of its mesh; empty: those of the parameters.
  using CellDegrees = std::vector<std::vector<unsigned int>>;

  /// Data of an adaptive cycle beside the parameters.
  struct CyclePlan
  {
    CellDegrees degrees;
    /// By name of an interface: least search distance, a length.
    std::map<std::string, double> least_search;
  };

  struct SceneSpaces
  {
    SceneSpaces(Bodies &bodies, const CyclePlan &cycle)
      : bodies(bodies)
      , cycle(cycle)
    {}

    Bodies         &bodies; ///< with their meshes
    const CyclePlan cycle;
    /// By body: prescribed displacements, and whether they may be nonzero.
    std::vector<std::vector<DirichletCondition>> dirichlet;
    std::vector<RigidPart>                       rigid_parts;
    /// By body: conformity and homogeneous Dirichlet constraints; not closed.
    std::vector<dealii::AffineConstraints<double>> constraints;
    SceneFields                                    fields;
    SolverChoice                      choice{SolverMethod::automatic, ""};
    NodalSpaces                       nodal; ///< of displacements, by level
    std::shared_ptr<const NodalSpace> nodal_pressures; ///< in mixed form

    /// May prescribed displacements be nonzero?
    bool
    has_prescribed_values() const;

    /// Indices of the unknowns: values at nodes.
    dealii::IndexSet
    owned_displacement() const
    {
      return displacement_indices(nodal.front()->owned_nodes());
    }
    dealii::IndexSet
    owned_pressure() const
    {
      return nodal_pressures->owned_nodes();
    }
  };

  /// Open the meshes and check what depends on them. Collective; throws
  /// InputError.
  Bodies
  create_meshes(const RunContext &run);

  /// Make the mesh of @p body, which has no spaces, with edges of at most @p sizes if they are not null. Collective; throws
  /// InputError.
  void
  create_mesh(const RunContext                &run,
              std::shared_ptr<const SizeField> sizes,
              Body                            &body);

  /// The space of @p body, which has its mesh, with the degrees of the parameters. Collective;
  /// throws InputError.
  void
  create_space(const RunContext &run, Body &body);

  /// Spaces, constraints, numbering and the choice of the method. Collective.
  void
  create_spaces(const RunContext &run,
                const SceneData  &data,
                SceneSpaces      &spaces);

  /// The displacements that @p data prescribes. Collective.
  PrescribedValues
  prescribed_values(const SceneSpaces &spaces, const SceneData &data);

  /// Those of @p field on @p part alone. Collective.
  PrescribedValues
  prescribed_values(const SceneSpaces &spaces,
                    const RigidPart   &part,
                    const AffineField &field);
} // namespace mortise
