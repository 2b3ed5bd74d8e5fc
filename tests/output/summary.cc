// Proves that summary.json is valid, has the documented keys and no others,
// keeps every digit, and is replaced as a whole.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/output/summary.h>
#include <nlohmann/json.hpp>
#include <temporary_file.h>
#include <verdict.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>

using namespace mortise;
using Json = nlohmann::ordered_json;

namespace
{
  /// The keys of @p json in order.
  std::string
  keys(const Json &json)
  {
    std::string text;
    for (const auto &item : json.items())
      text += (text.empty() ? "" : " ") + item.key();
    return text;
  }

  void
  check_keys(const std::string &what,
             const Json        &json,
             const std::string &expected)
  {
    verdict(keys(json) == expected,
            "keys of " + what + ": " + expected,
            keys(json));
  }

  Summary
  full_summary()
  {
    Summary summary;
    summary.program    = program_info(2);
    summary.title      = "quotes \" and \xc3\xa9";
    summary.status     = "done";
    summary.parameters = {{"Body inner/Degree", "2"},
                          {"Body inner/Degree", "3"}};
    summary.timings    = {{"total", 1.5}, {"mesh", 0.25}};
    summary.memory     = {200., 100.};
    StepSummary step;
    BodySummary body;
    body.name             = "inner";
    body.dofs             = 3000000000ull;
    body.material         = "linear elastic";
    body.volume           = 0.7;
    body.mass             = 0.1 + 0.2;
    body.displacement_max = PeakSummary{0.125, {1., 2., 3.}};
    body.von_mises_max    = StressPeakSummary{{7., {4., 5., 6.}}, 6.5, 1. / 3.};
    step.bodies           = {body, BodySummary()};
    step.dofs             = {10, 11, 12, 33};
    InterfaceSummary interface;
    interface.name                      = "glue";
    interface.slave_area                = 0.1 + 0.2;
    interface.worst_face_coverage_error = 1e-300;
    interface.partition_of_unity_error =
      std::numeric_limits<double>::quiet_NaN();
    interface.force_residual  = std::numeric_limits<double>::infinity();
    interface.moment_residual = 1. / 3.;
    interface.linear_completeness_error = 0.;
    ContactSummary contact;
    contact.force     = {1., 2., 3.};
    contact.friction  = FrictionSummary{3, 2, {0.5, 0., 0.}, 0.1, 0.2};
    interface.contact = contact;
    step.interfaces.push_back(interface);
    step.solver      = SolverSummary{"direct", "none", 1, 1e-16, {}, {}};
    step.equilibrium = EquilibriumSummary{{1.}, {-1.}, {0.}};
    step.errors      = ErrorSummary{1e-3, 2e-3, 3e-3, {}, {}};
    step.quantities  = {{"z first", {1., 2., 3.}}, {"a second", {4.}}};
    summary.steps.push_back(step);
    return summary;
  }

