// The declarations of one subsection, collected. It never declares a parameter
// of its own.
#pragma once

#include <mortise/base/error.h>
#include <mortise/problem/parameter_schema.h>

#include <array>
#include <sstream>
#include <string>
#include <vector>

namespace mortise
{
  namespace Patterns = dealii::Patterns;

  inline std::string
  text_of(const double value)
  {
    std::ostringstream stream;
    stream << value;
    return stream.str();
  }

  template <std::size_t n>
  std::string
  text_of(const std::array<double, n> &v)
  {
    std::string text = text_of(v[0]);
    for (std::size_t i = 1; i < n; ++i)
      text += ", " + text_of(v[i]);
    return text;
  }

  /// Collects the declarations of one subsection.
  class Declare
  {
  public:
    Declare(std::vector<ParameterDeclaration> &declared,
            const std::vector<std::string>    &sections)
      : declared(declared)
      , sections(sections)
    {}

    void
    text(const std::string &name,
         const std::string &value,
         const std::string &meaning,
         const std::string &allowed)
    {
      add(name, value, meaning, allowed, Patterns::Anything());
    }

    void
    number(const std::string &name,
           const double       value,
           const std::string &meaning,
           const std::string &allowed)
    {
      add(name, text_of(value), meaning, allowed, Patterns::Double());
    }

    void
    numbers(const std::string &name,
            const std::string &value,
            const std::string &meaning,
            const std::string &allowed,
            const unsigned int at_most)
    {
      add(name,
          value,
          meaning,
          allowed,
          Patterns::List(Patterns::Double(), 0, at_most));
    }

    void
    integer(const std::string &name,
            const unsigned int value,
            const std::string &meaning,
            const int          least,
            const int          most = Patterns::Integer::max_int_value)
    {
      add(name,
          std::to_string(value),
          meaning,
          most == Patterns::Integer::max_int_value ?
            "an integer of " + std::to_string(least) + " or more" :
            "an integer from " + std::to_string(least) + " to " +
              std::to_string(most),
          Patterns::Integer(least, most));
    }

    void
    yes_no(const std::string &name,
           const bool         value,
           const std::string &meaning)
    {
      add(name,
          value ? "true" : "false",
          meaning,
          "true or false",
          Patterns::Bool());
    }

    void
    choice(const std::string              &name,
           const std::string              &value,
           const std::string              &meaning,
           const std::vector<std::string> &choices)
    {
      std::string alternatives;
      for (const std::string &choice : choices)
        alternatives += (alternatives.empty() ? "" : "|") + choice;
      add(name,
          value,
          meaning,
          choices.size() == 1 ? choices[0] : "one of: " + join_names(choices),
          Patterns::Selection(alternatives));
      declared.back().choices = choices;
    }

    void
    add(const std::string           &name,
        const std::string           &value,
        const std::string           &meaning,
        const std::string           &allowed,
        const Patterns::PatternBase &pattern)
    {
      declared.push_back(
        {sections, name, value, meaning, allowed, {}, pattern.clone()});
    }

  private:
    std::vector<ParameterDeclaration> &declared;
    const std::vector<std::string>     sections;
  };

  /// The parameters of a body's subsection Mesh.
  void
  declare_mesh(Declare declare);
} // namespace mortise
