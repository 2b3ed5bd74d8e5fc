// Proves that --parameters=json says what --parameters says: the same
// parameters in the same order with the same defaults, which the program takes,
// their units as they stand in the texts, and types that the defaults have.
#include <mortise/problem/input/parameter_schema.h>
#include <nlohmann/json.hpp>
#include <verdict.h>

#include <map>
#include <set>
#include <sstream>

using namespace mortise;
using Json = nlohmann::ordered_json;

namespace
{
  /// Texts of the reference without the marks and breaks of its comments.
  std::string
  words_of(const std::string &reference)
  {
    std::istringstream stream(reference);
    std::string        words;
    for (std::string word; stream >> word;)
      if (word != "#")
        words += word + " ";
    return words;
  }

  bool
  has_type(const Json &entry)
  {
    const std::string  type = entry["type"], value = entry["default"];
    const bool         has_choices = entry.contains("selections");
    std::istringstream stream(value);
    double             number = 0.;
    const bool is_number = static_cast<bool>(stream >> number) && stream.eof();
    if (type == "boolean")
      return value == "true" || value == "false";
    if (type == "real" || type == "integer")
      return value.empty() || is_number;
    if (type == "selection")
      {
        const std::vector<std::string> choices = entry["selections"];
        return std::count(choices.begin(), choices.end(), value) == 1;
      }
    return has_choices == (type == "list of selections");
  }
} // namespace

int
main()
{
  const std::string       reference = parameter_reference();
  const Json              json = Json::parse(parameter_reference_as_json());
  std::vector<Assignment> lines;
  for (const Assignment &line : scan_parameter_text(reference, "reference"))
    if (!line.opens_section())
      lines.push_back(line);

  const std::string     words = words_of(reference);
  std::set<std::string> names, types, units;
  std::string           different, no_text, no_unit, wrong_type;
  std::size_t           n = 0;
  for (const Json &section : json["sections"])
    for (const Json &entry : section["parameters"])
      {
        const std::string path =
          path_of({section["path"].get<std::string>()}, entry["name"]);
        const std::string text = entry["text"], unit = entry["unit"];
        const bool        same =
          n < lines.size() && path_of(lines[n].sections) == section["path"] &&
          lines[n].name == entry["name"] && lines[n].value == entry["default"];
        ++n;
        if (!same)
          different += path + " ";
        if (words.find(words_of(text + " Allowed: " +
                                entry["allowed"].get<std::string>() + ".")) ==
            std::string::npos)
          no_text += path + " ";
        if (text.find("[]") != std::string::npos ||
            (!unit.empty() &&
             text.find("[" + unit + "]") == std::string::npos) ||
            (unit.empty() && text.find("[-]") != std::string::npos))
          no_unit += path + " ";
        if (!has_type(entry))
          wrong_type += path + " ";
        names.insert(path);
        types.insert(entry["type"].get<std::string>());
        units.insert(unit);
      }
  verdict(different.empty() && n == lines.size() && names.size() == n,
          "the parameters and defaults of the text, in its order, each once",
          different);
  verdict(no_text.empty(), "meanings and what is allowed", no_text);
  verdict(no_unit.empty(), "units, which stand in the texts", no_unit);
  verdict(wrong_type.empty(), "types, which the defaults have", wrong_type);
  for (const std::string &type : types)
    std::cout << "type: " << type << "\n";
  for (const std::string &unit : units)
    std::cout << "unit: " << unit << "\n";
}