  void
  test_full()
  {
    const Json json = Json::parse(to_json(full_summary()));
    check_keys("the summary",
               json,
               "program title status file parameters warnings steps timings_s "
               "memory_mib");
    verdict(json["parameters"]["Body inner/Degree"] == "3" &&
              json["parameters"].size() == 1,
            "of two values of a parameter the last counts",
            json["parameters"].dump());
    check_keys("program",
               json["program"],
               "name version dealii ranks build_type");
    const Json &step = json["steps"][0];
    check_keys(
      "a step",
      step,
      "step cycle bodies dofs interfaces rigid_parts solver equilibrium errors quantities");
    check_keys("equilibrium", step["equilibrium"], "applied reactions sum");
    check_keys(
      "a body",
      step["bodies"][0],
      "name shape cells degree_min degree_max dofs material volume mass "
      "displacement_max von_mises_max");
    check_keys("a body without mass that was not solved",
               step["bodies"][1],
               "name shape cells degree_min degree_max dofs material volume");
    check_keys("a largest displacement",
               step["bodies"][0]["displacement_max"],
               "value at");
    check_keys("a largest stress",
               step["bodies"][0]["von_mises_max"],
               "value at averaged jump");
    check_keys("dofs", step["dofs"], "displacement pressure multiplier total");
    check_keys(
      "an interface",
      step["interfaces"][0],
      "name slave_faces master_faces candidate_pairs pairs integration_cells "
      "quadrature_points slave_area covered_area area force moment gap_mean distance_mean distance_max "
      "sagitta_mean worst_face_coverage_error "
      "partition_of_unity_error force_residual moment_residual linear_completeness_error contact");
    check_keys("contact with friction",
               step["interfaces"][0]["contact"],
               "area force moment pressure_mean pressure_max gap_min "
               "penetration_max motion_max active inactive undecided friction");
    check_keys("friction",
               step["interfaces"][0]["contact"]["friction"],
               "stick slip force slip_max dissipated_energy");
    check_keys("solver",
               step["solver"],
               "method preconditioner iterations relative_residual");
    check_keys("errors",
               step["errors"],
               "displacement_l2 energy multiplier_l2");
    check_keys("quantities, in the order of the request",
               step["quantities"],
               "z first a second");
    check_keys("timings, in the order of the run",
               json["timings_s"],
               "total mesh");
    check_keys("memory",
               json["memory_mib"],
               "peak_sum_over_ranks peak_max_rank");
    const Json &interface = step["interfaces"][0];
    verdict(interface["slave_area"].get<double>() == 0.1 + 0.2 &&
              interface["moment_residual"].get<double>() == 1. / 3. &&
              interface["worst_face_coverage_error"].get<double>() == 1e-300,
            "numbers read back to the last bit");
    verdict(interface["partition_of_unity_error"].is_null() &&
              interface["force_residual"].is_null(),
            "a number that is not finite is null");
    verdict(step["bodies"][0]["dofs"].get<std::uint64_t>() == 3000000000ull,
            "counts beyond 32 bits");
    const StepSummary back =
      steps_from_json(steps_to_json(full_summary().steps))[0];
    verdict(back.bodies[0].mass == 0.1 + 0.2 &&
              back.bodies[0].displacement_max->at ==
                std::vector<double>{1., 2., 3.} &&
              back.bodies[0].von_mises_max->jump == 1. / 3. &&
              !back.bodies[1].von_mises_max,
            "bodies of steps that are read again");
    verdict(json["title"].get<std::string>() == full_summary().title,
            "text with quotes and accents");
  }

  void
  test_sparse()
  {
    Summary summary;
    summary.title = "\xff not UTF-8";
    summary.steps.resize(1);
    summary.steps[0].interfaces.resize(1);
    const Json json = Json::parse(to_json(summary));
    check_keys("a step that failed before the solver",
               json["steps"][0],
               "step cycle bodies dofs interfaces rigid_parts quantities");
    check_keys("dofs without interface",
               json["steps"][0]["dofs"],
               "displacement total");
    verdict(!json["steps"][0]["interfaces"][0].contains("force_residual"),
            "what has no value is absent");
    verdict(json["timings_s"].is_object() && json["timings_s"].empty(),
            "no timings: an empty object");
  }

  void
  test_file()
  {
    namespace fs        = std::filesystem;
    const fs::path root = temporary_file("");
    const auto     text = [&] {
      std::ostringstream all;
      all << std::ifstream(root / "a/b/summary.json").rdbuf();
      return all.str();
    };
    Summary summary = full_summary();
    write_summary(summary, (root / "a/b").string(), MPI_COMM_WORLD);
    verdict(text() == to_json(summary),
            "the directory is made and the file is whole");
    summary.status = "not converged";
    write_summary(summary, (root / "a/b").string(), MPI_COMM_WORLD);
    verdict(text() == to_json(summary), "a file from before is replaced");
    verdict(std::distance(fs::directory_iterator(root / "a/b"), {}) == 1,
            "nothing else is left there");
    check_message("a directory that is a file",
                  [&] {
                    write_summary(summary,
                                  (root / "a/b/summary.json").string(),
                                  MPI_COMM_WORLD);
                  },
                  {"cannot write"});
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_full();
  test_sparse();
  test_file();
  return 0;
}
