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
#define MORTISE_VISIT(member) visit(#member, part.member);
#define MORTISE_VISIT_ALL(...) \
  NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(MORTISE_VISIT, __VA_ARGS__))
#define MORTISE_MEMBERS(Part, ...)                   \
  template <typename Visit>                          \
  void visit_members(Part &part, const Visit &visit) \
  {                                                  \
    MORTISE_VISIT_ALL(__VA_ARGS__)                   \
  }

    // clang-format off
    MORTISE_MEMBERS(PeakSummary, value, at)
    MORTISE_MEMBERS(StressPeakSummary, value, at, averaged, jump)
    MORTISE_MEMBERS(BodySummary, name, shape, cells, degree_min, degree_max,
                    dofs, material, volume, mass, displacement_max,
                    von_mises_max, plastic_strain_max)
    MORTISE_MEMBERS(DofSummary, displacement, pressure, multiplier, total)
    MORTISE_MEMBERS(FrictionSummary, stick, slip, force, slip_max,
                    dissipated_energy)
    MORTISE_MEMBERS(ContactSummary, area, force, moment, pressure_mean,
                    pressure_max, gap_min, penetration_max, motion_max, active,
                    inactive, undecided, friction)
    MORTISE_MEMBERS(PreloadSummary, force, shortening)
    MORTISE_MEMBERS(RigidPartSummary, name, point, displacement, rotation)
    MORTISE_MEMBERS(PeriodicCellSummary, volume, mean_strain, mean_stress)
    MORTISE_MEMBERS(EquilibriumSummary, applied, reactions, sum)
    MORTISE_MEMBERS(SolverSummary, method, preconditioner, iterations,
                    relative_residual, active_sets, newton_iterations,
                    linear_iterations)
    MORTISE_MEMBERS(ErrorSummary, displacement_l2, energy, multiplier_l2,
                    displacement_h1, pressure_l2)
    MORTISE_MEMBERS(AdaptivitySummary, quantity, value, target, estimate,
                    estimate_bulk, estimate_interface, correction, effectivity)
    MORTISE_MEMBERS(StepSummary, step, cycle, time, bodies, dofs, interfaces,
                    rigid_parts, solver, equilibrium, periodic_cell, errors,
                    adaptivity, quantities)

    template <typename Visit>
    void
    visit_members(InterfaceSummary &part, const Visit &visit)
    {
      MORTISE_VISIT_ALL(name, slave_faces, master_faces, candidate_pairs, pairs,
                        integration_cells, quadrature_points, slave_area,
                        covered_area)
      visit("area", part.covered_area);
      MORTISE_VISIT_ALL(force, moment, gap_mean, distance_mean, distance_max,
                        sagitta_mean, worst_face_coverage_error,
                        partition_of_unity_error, force_residual,
                        moment_residual, linear_completeness_error, contact,
                        preload)
    }
    // clang-format on

    using Quantities = std::vector<std::pair<std::string, std::vector<double>>>;

    /// Numbers and text, which are what they are in a file.
    template <typename T>
    constexpr bool is_value =
      std::is_arithmetic_v<T> || std::is_same_v<T, std::string>;

    struct Writer
    {
      template <typename T>
      static Json
      json_of(T &part)
      {
        if constexpr (is_value<T>)
          return part;
        else
          {
            Json json = Json::object();
            visit_members(part, Writer{json});
            return json;
          }
      }

      template <typename T>
      void
      operator()(const char *key, T &member) const
      {
        json[key] = json_of(member);
      }

      /// Only if there is a value.
      template <typename T>
      void
      operator()(const char *key, std::optional<T> &member) const
      {
        if (member)
          json[key] = json_of(*member);
      }

      template <typename T>
      void
      operator()(const char *key, std::vector<T> &members) const
      {
        json[key] = Json::array();
        for (T &member : members)
          json[key].push_back(json_of(member));
      }

      void
      operator()(const char *key, Quantities &quantities) const
      {
        json[key] = Json::object();
        for (const auto &[name, values] : quantities)
          json[key][name] = values;
      }

      Json &json;
    };

    void
    check_array(const Json &json)
    {
      if (!json.is_array())
        throw std::out_of_range("there is no list where one is expected");
    }

    struct Reader
    {
      template <typename T>
      static void
      read(const Json &json, T &part)
      {
        if constexpr (is_value<T>)
          part = json_value<T>(json);
        else
          visit_members(part, Reader{json});
      }

      template <typename T>
      void
      operator()(const char *key, T &member) const
      {
        read(json.at(key), member);
      }

      template <typename T>
      void
      operator()(const char *key, std::optional<T> &member) const
      {
        if (json.contains(key))
          read(json[key], member.emplace());
      }

      template <typename T>
      void
      operator()(const char *key, std::vector<T> &members) const
      {
        check_array(json.at(key));
        for (const Json &member : json.at(key))
          read(member, members.emplace_back());
      }

      void
      operator()(const char *key, Quantities &quantities) const
      {
        for (const auto &quantity : json.at(key).items())
          Reader{
            json.at(key)}(quantity.key().c_str(),
                          quantities.emplace_back(quantity.key(), 0).second);
      }

      const Json &json;
    };

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
      json.push_back(Writer::json_of(step));
    return text_of(json, -1);
  }

  std::vector<StepSummary>
  steps_from_json(const std::string &text)
  {
    std::vector<StepSummary> steps;
    const Json               json = Json::parse(text);
    check_array(json);
    for (const Json &step : json)
      Reader::read(step, steps.emplace_back());
    return steps;
  }

  std::string
  to_json(const Summary &summary)
  {
    Json json;
    json["program"]    = {{"name", summary.program.name},
                          {"version", summary.program.version},
                          {"dealii", summary.program.dealii},
                          {"ranks", summary.program.ranks},
                          {"build_type", summary.program.build_type}};
    json["title"]      = summary.title;
    json["status"]     = summary.status;
    json["file"]       = summary.file;
    json["parameters"] = Json::object();
    for (const auto &[path, value] : summary.parameters)
      json["parameters"][path] = value; // the last of the same counts
    json["warnings"] = summary.warnings;
    json["steps"]    = Json::array();
    for (StepSummary step : summary.steps)
      json["steps"].push_back(Writer::json_of(step));
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
