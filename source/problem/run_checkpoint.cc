#include <mortise/output/json_value.h>
#include <mortise/problem/run_checkpoint.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace mortise
{
  namespace
  {
    using Json = nlohmann::ordered_json;
  }

  Sections
  to_sections(const RunCheckpoint &checkpoint)
  {
    Json lines = Json::array();
    for (const Assignment &a : checkpoint.assignments)
      lines.push_back({a.sections, a.name, a.value, a.origin});
    // what is infinite is written as null
    const Json run{{"file", checkpoint.file},
                   {"assignments", lines},
                   {"time", checkpoint.state.time},
                   {"longest_step", checkpoint.longest_step},
                   {"n_steps", checkpoint.n_steps},
                   {"reached", checkpoint.reached},
                   {"tangent", checkpoint.state.path.tangent},
                   {"steps", steps_to_json(checkpoint.steps)},
                   {"files", checkpoint.files}};
    Sections   result{
        {"run", run.dump(-1, ' ', false, Json::error_handler_t::replace)},
        {"contact status",
         to_bytes(checkpoint.state.contact.value_or(ContactRecords()))},
        {"shortenings", to_bytes(checkpoint.state.shortenings)},
        {"motions", to_bytes(checkpoint.state.motions)}};
    if (!checkpoint.adaptivity.empty())
      result["adaptivity"] = checkpoint.adaptivity;
    return result;
  }

  namespace
  {
    const Json &
    list_of(const Json &json, const char *key)
    {
      const Json &list = json.at(key);
      if (!list.is_array())
        throw std::out_of_range("there is no list of " + std::string(key));
      return list;
    }

    Assignment
    assignment_from(const Json &line)
    {
      Assignment assignment;
      for (const Json &section : line.at(0))
        assignment.sections.push_back(json_value<std::string>(section));
      assignment.name   = json_value<std::string>(line.at(1));
      assignment.value  = json_value<std::string>(line.at(2));
      assignment.origin = json_value<std::string>(line.at(3));
      return assignment;
    }

    RunCheckpoint
    run_checkpoint_from(const std::string &text)
    {
      const Json    json = Json::parse(text);
      RunCheckpoint checkpoint;
      checkpoint.file = json_value<std::string>(json.at("file"));
      for (const Json &line : list_of(json, "assignments"))
        checkpoint.assignments.push_back(assignment_from(line));
      checkpoint.state.time   = json_value<double>(json.at("time"));
      checkpoint.longest_step = json.at("longest_step").is_null() ?
                                  std::numeric_limits<double>::infinity() :
                                  json_value<double>(json.at("longest_step"));
      checkpoint.n_steps      = json_value<unsigned int>(json.at("n_steps"));
      checkpoint.reached      = json_value<double>(json.at("reached"));
      checkpoint.state.path.tangent = json_value<double>(json.at("tangent"));
      checkpoint.steps =
        steps_from_json(json_value<std::string>(json.at("steps")));
      for (const Json &file : list_of(json, "files"))
        checkpoint.files.emplace_back(json_value<unsigned int>(file.at(0)),
                                      json_value<double>(file.at(1)));
      const auto refuse = [](const std::string &what, const double value) {
        std::ostringstream message;
        message << what << value;
        throw std::out_of_range(message.str());
      };
      for (const double time : {checkpoint.state.time, checkpoint.reached})
        if (!std::isfinite(time))
          refuse("it has reached the time ", time);
      if (checkpoint.reached < 0.)
        refuse("it has reached the time ", checkpoint.reached);
      if (!(checkpoint.state.path.tangent >= 0.))
        refuse("it has a tangent of size ", checkpoint.state.path.tangent);
      if (!(checkpoint.longest_step > 0.))
        refuse("it has steps of length ", checkpoint.longest_step);
      for (const auto &[step, time] : checkpoint.files)
        if (!std::isfinite(time))
          refuse("it has a file of the time ", time);
      if (checkpoint.steps.empty())
        throw std::out_of_range("it has not a single step");
      return checkpoint;
    }
  } // namespace

  RunCheckpoint
  read_run_checkpoint(const std::string &directory, const MPI_Comm comm)
  {
    const CheckpointFile file(checkpoint_file_name(directory), comm);
    RunCheckpoint        checkpoint;
    try
      {
        checkpoint = run_checkpoint_from(file.read("run"));
      }
    catch (const std::out_of_range &error)
      {
        throw file.damaged(error.what());
      }
    catch (const Json::exception &error)
      {
        throw file.damaged("its text cannot be read (" +
                           std::string(error.what()).substr(0, 200) + ")");
      }
    State &state      = checkpoint.state;
    state.contact     = file.get<ContactRecords>("contact status");
    state.shortenings = file.get<std::vector<double>>("shortenings");
    state.motions     = file.get<std::vector<double>>("motions");
    if (file.has("adaptivity"))
      checkpoint.adaptivity = file.read("adaptivity");
    const auto are_finite = [](const std::vector<double> &numbers) {
      return std::all_of(numbers.begin(), numbers.end(), [](const double x) {
        return std::isfinite(x);
      });
    };
    if (!state.contact->is_finite() || !are_finite(state.shortenings) ||
        !are_finite(state.motions))
      throw file.damaged("it has values that are not finite");
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
