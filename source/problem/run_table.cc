#include <mortise/problem/run_table.h>

namespace mortise
{
  namespace
  {
    using Rows = std::vector<std::vector<std::string>>;

    void
    print_bodies(RunLog &log, const StepSummary &step)
    {
      log.line();
      Rows rows = {{"body", "cells", "degree", "dofs"}};
      for (const BodySummary &body : step.bodies)
        rows.push_back({body.name,
                        std::to_string(body.cells),
                        body.degree_min == body.degree_max ?
                          std::to_string(body.degree_min) :
                          std::to_string(body.degree_min) + ".." +
                            std::to_string(body.degree_max),
                        std::to_string(body.dofs)});
      log.table(rows);
    }

    void
    print_interfaces(RunLog &log, const StepSummary &step)
    {
      log.line();
      Rows rows = {{"interface",
                    "pairs",
                    "points",
                    "coverage",
                    "unity",
                    "imbalance",
                    "of moments",
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

    std::string
    vector_text(const std::vector<double> &values)
    {
      std::string text;
      for (const double value : values)
        text += (text.empty() ? "" : ", ") + RunLog::number(value);
      return text;
    }

    void
    print_forces(RunLog &log, const StepSummary &step)
    {
      log.line();
      Rows rows = {{"interface", "area", "force from slave to master", "moment"}};
      for (const InterfaceSummary &interface : step.interfaces)
        rows.push_back({interface.name,
                        RunLog::number(interface.covered_area),
                        vector_text(interface.force),
                        vector_text(interface.moment)});
      log.table(rows);
    }

    void
    print_equilibrium(RunLog &log, const EquilibriumSummary &equilibrium)
    {
      log.line();
      log.line("  equilibrium: applied " + vector_text(equilibrium.applied) +
               "; reactions " + vector_text(equilibrium.reactions) +
               "; sum " + vector_text(equilibrium.sum));
    }

    void
    print_errors(RunLog &log, const StepSummary &step)
    {
      log.line();
      Rows rows = {
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

    void
    print_adaptivity(RunLog &log, const AdaptivitySummary &adaptivity)
    {
      log.line();
      Rows rows = {{"relative error, " + adaptivity.quantity.value_or("energy"),
                    ""},
                   {"target", RunLog::number(adaptivity.target)}};
      if (adaptivity.estimate)
        rows.push_back({"estimate", RunLog::number(*adaptivity.estimate)});
      if (adaptivity.effectivity)
        rows.push_back(
          {"estimate by error", RunLog::number(*adaptivity.effectivity)});
      log.table(rows);
    }

    void
    print_quantities(RunLog &log, const StepSummary &step)
    {
      log.line();
      Rows rows = {{"quantity", "x", "y", "z"}};
      for (const auto &quantity : step.quantities)
        {
          rows.push_back({quantity.first});
          for (const double value : quantity.second)
            rows.back().push_back(RunLog::number(value));
        }
      log.table(rows);
    }
  } // namespace

  void
  print_table(RunLog &log, const StepSummary &step)
  {
    print_bodies(log, step);
    if (!step.interfaces.empty())
      {
        print_interfaces(log, step);
        print_forces(log, step);
      }
    if (step.equilibrium)
      print_equilibrium(log, *step.equilibrium);
    if (step.errors)
      print_errors(log, step);
    if (step.adaptivity)
      print_adaptivity(log, *step.adaptivity);
    if (!step.quantities.empty())
      print_quantities(log, step);
  }
} // namespace mortise
