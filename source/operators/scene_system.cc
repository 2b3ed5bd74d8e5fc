#include <mortise/operators/assembled/pressure_scatter.h>
#include <mortise/operators/scene_system.h>

namespace mortise
{
  using namespace dealii;

  AffineConstraints<double>
  scene_constraints(
    const FieldNumbering                         &numbering,
    const std::vector<AffineConstraints<double>> &body_constraints)
  {
    IndexSet lines(numbering.size());
    for (unsigned int b = 0; b < body_constraints.size(); ++b)
      numbering.add_to(b, body_constraints[b].get_local_lines(), lines);
    lines.compress();

    AffineConstraints<double> constraints(lines);
    for (unsigned int b = 0; b < body_constraints.size(); ++b)
      for (const auto &line : body_constraints[b].get_lines())
        {
          const auto dof = numbering(b, line.index);
          constraints.add_line(dof);
          for (const auto &entry : line.entries)
            constraints.add_entry(dof, numbering(b, entry.first), entry.second);
          constraints.set_inhomogeneity(dof, line.inhomogeneity);
        }
    constraints.close();
    return constraints;
  }

  SceneField
  pressure_field(const Bodies &bodies, const MPI_Comm comm)
  {
    std::vector<const DoFHandler<dim> *>   handlers;
    std::vector<AffineConstraints<double>> constraints(bodies.size());
    for (const auto &body : bodies)
      {
        handlers.push_back(body->pressure ? &body->pressure->dof_handler :
                                            nullptr);
        if (body->pressure)
          constraints[body->index].copy_from(body->pressure->conformity);
      }
    SceneField field;
    field.numbering   = FieldNumbering(handlers, comm);
    field.constraints = scene_constraints(field.numbering, constraints);
    return field;
  }

  std::vector<AssembledBody>
  assemble_bodies(const Bodies                 &bodies,
                  const std::vector<LoadKinds> &kinds,
                  const SceneField             &displacement,
                  const SceneField             &pressure,
                  BlockSystem                  &system)
  {
    const IndexSet &owned = displacement.numbering.owned();
    {
      // rows of all dofs that the cells of this rank touch
      DynamicSparsityPattern sparsity(
        owned.size(), owned.size(), displacement.constraints.get_local_lines());
      for (const auto &body : bodies)
        add_cell_couplings(*body,
                           displacement.numbering,
                           displacement.constraints,
                           sparsity);
      system.stiffness.reinit(
        owned, owned, sparsity, system.communicator, true);
    }
    std::vector<const Body *> mixed;
    for (const auto &body : bodies)
      if (body->pressure)
        mixed.push_back(body.get());
    std::unique_ptr<PressureScatter> pressures;
    if (!mixed.empty())
      pressures = std::make_unique<PressureScatter>(mixed,
                                                    displacement,
                                                    pressure,
                                                    system);
    std::vector<AssembledBody> assembled;
    for (const auto &body : bodies)
      assembled.push_back(assemble_elasticity(*body,
                                              displacement.numbering,
                                              displacement.constraints,
                                              kinds[body->index],
                                              system.stiffness,
                                              pressures.get()));
    system.stiffness.compress(VectorOperation::add);
    if (pressures)
      pressures->compress();
    return assembled;
  }

  SceneLoad
  assemble_load(const std::vector<Loads>         &loads,
                const PrescribedValues           &prescribed,
                const Bodies                     &bodies,
                const std::vector<AssembledBody> &assembled,
                const SceneFields                &fields,
                const BlockSystem                &system)
  {
    SceneLoad load{system.zero_vector(), prescribed, {}};
    if (system.nodal)
      {
        system.nodal->assemble_load(loads, fields.displacement.numbering, load);
        return load;
      }
    load.interiors.resize(bodies.size());
    for (const auto &body : bodies)
      add_assembled_load(*body,
                         loads[body->index],
                         assembled[body->index],
                         fields.displacement,
                         &fields.pressure,
                         load);
    load.rhs.displacement.compress(VectorOperation::add);
    if (system.mixed())
      load.rhs.pressure.compress(VectorOperation::add);
    return load;
  }
} // namespace mortise
