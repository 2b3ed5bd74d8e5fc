#include <mortise/problem/results/run_table.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  namespace
  {
    using Rows = std::vector<std::vector<std::string>>;

    void
    print_bodies(RunLog &log, const StepSummary &step)
    {
      log.line();
      const bool has_mass =
        std::any_of(step.bodies.begin(), step.bodies.end(), [](const auto &b) {
          return b.mass.has_value();
        });
      Rows rows = {{"body", "cells", "degree", "dofs", "material", "volume"}};
      if (has_mass)
        rows[0].push_back("mass");
      for (const BodySummary &body : step.bodies)
        {
          rows.push_back({body.name,
                          std::to_string(body.cells),
                          body.degree_min == body.degree_max ?
                            std::to_string(body.degree_min) :
                            std::to_string(body.degree_min) + ".." +
                              std::to_string(body.degree_max),
                          std::to_string(body.dofs),
                          body.material,
                          RunLog::number(body.volume)});
          if (has_mass)
            rows.back().push_back(body.mass ? RunLog::number(*body.mass) : "-");
        }
      log.table(rows);
    }

    std::string
    text_of(const std::vector<double> &x)
    {
      std::string text = "(";
      for (unsigned int c = 0; c < x.size(); ++c)
        text += (c > 0 ? ", " : "") + RunLog::number(x[c]);
      return text + ")";
    }

    void
    print_displacements(RunLog &log, const StepSummary &step)
    {
      log.line();
      Rows rows = {{"body", "displacement, largest", "at"}};
      for (const BodySummary &body : step.bodies)
        if (const auto &peak = body.displacement_max)
          rows.push_back(
            {body.name, RunLog::number(peak->value), text_of(peak->at)});
      log.table(rows);
    }

    void
    print_stresses(RunLog &log, const StepSummary &step)
    {
      log.line();
      Rows rows = {
        {"body", "von Mises, largest", "averaged", "jump between cells", "at"}};
      for (const BodySummary &body : step.bodies)
        if (const auto &peak = body.von_mises_max)
          rows.push_back({body.name,
                          RunLog::number(peak->value),
                          RunLog::number(peak->averaged),
                          peak->jump ? RunLog::number(*peak->jump) : "-",
                          text_of(peak->at)});
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

    void
    print_forces(RunLog &log, const StepSummary &step)
    {
      log.line();
      Rows rows = {
        {"interface", "area", "force from slave to master", "moment"}};
      for (const InterfaceSummary &interface : step.interfaces)
        rows.push_back({interface.name,
                        RunLog::number(interface.covered_area),
                        text_of(interface.force),
                        text_of(interface.moment)});
      log.table(rows);
    }

    /// Distances between the meshes of the sides, if they do not coincide.
    void
    print_distances(RunLog &log, const StepSummary &step)
    {
      constexpr double rounding = 1e-10; // beside the size of the interface
      Rows rows = {{"interface", "distance, mean", "largest", "gap, mean"}};
      for (const InterfaceSummary &interface : step.interfaces)
        if (interface.distance_max > rounding * std::sqrt(interface.slave_area))
          rows.push_back({interface.name,
                          RunLog::number(interface.distance_mean),
                          RunLog::number(interface.distance_max),
                          RunLog::number(interface.gap_mean)});
      if (rows.size() == 1)
        return;
      log.line();
      log.table(rows);
    }

    void
    print_contact(RunLog &log, const StepSummary &step)
    {
      Rows rows = {{"contact",
                    "contact area",
                    "pressure, mean",
                    "largest",
                    "penetration"}};
      for (const InterfaceSummary &interface : step.interfaces)
        if (const auto &contact = interface.contact)
          rows.push_back({interface.name,
                          RunLog::number(contact->area),
                          RunLog::number(contact->pressure_mean),
                          RunLog::number(contact->pressure_max),
                          RunLog::number(contact->penetration_max)});
      if (rows.size() == 1)
        return;
      log.line();
      log.table(rows);
    }

    void
    print_rigid_parts(RunLog &log, const StepSummary &step)
    {
      if (step.rigid_parts.empty())
        return;
      log.line();
      Rows rows = {
        {"rigid part", "displacement", "of the point", "rotation, degrees"}};
      for (const RigidPartSummary &part : step.rigid_parts)
        rows.push_back({part.name,
                        text_of(part.displacement),
                        text_of(part.point),
                        text_of(part.rotation)});
      log.table(rows);
    }

    void
    print_equilibrium(RunLog &log, const EquilibriumSummary &equilibrium)
    {
      log.line();
      log.line("  equilibrium: applied " + text_of(equilibrium.applied) +
               "; reactions " + text_of(equilibrium.reactions) + "; sum " +
               text_of(equilibrium.sum));
    }

    void
    print_periodic_cell(RunLog &log, const PeriodicCellSummary &cell)
    {
      log.line();
      Rows       rows = {{"periodic cell", "xx", "yy", "zz", "yz", "zx", "xy"}};
      const auto add  = [&](const std::string         &name,
                           const std::vector<double> &values) {
        rows.push_back({name});
        for (const double value : values)
          rows.back().push_back(RunLog::number(value));
      };
      add("mean strain", cell.mean_strain);
      add("mean stress", cell.mean_stress);
      log.table(rows);
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
    print_displacements(log, step);
    print_stresses(log, step);
    if (!step.interfaces.empty())
      {
        print_interfaces(log, step);
        print_forces(log, step);
        print_distances(log, step);
        print_contact(log, step);
      }
    print_rigid_parts(log, step);
    if (step.equilibrium)
      print_equilibrium(log, *step.equilibrium);
    if (step.periodic_cell)
      print_periodic_cell(log, *step.periodic_cell);
    if (step.errors)
      print_errors(log, step);
    if (step.adaptivity)
      print_adaptivity(log, *step.adaptivity);
    if (!step.quantities.empty())
      print_quantities(log, step);
  }
} // namespace mortise
