#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/interruption.h>
#include <mortise/output/fields.h>
#include <mortise/problem/guard.h>
#include <mortise/problem/result_checks.h>
#include <mortise/problem/simulation.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// What cannot be written is put to @p unwritten: the rest can still be.
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

  void
  Simulation::compute()
  {
    create_meshes();
    create_spaces();
    field_checks.throw_if_any(comm);
    if (!interfaces.empty())
      {
        find_pairs();
        couple();
      }
    assemble();
    field_checks.throw_if_any(comm);
    check_loads(system);
    solve();
    postprocess();
    field_checks.throw_if_any(comm);
    const std::string not_finite = first_not_finite(summary.steps.back());
    if (solve_report.converged && !not_finite.empty())
      throw InputError(
        "The solver converged, but the numbers of the scene are too large or too small to "
        "compute with: " +
        not_finite + "; allowed: results whose squares are finite. Check " +
        "lengths, moduli, loads and exact solution, or take other units");
  }

  void
  Simulation::run()
  {
    check_output_directory(parameters, comm);
    compute();
    const auto unwritten = write_results();
    print_table();
    if (!unwritten.empty())
      throw InputError(describe(unwritten) + "\n" +
                       interruption::what_is_complete());
    if (!solve_report.converged)
      throw ConvergenceError(
        "The solver (" + solve_report.method +
        ") did not converge: relative residual " +
        RunLog::number(solve_report.relative_residual) + " after " +
        std::to_string(solve_report.iterations) + " iterations, allowed is " +
        RunLog::number(parameters.solver.tolerance) +
        ". Results so far are written. " +
        (solve_report.relative_residual <= solve_report.attainable ?
           "Rounding leaves up to " + RunLog::number(solve_report.attainable) +
             " whatever the method, since moduli or sizes differ too much" :
           "Raise Solver/Max iterations or try another Solver/Method"));
  }

  void
  Simulation::summarise_interface(const unsigned int i)
  {
    const InterfaceReport &report = couplings[i].interface->report();
    const TransferErrors   errors =
      transfer_errors(couplings[i], system.owned_multiplier, comm);
    InterfaceSummary result;
    result.name              = couplings[i].interface->name();
    result.slave_faces       = report.slave_faces;
    result.master_faces      = report.master_faces;
    result.candidate_pairs   = report.candidate_pairs;
    result.pairs             = report.pairs;
    result.integration_cells = report.integration_cells;
    summary.balance.push_back({result.name,
                               report.largest_integration_cells,
                               double(report.integration_cells) /
                                 Utilities::MPI::n_mpi_processes(comm)});
    result.quadrature_points         = report.quadrature_points;
    result.slave_area                = report.slave_area;
    result.covered_area              = report.covered_area;
    result.worst_face_coverage_error = report.worst_face_error;
    result.partition_of_unity_error  = errors.partition_of_unity;
    result.linear_completeness_error = errors.linear_completeness;
    summary.steps.back().interfaces.push_back(result);
  }

  void
  Simulation::postprocess()
  {
    auto         stage = log.stage(timers, "postprocess");
    StepSummary &step  = summary.steps.back();
    solutions =
      system.nodal ?
        body_solutions(
          bodies, displacement_field, pressure_field, *system.nodal, solution) :
        body_solutions(
          bodies, displacement_field, pressure_field, interiors, solution);

    std::vector<TiedBodies> tied;
    for (unsigned int i = 0; i < couplings.size(); ++i)
      {
        tractions.push_back(
          multiplier_on_faces(couplings[i], solution.multiplier, comm));
        tied.push_back(
          {interfaces[i].slave.body, parameters.interfaces[i].slave.body});
        const ResultantErrors errors =
          resultant_errors(couplings[i], solution.multiplier, comm);
        step.interfaces[i].force_residual  = errors.force;
        step.interfaces[i].moment_residual = errors.moment;
      }
    if (exact)
      {
        const SolutionErrors errors =
          solution_errors(bodies, solutions, *exact);
        ErrorSummary result;
        result.displacement_l2 = errors.displacement_l2;
        result.displacement_h1 = errors.displacement_h1;
        result.energy          = errors.energy;
        if (system.mixed())
          result.pressure_l2 = errors.pressure_l2;
        if (!couplings.empty())
          result.multiplier_l2 =
            multiplier_error(bodies, couplings, tied, tractions, *exact);
        step.errors = result;
      }
    for (const PointQuantity &quantity : parameters.output.points)
      {
        const auto value = point_value(*bodies[quantity.body],
                                       solutions[quantity.body].displacement,
                                       quantity.point);
        if (!value)
          log.warning("Output/Points: " + quantity.name +
                      " lies outside of body " + bodies[quantity.body]->name);
        step.quantities.emplace_back(quantity.name,
                                     value ? std::vector<double>{(*value)[0],
                                                                 (*value)[1],
                                                                 (*value)[2]} :
                                             std::vector<double>{});
      }
    for (const ResultantQuantity &quantity : parameters.output.resultants)
      {
        const Body          &body = *bodies[quantity.body];
        const Tensor<1, dim> force =
          resultant(body,
                    solutions[quantity.body],
                    body.boundary_id(quantity.boundary, ""));
        step.quantities.emplace_back(
          quantity.name, std::vector<double>{force[0], force[1], force[2]});
      }
  }

  std::vector<OutputError>
  Simulation::write_fields()
  {
    std::vector<OutputError> unwritten;
    const std::string       &directory = parameters.output.directory;
    const auto              &fields    = parameters.output.fields;
    if (fields.empty())
      return unwritten;
    auto       stage = log.stage(timers, "output");
    const auto wants = [&](const std::string &name) {
      return std::find(fields.begin(), fields.end(), name) != fields.end();
    };
    const FieldSelection selection{wants("displacement"),
                                   wants("stress"),
                                   wants("pressure"),
                                   wants("traction")};
    if (selection.displacement || selection.stress || selection.pressure)
      for (const auto &body : bodies)
        try_output(unwritten, [&] {
          write_body_fields(*body,
                            solutions[body->index],
                            selection,
                            directory);
        });
    if (selection.traction)
      for (unsigned int i = 0; i < couplings.size(); ++i)
        {
          const unsigned int slave = interfaces[i].slave.body;
          try_output(unwritten, [&] {
            write_interface_fields(*bodies[slave],
                                   couplings[i],
                                   tractions[i],
                                   solutions[slave].displacement,
                                   directory);
          });
        }
    if (unwritten.empty())
      stage.details(directory);
    return unwritten;
  }

  std::vector<OutputError>
  Simulation::write_results()
  {
    auto unwritten  = write_fields();
    summary.timings = timers.walls(comm);
    summary.memory  = peak_memory_mib(comm);
    try_output(unwritten, [&] {
      write_summary(summary, parameters.output.directory, comm);
    });
    return unwritten;
  }

  void
  Simulation::print_table()
  {
    const StepSummary &step = summary.steps.back();
    log.line();
    std::vector<std::vector<std::string>> rows = {
      {"body", "cells", "degree", "dofs"}};
    for (const BodySummary &body : step.bodies)
      rows.push_back({body.name,
                      std::to_string(body.cells),
                      body.degree_min == body.degree_max ?
                        std::to_string(body.degree_min) :
                        std::to_string(body.degree_min) + ".." +
                          std::to_string(body.degree_max),
                      std::to_string(body.dofs)});
    log.table(rows);
    if (!step.interfaces.empty())
      {
        log.line();
        rows = {{"interface",
                 "pairs",
                 "points",
                 "coverage",
                 "unity",
                 "force",
                 "moment",
                 "linear"}};
        for (const InterfaceSummary &interface : step.interfaces)
          rows.push_back(
            {interface.name,
             std::to_string(interface.pairs),
             std::to_string(interface.quadrature_points),
             RunLog::number(interface.covered_area / interface.slave_area),
             RunLog::number(*interface.partition_of_unity_error),
             RunLog::number(*interface.force_residual),
             RunLog::number(*interface.moment_residual),
             RunLog::number(*interface.linear_completeness_error)});
        log.table(rows);
      }
    if (step.errors)
      {
        log.line();
        rows = {
          {"relative error", ""},
          {"displacement, L2", RunLog::number(*step.errors->displacement_l2)},
          {"displacement, H1", RunLog::number(*step.errors->displacement_h1)},
          {"energy", RunLog::number(*step.errors->energy)}};
        if (step.errors->pressure_l2)
          rows.push_back(
            {"pressure, L2", RunLog::number(*step.errors->pressure_l2)});
        if (step.errors->multiplier_l2)
          rows.push_back(
            {"multiplier, L2", RunLog::number(*step.errors->multiplier_l2)});
        log.table(rows);
      }
    if (!step.quantities.empty())
      {
        log.line();
        rows = {{"quantity", "x", "y", "z"}};
        for (const auto &quantity : step.quantities)
          {
            rows.push_back({quantity.first});
            for (const double value : quantity.second)
              rows.back().push_back(RunLog::number(value));
          }
        log.table(rows);
      }
  }
} // namespace mortise
