// The system of a scene from its bodies: constraints in one numbering, the
// stiffness of all bodies, and the structure that preconditioners use. It never
// looks at interfaces.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/operators/block_system.h>
#include <mortise/operators/elasticity.h>

#include <memory>
#include <vector>

namespace mortise
{
  using Bodies = std::vector<std::unique_ptr<Body>>;

  /// The constraints of all bodies (conformity and Dirichlet, each in its
  /// body's numbering, not closed) in the numbering of the scene, closed.
  dealii::AffineConstraints<double>
  scene_constraints(
    const Bodies                                         &bodies,
    const DisplacementNumbering                          &numbering,
    const std::vector<dealii::AffineConstraints<double>> &body_constraints);

  /// Assemble stiffness and load of @p system, the interiors of cells eliminated; these are returned
  /// by body. Collective; throws InputError for tangled cells.
  std::vector<CondensedInteriors>
  assemble_bodies(const Bodies                            &bodies,
                  const std::vector<Loads>                &loads,
                  const DisplacementNumbering             &numbering,
                  const dealii::AffineConstraints<double> &constraints,
                  BlockSystem                             &system);

  /// The displacement of one body in the numbering of its DoFHandler, with
  /// ghost values.
  using BodyVector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// The displacements of all bodies out of the solution of the system:
  /// constraints distributed, interiors of cells recovered. Collective.
  std::vector<BodyVector>
  body_displacements(const Bodies                            &bodies,
                     const DisplacementNumbering             &numbering,
                     const dealii::AffineConstraints<double> &constraints,
                     const std::vector<CondensedInteriors>   &interiors,
                     const Vector                            &displacement);

  /// The same where @p displacement holds values at the nodes of @p nodal.
  std::vector<BodyVector>
  body_displacements(const Bodies                            &bodies,
                     const DisplacementNumbering             &numbering,
                     const dealii::AffineConstraints<double> &constraints,
                     const NodalSystem                       &nodal,
                     const Vector                            &displacement);

  /// Fill vertex_dofs, vertex_points, entity_blocks and max_degree of @p system.
  void
  describe_structure(const Bodies                &bodies,
                     const DisplacementNumbering &numbering,
                     BlockSystem                 &system);
} // namespace mortise
