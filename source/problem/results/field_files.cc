#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <mortise/output/fields.h>
#include <mortise/problem/results/contact_results.h>
#include <mortise/problem/results/field_files.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace mortise
{
  namespace
  {
    /// Call @p write and add an error of writing to @p unwritten, so that other
    /// files are written.
    template <typename Write>
    void
    try_output(std::vector<OutputError> &unwritten, const Write &write)
    {
      try
        {
          write();
        }
      catch (const OutputError &error)
        {
          unwritten.push_back(error);
        }
    }
  } // namespace

  std::string
  FieldFiles::file_name(const std::string &name, const unsigned int step) const
  {
    if (!run.parameters.steps.given())
      return name + ".vtu";
    std::ostringstream number;
    number << std::setw(4) << std::setfill('0') << step;
    return name + "_" + number.str() + ".vtu";
  }

  void
  FieldFiles::write_collection(const std::string &name) const
  {
    if (!run.parameters.steps.given())
      return;
    std::vector<std::pair<double, std::string>> entries;
    for (const auto &[step, time] : steps)
      entries.emplace_back(time, file_name(name, step));
    std::ostringstream text;
    if (dealii::Utilities::MPI::this_mpi_process(run.comm) == 0)
      {
        text << std::setprecision(17);
        dealii::DataOutBase::write_pvd_record(text, entries);
      }
    write_whole_file(run.parameters.output.directory + "/" + name + ".pvd",
                     text.str(),
                     run.comm);
  }

  namespace
  {
    std::vector<double>
    degrees(const Body &body)
    {
      std::vector<double> result(body.triangulation().n_active_cells());
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          result[cell->active_cell_index()] = body.degree(cell);
      return result;
    }
  } // namespace

  std::vector<OutputError>
  FieldFiles::write(const unsigned int    step,
                    const double          time,
                    const StepEvaluation &evaluation,
                    const NumbersByCell  &estimates)
  {
    std::vector<OutputError> unwritten;
    const std::string       &directory = run.parameters.output.directory;
    const auto              &asked     = run.parameters.output.fields;
    if (asked.empty())
      return unwritten;
    auto       stage = run.log.stage(run.timers, "output");
    const auto wants = [&](const std::string &name) {
      return std::find(asked.begin(), asked.end(), name) != asked.end();
    };
    const FieldSelection selection{wants("displacement"),
                                   wants("stress"),
                                   wants("pressure"),
                                   wants("plastic_strain"),
                                   wants("deformation_gradient"),
                                   wants("traction")};
    const Bodies        &bodies = evaluation.discretisation.bodies();
    steps.emplace_back(step, time);
    if (selection.displacement || selection.stress || selection.pressure ||
        selection.plastic_strain || selection.deformation_gradient ||
        wants("degree") || wants("estimate"))
      for (const auto &body : bodies)
        try_output(unwritten, [&] {
          std::vector<CellField> of_cells;
          if (wants("degree"))
            of_cells.push_back({"degree", degrees(*body)});
          if (wants("estimate") && !estimates.empty())
            of_cells.push_back({"estimate", estimates[body->index]});
          write_body_fields(*body,
                            evaluation.solutions()[body->index],
                            selection,
                            of_cells,
                            directory + "/" + file_name(body->name, step));
          write_collection(body->name);
        });
    const Pairing &interfaces = evaluation.discretisation.interfaces();
    if (selection.traction)
      for (unsigned int i = 0; i < interfaces.all().size(); ++i)
        try_output(unwritten, [&] {
          const Coupling    &coupling = interfaces.all()[i];
          const unsigned int slave    = interfaces.sides()[i].slave.body;
          write_interface_fields(*bodies[slave],
                                 coupling,
                                 evaluation.tractions()[i],
                                 contact_fields(evaluation, i),
                                 evaluation.solutions()[slave].displacement,
                                 directory + "/" +
                                   file_name(coupling.interface->name(), step));
          write_collection(coupling.interface->name());
        });
    if (unwritten.empty())
      stage.details(directory);
    else
      steps.pop_back(); // collections of a run that goes on name no file that
                        // is missing
    return unwritten;
  }
} // namespace mortise
