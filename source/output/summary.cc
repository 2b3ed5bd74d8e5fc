#include <deal.II/base/config.h>

#include <deal.II/base/mpi.h>

#include <mortise/output/summary.h>
#include <mortise/output/whole_file.h>
#include <nlohmann/json.hpp>

#include <limits>

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
    /// Set @p key only if there is a value.
    template <typename T>
    void
    set(Json &object, const std::string &key, const std::optional<T> &value)
    {
      if (value)
        object[key] = *value;
    }

    Json
    json_of(const BodySummary &body)
    {
      return {{"name", body.name},
              {"shape", body.shape},
              {"cells", body.cells},
              {"degree_min", body.degree_min},
              {"degree_max", body.degree_max},
              {"dofs", body.dofs}};
    }

    Json
    json_of(const DofSummary &dofs)
    {
      Json json = {{"displacement", dofs.displacement}};
      set(json, "pressure", dofs.pressure);
      set(json, "multiplier", dofs.multiplier);
      json["total"] = dofs.total;
      return json;
    }

    Json
    json_of(const InterfaceSummary &interface)
    {
      Json json = {{"name", interface.name},
                   {"slave_faces", interface.slave_faces},
                   {"master_faces", interface.master_faces},
                   {"candidate_pairs", interface.candidate_pairs},
                   {"pairs", interface.pairs},
                   {"integration_cells", interface.integration_cells},
                   {"quadrature_points", interface.quadrature_points},
                   {"slave_area", interface.slave_area},
                   {"covered_area", interface.covered_area}};
      set(json,
          "worst_face_coverage_error",
          interface.worst_face_coverage_error);
      set(json, "partition_of_unity_error", interface.partition_of_unity_error);
      set(json, "force_residual", interface.force_residual);
      set(json, "moment_residual", interface.moment_residual);
      set(json,
          "linear_completeness_error",
          interface.linear_completeness_error);
      return json;
    }

    Json
    json_of(const SolverSummary &solver)
    {
      Json json = {{"method", solver.method}};
      set(json, "preconditioner", solver.preconditioner);
      set(json, "iterations", solver.iterations);
      json["relative_residual"] = solver.relative_residual;
      return json;
    }

    Json
    json_of(const ErrorSummary &errors)
    {
      Json json = Json::object();
      set(json, "displacement_l2", errors.displacement_l2);
      set(json, "energy", errors.energy);
      set(json, "multiplier_l2", errors.multiplier_l2);
      set(json, "displacement_h1", errors.displacement_h1);
      set(json, "pressure_l2", errors.pressure_l2);
      return json;
    }

    Json
    json_of(const StepSummary &step)
    {
      Json json = {{"step", step.step}, {"cycle", step.cycle}};
      set(json, "time", step.time);
      json["bodies"] = Json::array();
      for (const BodySummary &body : step.bodies)
        json["bodies"].push_back(json_of(body));
      json["dofs"]       = json_of(step.dofs);
      json["interfaces"] = Json::array();
      for (const InterfaceSummary &interface : step.interfaces)
        json["interfaces"].push_back(json_of(interface));
      if (step.solver)
        json["solver"] = json_of(*step.solver);
      if (step.errors)
        json["errors"] = json_of(*step.errors);
      json["quantities"] = Json::object();
      for (const auto &[name, values] : step.quantities)
        json["quantities"][name] = values;
      return json;
    }

    /// Undoes set().
    template <typename T>
    void
    get(const Json &object, const std::string &key, std::optional<T> &value)
    {
      if (object.contains(key))
        value = object[key].is_null() ?
                  std::numeric_limits<T>::quiet_NaN() :
                  object[key].get<T>();
    }

    template <typename T>
    void
    get(const Json &object, const std::string &key, T &value)
    {
      value = object.at(key).get<T>();
    }

    void
    read(const Json &json, BodySummary &body)
    {
      get(json, "name", body.name);
      get(json, "shape", body.shape);
      get(json, "cells", body.cells);
      get(json, "degree_min", body.degree_min);
      get(json, "degree_max", body.degree_max);
      get(json, "dofs", body.dofs);
    }

    void
    read(const Json &json, InterfaceSummary &interface)
    {
      get(json, "name", interface.name);
      get(json, "slave_faces", interface.slave_faces);
      get(json, "master_faces", interface.master_faces);
      get(json, "candidate_pairs", interface.candidate_pairs);
      get(json, "pairs", interface.pairs);
      get(json, "integration_cells", interface.integration_cells);
      get(json, "quadrature_points", interface.quadrature_points);
      get(json, "slave_area", interface.slave_area);
      get(json, "covered_area", interface.covered_area);
      get(json,
          "worst_face_coverage_error",
          interface.worst_face_coverage_error);
      get(json, "partition_of_unity_error", interface.partition_of_unity_error);
      get(json, "force_residual", interface.force_residual);
      get(json, "moment_residual", interface.moment_residual);
      get(json,
          "linear_completeness_error",
          interface.linear_completeness_error);
    }

    void
    read(const Json &json, SolverSummary &solver)
    {
      get(json, "method", solver.method);
      get(json, "preconditioner", solver.preconditioner);
      get(json, "iterations", solver.iterations);
      get(json, "relative_residual", solver.relative_residual);
    }

    void
    read(const Json &json, ErrorSummary &errors)
    {
      get(json, "displacement_l2", errors.displacement_l2);
      get(json, "energy", errors.energy);
      get(json, "multiplier_l2", errors.multiplier_l2);
      get(json, "displacement_h1", errors.displacement_h1);
      get(json, "pressure_l2", errors.pressure_l2);
    }

    template <typename T>
    void
    read(const Json &json, const std::string &key, std::optional<T> &value)
    {
      if (json.contains(key))
        read(json[key], value.emplace());
    }

    void
    read(const Json &json, StepSummary &step)
    {
      get(json, "step", step.step);
      get(json, "cycle", step.cycle);
      get(json, "time", step.time);
      for (const Json &body : json["bodies"])
        read(body, step.bodies.emplace_back());
      get(json["dofs"], "displacement", step.dofs.displacement);
      get(json["dofs"], "pressure", step.dofs.pressure);
      get(json["dofs"], "multiplier", step.dofs.multiplier);
      get(json["dofs"], "total", step.dofs.total);
      for (const Json &interface : json["interfaces"])
        read(interface, step.interfaces.emplace_back());
      read(json, "solver", step.solver);
      read(json, "errors", step.errors);
      for (const auto &quantity : json["quantities"].items())
        step.quantities.emplace_back(
          quantity.key(), quantity.value().get<std::vector<double>>());
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
    for (const StepSummary &step : steps)
      json.push_back(json_of(step));
    return text_of(json, -1);
  }

  std::vector<StepSummary>
  steps_from_json(const std::string &text)
  {
    std::vector<StepSummary> steps;
    for (const Json &step : Json::parse(text))
      read(step, steps.emplace_back());
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
    for (const StepSummary &step : summary.steps)
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
