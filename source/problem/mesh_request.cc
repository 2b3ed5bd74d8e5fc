#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/mesh_request.h>

#include <cmath>

namespace mortise
{
  namespace
  {
    double
    positive_length(const std::string &name, const std::string &value)
    {
      const ReadNumber number = read_number(value);
      if (!number.problem.empty() || !(number.value > 0.) ||
          !std::isfinite(number.value))
        throw InputError("--set: " + name + " = " + shortened(value) +
                         "; allowed: a positive length");
      return number.value;
    }
  } // namespace

  MeshRequest
  read_mesh_request(const std::string &option,
                    const std::string &file,
                    const Settings    &settings)
  {
    MeshRequest request;
    request.mesh.source = "file";
    request.mesh.file   = file;
    for (const std::string &setting : settings)
      {
        const std::size_t equals = setting.find('=');
        const std::string name   = setting.substr(0, equals);
        const std::string value  = setting.substr(equals + 1);
        if (name == "Output/Directory")
          request.directory = value;
        else if (name == "Part")
          request.mesh.part = value;
        else if (name == "Mesh size")
          request.mesh.mesh_size = positive_length(name, value);
        else if (name == "Search distance")
          request.search_distance = positive_length(name, value);
        else
          throw InputError(option + " with --set " + in_quotes(setting) +
                           "; allowed: \"Mesh size=...\", \"Part=...\" and "
                           "\"Search distance=...\"");
      }
    return request;
  }
} // namespace mortise
