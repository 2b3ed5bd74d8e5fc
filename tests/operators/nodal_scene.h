// Bodies in a nodal basis, without an interface, for tests of what stands on
// it.
#pragma once

#include <deal.II/dofs/dof_tools.h>

#include <mortise/operators/bulk_system.h>
#include <mortise/operators/scene_solution.h>
#include <verdict.h>

#include <functional>

namespace mortise::testing
{
  /// Holds the first boundary of the generators, which count from 1, and of the
  /// third the second component.
  inline void
  hold_two_faces(const Body                        &body,
                 dealii::AffineConstraints<double> &constraints)
  {
    dealii::DoFTools::make_zero_boundary_constraints(body.dof_handler,
                                                     1,
                                                     constraints);
    dealii::DoFTools::make_zero_boundary_constraints(body.dof_handler,
                                                     3,
                                                     constraints,
                                                     dealii::ComponentMask(
                                                       {false, true, false}));
  }

  class NodalScene
  {
  public:
    /// @p create_space: of one body; @p constrain: adds to its constraints.
    NodalScene(
      const std::vector<MeshParameters> &meshes,
      const std::function<void(Body &)> &create_space,
      const std::function<void(const Body &,
                               dealii::AffineConstraints<double> &)> &constrain)
    {
      std::vector<const dealii::DoFHandler<dim> *>   handlers;
      std::vector<const Body *>                      pointers;
      std::vector<dealii::AffineConstraints<double>> constraints(meshes.size());
      for (unsigned int b = 0; b < meshes.size(); ++b)
        {
          bodies.push_back(std::make_unique<Body>(
            "body", b, LinearElastic{1. + b, 0.3 - 0.1 * b}));
          bodies[b]->create_mesh(meshes[b], MPI_COMM_WORLD, "");
          create_space(*bodies[b]);
          handlers.push_back(&bodies[b]->dof_handler);
          pointers.push_back(bodies[b].get());
          constraints[b].copy_from(bodies[b]->conformity);
          constrain(*bodies[b], constraints[b]);
          constraints[b].close();
        }
      SceneField &field = fields.displacement;
      field.numbering   = FieldNumbering(handlers, MPI_COMM_WORLD);
      field.constraints = scene_constraints(field.numbering, constraints);
      system            = std::make_unique<BulkSystem>(
        make_nodal_spaces(pointers, MPI_COMM_WORLD),
        nullptr,
        BulkSystem::Scene{field.numbering, field.constraints},
        MPI_COMM_WORLD);
    }

    const std::vector<MultigridLevel> &
    levels() const
    {
      return system->levels();
    }

    Bodies                      bodies;
    SceneFields                 fields;
    std::unique_ptr<BulkSystem> system;
  };
} // namespace mortise::testing
