#include <deal.II/base/config.h>

#include <deal.II/base/mpi.h>

#include <mortise/output/json_value.h>
#include <mortise/output/summary.h>
#include <mortise/output/whole_file.h>
#include <nlohmann/json.hpp>

#include <stdexcept>
#include <type_traits>

#ifndef MORTISE_VERSION
#  define MORTISE_VERSION "unknown"
#endif

namespace mortise
{
  // Keys keep the order in which they are set. A double is written with the
  // digits that read back to the same value, and null if it is not finite.
  using Json = nlohmann::ordered_json;

  ProgramInfo
  program_info(const unsigned int n_ranks)
  {
    ProgramInfo info;
    info.version = MORTISE_VERSION;
    info.dealii  = DEAL_II_PACKAGE_VERSION;
    info.ranks   = n_ranks;
#ifdef DEBUG
    info.build_type = "Debug";
#else
    info.build_type = "Release";
#endif
    return info;
  }

  namespace
  {
    // The members of each part in the order of the file: calls visit(key,
    // member). Writing and reading both go through them.

    template <typename Visit>
    void
    visit_members(PeakSummary &peak, const Visit &visit)
    {
      visit("value", peak.value);
      visit("at", peak.at);
    }

    template <typename Visit>
    void
    visit_members(StressPeakSummary &peak, const Visit &visit)
    {
      visit_members(static_cast<PeakSummary &>(peak), visit);
      visit("averaged", peak.averaged);
      visit("jump", peak.jump);
    }

    template <typename Visit>
    void
    visit_members(BodySummary &body, const Visit &visit)
    {
      visit("name", body.name);
      visit("shape", body.shape);
      visit("cells", body.cells);
      visit("degree_min", body.degree_min);
      visit("degree_max", body.degree_max);
      visit("dofs", body.dofs);
      visit("material", body.material);
      visit("volume", body.volume);
      visit("mass", body.mass);
      visit("displacement_max", body.displacement_max);
      visit("von_mises_max", body.von_mises_max);
    }

    template <typename Visit>
    void
    visit_members(DofSummary &dofs, const Visit &visit)
    {
      visit("displacement", dofs.displacement);
      visit("pressure", dofs.pressure);
      visit("multiplier", dofs.multiplier);
      visit("total", dofs.total);
    }

    template <typename Visit>
    void
    visit_members(ContactSummary &contact, const Visit &visit)
    {
      visit("area", contact.area);
      visit("force", contact.force);
      visit("moment", contact.moment);
      visit("pressure_mean", contact.pressure_mean);
      visit("pressure_max", contact.pressure_max);
      visit("gap_min", contact.gap_min);
      visit("penetration_max", contact.penetration_max);
      visit("motion_max", contact.motion_max);
      visit("active", contact.active);
      visit("inactive", contact.inactive);
      visit("undecided", contact.undecided);
    }

    template <typename Visit>
    void
    visit_members(PreloadSummary &preload, const Visit &visit)
    {
      visit("force", preload.force);
      visit("shortening", preload.shortening);
    }

    template <typename Visit>
    void
    visit_members(InterfaceSummary &interface, const Visit &visit)
    {
      visit("name", interface.name);
      visit("slave_faces", interface.slave_faces);
      visit("master_faces", interface.master_faces);
      visit("candidate_pairs", interface.candidate_pairs);
      visit("pairs", interface.pairs);
      visit("integration_cells", interface.integration_cells);
      visit("quadrature_points", interface.quadrature_points);
      visit("slave_area", interface.slave_area);
      visit("covered_area", interface.covered_area);
      visit("area", interface.covered_area);
      visit("force", interface.force);
      visit("moment", interface.moment);
      visit("gap_mean", interface.gap_mean);
      visit("distance_mean", interface.distance_mean);
      visit("distance_max", interface.distance_max);
      visit("sagitta_mean", interface.sagitta_mean);
      visit("worst_face_coverage_error", interface.worst_face_coverage_error);
      visit("partition_of_unity_error", interface.partition_of_unity_error);
      visit("force_residual", interface.force_residual);
      visit("moment_residual", interface.moment_residual);
      visit("linear_completeness_error", interface.linear_completeness_error);
      visit("contact", interface.contact);
      visit("preload", interface.preload);
    }

    template <typename Visit>
    void
    visit_members(EquilibriumSummary &equilibrium, const Visit &visit)
    {
      visit("applied", equilibrium.applied);
      visit("reactions", equilibrium.reactions);
      visit("sum", equilibrium.sum);
    }

    template <typename Visit>
    void
    visit_members(SolverSummary &solver, const Visit &visit)
    {
      visit("method", solver.method);
      visit("preconditioner", solver.preconditioner);
      visit("iterations", solver.iterations);
      visit("relative_residual", solver.relative_residual);
      visit("active_sets", solver.active_sets);
      visit("linear_iterations", solver.linear_iterations);
    }

    template <typename Visit>
    void
    visit_members(ErrorSummary &errors, const Visit &visit)
    {
      visit("displacement_l2", errors.displacement_l2);
      visit("energy", errors.energy);
      visit("multiplier_l2", errors.multiplier_l2);
      visit("displacement_h1", errors.displacement_h1);
      visit("pressure_l2", errors.pressure_l2);
    }

    template <typename Visit>
    void
    visit_members(AdaptivitySummary &adaptivity, const Visit &visit)
    {
      visit("quantity", adaptivity.quantity);
      visit("value", adaptivity.value);
      visit("target", adaptivity.target);
      visit("estimate", adaptivity.estimate);
      visit("estimate_bulk", adaptivity.estimate_bulk);
      visit("estimate_interface", adaptivity.estimate_interface);
      visit("correction", adaptivity.correction);
      visit("effectivity", adaptivity.effectivity);
    }

