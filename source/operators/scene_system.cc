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
} // namespace mortise
