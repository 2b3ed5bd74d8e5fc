#include <mortise/problem/run_checkpoint.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace mortise
{
  namespace
  {
    using Json = nlohmann::ordered_json;
  }

  std::string
  to_text(const RunCheckpoint &checkpoint)
  {
    Json lines = Json::array();
    for (const Assignment &a : checkpoint.assignments)
      lines.push_back({a.sections, a.name, a.value, a.origin});
    // what is infinite is written as null
    return Json{{"file", checkpoint.file},
                {"assignments", lines},
                {"time", checkpoint.time},
                {"longest_step", checkpoint.longest_step},
                {"n_steps", checkpoint.n_steps},
                {"adaptivity", checkpoint.adaptivity},
                {"steps", steps_to_json(checkpoint.steps)},
                {"files", checkpoint.files}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
  }

  RunCheckpoint
  run_checkpoint_from(const std::string &text)
  {
    const Json    json = Json::parse(text);
    RunCheckpoint checkpoint;
    checkpoint.file = json.at("file").get<std::string>();
    for (const Json &line : json.at("assignments"))
      checkpoint.assignments.push_back(
        {line.at(0).get<std::vector<std::string>>(),
         line.at(1).get<std::string>(),
         line.at(2).get<std::string>(),
         line.at(3).get<std::string>()});
    checkpoint.time         = json.at("time").get<double>();
    checkpoint.longest_step = json.at("longest_step").is_null() ?
                                std::numeric_limits<double>::infinity() :
                                json.at("longest_step").get<double>();
    checkpoint.n_steps      = json.at("n_steps").get<unsigned int>();
    checkpoint.adaptivity   = json.at("adaptivity").get<std::string>();
    checkpoint.steps = steps_from_json(json.at("steps").get<std::string>());
    checkpoint.files =
      json.at("files").get<std::vector<std::pair<unsigned int, double>>>();
    return checkpoint;
  }

  Parameters
  restart_parameters(const RunCheckpoint &checkpoint,
                     const Settings      &settings,
                     const std::string   &directory)
  {
    std::vector<Assignment> assignments = checkpoint.assignments;
    assignments.push_back(scan_setting("Output/Directory=" + directory));
    assignments.back().origin = "--restart";
    for (const std::string &setting : settings)
      assignments.push_back(scan_setting(setting));
    return parse_parameters(assignments, checkpoint.file);
  }
} // namespace mortise
