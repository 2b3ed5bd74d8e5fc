// The system of a scene from its bodies: constraints in one numbering, the
// stiffness of all bodies, and the structure that preconditioners use. It never
// looks at interfaces.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/operators/block_system.h>
#include <mortise/operators/elasticity.h>
#include <mortise/operators/pressure_scatter.h>

#include <memory>
#include <vector>

namespace mortise
{
  using Bodies = std::vector<std::unique_ptr<Body>>;

  /// The constraints of all bodies (conformity and Dirichlet, each in its
  /// body's numbering, not closed) in the numbering of the scene, closed.
  /// Bodies without the field have empty ones.
  dealii::AffineConstraints<double>
  scene_constraints(
    const FieldNumbering                                 &numbering,
    const std::vector<dealii::AffineConstraints<double>> &body_constraints);

  /// The pressures of the bodies in mixed form.
  SceneField
  pressure_field(const Bodies &bodies, MPI_Comm comm);

  /// Assemble stiffness and load of @p system, and what pressures need, the
  /// interiors of cells eliminated; these are returned by body. Collective;
  /// throws InputError for tangled cells.
  std::vector<CondensedInteriors>
  assemble_bodies(const Bodies             &bodies,
                  const std::vector<Loads> &loads,
                  const SceneField         &displacement,
                  const SceneField         &pressure,
                  BlockSystem              &system);

  /// A field of one body in the numbering of its DoFHandler, with ghost values.
  using BodyVector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// What was solved for on one body.
  struct BodySolution
  {
    BodyVector displacement;
    BodyVector pressure; ///< in mixed form, else empty
  };

  /// The solution by body: constraints distributed, interiors of cells
  /// recovered. Collective.
  std::vector<BodySolution>
  body_solutions(const Bodies                          &bodies,
                 const SceneField                      &displacement,
                 const SceneField                      &pressure,
                 const std::vector<CondensedInteriors> &interiors,
                 const SystemSolution                  &solution);

  /// The same where @p solution holds values at the nodes of @p nodal.
  std::vector<BodySolution>
  body_solutions(const Bodies         &bodies,
                 const SceneField     &displacement,
                 const SceneField     &pressure,
                 const NodalSystem    &nodal,
                 const SystemSolution &solution);

  /// Fill vertex_dofs, vertex_points, entity_blocks and max_degree of @p system.
  void
  describe_structure(const Bodies         &bodies,
                     const FieldNumbering &numbering,
                     BlockSystem          &system);
} // namespace mortise
