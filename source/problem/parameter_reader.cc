#include <deal.II/base/utilities.h>

#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/parameter_reader.h>

namespace mortise
{
  ParameterReader::ParameterReader(const ParameterSchema          &schema,
                                   const Parameters               &parameters,
                                   const std::vector<std::string> &sections)
    : schema(schema)
    , parameters(parameters)
    , sections(sections)
  {}

  std::string
  ParameterReader::where(const std::string &name) const
  {
    return parameters.where(Assignment{sections, name, "", ""}.path());
  }

  void
  ParameterReader::fail(const std::string &name,
                        const std::string &got,
                        const std::string &allowed) const
  {
    throw InputError(where(name) + ": got " + in_quotes(got) +
                     "; allowed: " + allowed);
  }

  std::string
  ParameterReader::text(const std::string &name) const
  {
    return normalised(schema.get(sections, name));
  }

  double
  ParameterReader::number_of(const std::string &name,
                             const std::string &text) const
  {
    const ReadNumber number = read_number(text);
    if (!number.problem.empty())
      throw InputError(where(name) + ": got " + in_quotes(text) + ", which " +
                       number.problem + "; allowed: " + allowed_numbers());
    return number.value;
  }

  double
  ParameterReader::number(const std::string &name) const
  {
    return number_of(name, text(name));
  }

  unsigned int
  ParameterReader::integer(const std::string &name) const
  {
    return dealii::Utilities::string_to_int(text(name));
  }

  std::vector<double>
  ParameterReader::numbers(const std::string &name) const
  {
    std::vector<double> result;
    for (const std::string &part : split_outside_parentheses(text(name), ','))
      result.push_back(number_of(name, part));
    return result;
  }

  std::optional<Components>
  ParameterReader::components(const std::string &name,
                              const std::string &allowed) const
  {
    const std::string value = text(name);
    if (value.empty())
      return {};
    if (value == "exact")
      return Components{{"exact", "exact", "exact"}};
    const char separator = value.find(';') != std::string::npos ? ';' : ',';
    const auto parts     = split_outside_parentheses(value, separator);
    if (parts.size() != 3)
      fail(name,
           value,
           allowed + " (these are " + std::to_string(parts.size()) +
             " components, not 3)");
    return Components{{parts[0], parts[1], parts[2]}};
  }

  std::vector<std::vector<std::string>>
  ParameterReader::records(const std::string &name,
                           const std::size_t  n,
                           const std::string &allowed) const
  {
    std::vector<std::vector<std::string>> result;
    for (const std::string &record : split_outside_parentheses(text(name), ';'))
      {
        result.push_back(split_outside_parentheses(record, ':'));
        if (result.back().size() != n ||
            std::count(result.back().begin(), result.back().end(), "") > 0)
          fail(name, record, allowed);
      }
    return result;
  }

  unsigned int
  ParameterReader::body_index(const std::string &name,
                              const std::string &body) const
  {
    std::vector<std::string> names;
    for (const BodyParameters &b : parameters.bodies)
      names.push_back(b.name);
    const auto position = std::find(names.begin(), names.end(), body);
    if (position == names.end())
      throw InputError(where(name) + ": there is no body " + in_quotes(body) +
                       did_you_mean(body, names) +
                       "; bodies are: " + join_names(names));
    return position - names.begin();
  }
} // namespace mortise
