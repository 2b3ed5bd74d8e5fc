#include <mortise/output/summary.h>
#include <mortise/problem/input/parameter_schema.h>
#include <nlohmann/json.hpp>

namespace mortise
{
  namespace
  {
    nlohmann::ordered_json
    json_of_entry(const ParameterEntry &entry)
    {
      nlohmann::ordered_json json = {{"name", entry.name},
                                     {"type", entry.type},
                                     {"default", entry.default_value},
                                     {"unit", entry.meaning.unit},
                                     {"allowed", entry.allowed.words}};
      if (!entry.allowed.choices.empty())
        json["selections"] = entry.allowed.choices;
      json["text"] = entry.meaning.text;
      return json;
    }
  } // namespace

  std::string
  parameter_reference_as_json()
  {
    const ProgramInfo      program  = program_info(1);
    nlohmann::ordered_json json     = {{"program", program.name},
                                       {"version", program.version},
                                       {"sections",
                                        nlohmann::ordered_json::array()}};
    auto                  &sections = json["sections"];
    for (const ParameterEntry &entry : entries_of_reference())
      {
        const std::string path = path_of(entry.sections);
        if (sections.empty() || sections.back()["path"] != path)
          sections.push_back(
            {{"path", path}, {"parameters", nlohmann::ordered_json::array()}});
        sections.back()["parameters"].push_back(json_of_entry(entry));
      }
    return json.dump(2) + "\n";
  }
} // namespace mortise