    using Quantities = std::vector<std::pair<std::string, std::vector<double>>>;

    template <typename Visit>
    void
    visit_members(StepSummary &step, const Visit &visit)
    {
      visit("step", step.step);
      visit("cycle", step.cycle);
      visit("time", step.time);
      visit("bodies", step.bodies);
      visit("dofs", step.dofs);
      visit("interfaces", step.interfaces);
      visit("solver", step.solver);
      visit("equilibrium", step.equilibrium);
      visit("errors", step.errors);
      visit("adaptivity", step.adaptivity);
      visit("quantities", step.quantities);
    }

    /// Numbers and text, which are what they are in a file.
    template <typename T>
    constexpr bool is_value =
      std::is_arithmetic_v<T> || std::is_same_v<T, std::string>;

    template <typename T>
    void
    write_member(Json &json, const char *key, T &member);
    template <typename T>
    void
    write_member(Json &json, const char *key, std::optional<T> &member);
    template <typename T>
    void
    write_member(Json &json, const char *key, std::vector<T> &member);
    void
    write_member(Json &json, const char *key, Quantities &quantities);

    template <typename T>
    Json
    json_of(T &part)
    {
      if constexpr (is_value<T>)
        return part;
      else
        {
          Json json = Json::object();
          visit_members(part, [&](const char *key, auto &member) {
            write_member(json, key, member);
          });
          return json;
        }
    }

    template <typename T>
    void
    write_member(Json &json, const char *key, T &member)
    {
      json[key] = json_of(member);
    }

    /// Only if there is a value.
    template <typename T>
    void
    write_member(Json &json, const char *key, std::optional<T> &member)
    {
      if (member)
        json[key] = json_of(*member);
    }

    template <typename T>
    void
    write_member(Json &json, const char *key, std::vector<T> &members)
    {
      json[key] = Json::array();
      for (T &member : members)
        json[key].push_back(json_of(member));
    }

    void
    write_member(Json &json, const char *key, Quantities &quantities)
    {
      json[key] = Json::object();
      for (const auto &[name, values] : quantities)
        json[key][name] = values;
    }

    void
    check_array(const Json &json)
    {
      if (!json.is_array())
        throw std::out_of_range("there is no list where one is expected");
    }

    template <typename T>
    void
    read_member(const Json &json, const char *key, T &member);
    template <typename T>
    void
    read_member(const Json &json, const char *key, std::optional<T> &member);
    template <typename T>
    void
    read_member(const Json &json, const char *key, std::vector<T> &member);
    void
    read_member(const Json &json, const char *key, Quantities &quantities);

    template <typename T>
    void
    read_part(const Json &json, T &part)
    {
      if constexpr (is_value<T>)
        part = json_value<T>(json);
      else
        visit_members(part, [&](const char *key, auto &member) {
          read_member(json, key, member);
        });
    }

    template <typename T>
    void
    read_member(const Json &json, const char *key, T &member)
    {
      read_part(json.at(key), member);
    }

    template <typename T>
    void
    read_member(const Json &json, const char *key, std::optional<T> &member)
    {
      if (json.contains(key))
        read_part(json[key], member.emplace());
    }

    template <typename T>
    void
    read_member(const Json &json, const char *key, std::vector<T> &members)
    {
      check_array(json.at(key));
      for (const Json &member : json.at(key))
        read_part(member, members.emplace_back());
    }

    void
    read_member(const Json &json, const char *key, Quantities &quantities)
    {
      for (const auto &quantity : json.at(key).items())
        {
          check_array(quantity.value());
          quantities.emplace_back(quantity.key(), std::vector<double>());
          for (const Json &value : quantity.value())
            quantities.back().second.push_back(json_value<double>(value));
        }
    }

    // A title in another encoding than UTF-8 must not end the run.
    std::string
    text_of(const Json &json, const int indent)
    {
      return json.dump(indent, ' ', false, Json::error_handler_t::replace);
    }
  } // namespace

  std::string
  steps_to_json(const std::vector<StepSummary> &steps)
  {
    Json json = Json::array();
    for (StepSummary step : steps)
      json.push_back(json_of(step));
    return text_of(json, -1);
  }

  std::vector<StepSummary>
  steps_from_json(const std::string &text)
  {
    std::vector<StepSummary> steps;
    const Json               json = Json::parse(text);
    check_array(json);
    for (const Json &step : json)
      read_part(step, steps.emplace_back());
    return steps;
  }

  std::string
  to_json(const Summary &summary)
  {
    Json json;
    json["program"] = {{"name", summary.program.name},
                       {"version", summary.program.version},
                       {"dealii", summary.program.dealii},
                       {"ranks", summary.program.ranks},
                       {"build_type", summary.program.build_type}};
    json["title"]   = summary.title;
    json["status"]  = summary.status;
    json["steps"]   = Json::array();
    for (StepSummary step : summary.steps)
      json["steps"].push_back(json_of(step));
    json["timings_s"] = Json::object();
    for (const auto &[name, seconds] : summary.timings)
      json["timings_s"][name] = seconds;
    json["memory_mib"] = {{"peak_sum_over_ranks",
                           summary.memory.sum_over_ranks},
                          {"peak_max_rank", summary.memory.max_rank}};
    for (const BalanceSummary &balance : summary.balance)
      if (summary.program.ranks > 1)
        json["integration_cells_per_rank"][balance.interface] = {
          {"largest", balance.largest}, {"mean", balance.mean}};
    return text_of(json, 2) + "\n";
  }

  void
  write_summary(const Summary     &summary,
                const std::string &directory,
                const MPI_Comm     comm)
  {
    const bool writes = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    write_whole_file(directory + "/summary.json",
                     writes ? to_json(summary) : "",
                     comm);
  }
} // namespace mortise
