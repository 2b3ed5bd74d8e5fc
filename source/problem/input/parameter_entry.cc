#include <deal.II/base/patterns.h>

#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/input/parameter_entry.h>
#include <mortise/problem/input/parameter_file.h>

namespace mortise
{
  namespace Patterns = dealii::Patterns;

  Allowed
  Allowed::integer(const unsigned int least, const unsigned int most)
  {
    const std::string from = std::to_string(least);
    return {most == no_limit ?
              "an integer of " + from + " or more" :
              "an integer from " + from + " to " + std::to_string(most),
            [=](const double value) {
              return least <= value && value <= most;
            }};
  }

  Meaning::Meaning(const char *with_place, const std::string &unit)
    : text(with_place)
    , unit(unit)
  {
    if (!unit.empty())
      text.replace(text.find("[]"), 2, "[" + unit + "]");
  }

  double
  ParameterValue::number(const std::string &part) const
  {
    if (!Patterns::Double().match(part))
      fail(in_quotes(text));
    const ReadNumber number = read_number(part);
    if (!number.problem.empty())
      fail(in_quotes(part) + ", which " + number.problem, allowed_numbers());
    return number.value;
  }

  unsigned int
  ParameterValue::integer(const std::string &part) const
  {
    if (!Patterns::Integer(0).match(part))
      fail(in_quotes(text));
    return std::stoul(part);
  }

  std::size_t
  ParameterValue::choice(const std::string &part) const
  {
    const auto &names = allowed.choices;
    const auto  found = std::find(names.begin(), names.end(), part);
    if (found == names.end())
      fail(in_quotes(part) + did_you_mean(part, names));
    return found - names.begin();
  }

  std::vector<std::vector<std::string>>
  ParameterValue::records(const std::size_t n) const
  {
    std::vector<std::vector<std::string>> result;
    for (const std::string &record : split_outside_parentheses(text, ';'))
      {
        result.push_back(split_outside_parentheses(record, ':'));
        if (result.back().size() != n ||
            std::count(result.back().begin(), result.back().end(), "") > 0)
          fail(in_quotes(record));
      }
    return result;
  }

  void
  ParameterValue::read(std::string &member) const
  {
    member = allowed.choices.empty() ? text : allowed.choices[choice(text)];
  }

  void
  ParameterValue::read(double &member) const
  {
    member = number(text);
    if (allowed.contains && !allowed.contains(member))
      {
        std::ostringstream got;
        got << member;
        fail(got.str());
      }
  }

  void
  ParameterValue::read(unsigned int &member) const
  {
    member = integer(text);
    if (allowed.contains && !allowed.contains(member))
      fail(in_quotes(text));
  }

  void
  ParameterValue::read(std::vector<double> &member) const
  {
    member.clear();
    for (const std::string &part : split_outside_parentheses(text, ','))
      {
        member.push_back(number(part));
        if (allowed.contains && !allowed.contains(member.back()))
          fail(in_quotes(text));
      }
  }

  void
  ParameterValue::read(std::vector<unsigned int> &member) const
  {
    member.clear();
    for (const std::string &part : split_outside_parentheses(text, ','))
      {
        member.push_back(integer(part));
        if (allowed.contains && !allowed.contains(member.back()))
          fail(in_quotes(text));
      }
  }

  void
  ParameterValue::read(Components &member) const
  {
    const char separator = text.find(';') != std::string::npos ? ';' : ',';
    const auto parts     = split_outside_parentheses(text, separator);
    if (text == "exact")
      member.fill(text);
    else if (parts.size() == 3)
      std::copy(parts.begin(), parts.end(), member.begin());
    else
      fail(in_quotes(text),
           allowed.words + " (these are " + std::to_string(parts.size()) +
             " components, not 3)");
  }

  ParameterSection::ParameterSection(std::vector<ParameterEntry>    &entries,
                                     const std::vector<std::string> &path)
    : entries(entries)
    , path(path)
  {}

  void
  ParameterSection::add(const std::string &name,
                        const std::string &default_value,
                        const Meaning     &meaning,
                        const Allowed     &allowed,
                        std::function<void(const ParameterValue &)> set,
                        const std::string                          &type) const
  {
    entries.push_back({path,
                       name,
                       default_value,
                       meaning,
                       allowed,
                       std::move(set),
                       !type.empty()           ? type :
                       allowed.choices.empty() ? "text" :
                                                 "selection",
                       default_value,
                       path_of(path, name)});
  }
} // namespace mortise
