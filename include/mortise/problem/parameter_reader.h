// Values of one subsection of a parameter file, with messages that say where
// they stand. It never knows which parameters a subsection has.
#pragma once

#include <mortise/base/error.h>
#include <mortise/problem/parameter_schema.h>
#include <mortise/problem/parameters.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  class ParameterReader
  {
  public:
    /// @p schema holds the values, @p parameters their origins and the names of the bodies.
    ParameterReader(const ParameterSchema          &schema,
                    const Parameters               &parameters,
                    const std::vector<std::string> &sections);

    /// "Body inner/Degree (line 7 of FILE)"
    std::string
    where(const std::string &name) const;

    /// Throw InputError: what was got, and what is allowed.
    [[noreturn]] void
    fail(const std::string &name,
         const std::string &got,
         const std::string &allowed) const;

    std::string
    text(const std::string &name) const;

    /// @p text as a number of the parameter @p name; fails if it is none that a
    /// run can use.
    double
    number_of(const std::string &name, const std::string &text) const;

    double
    number(const std::string &name) const;

    unsigned int
    integer(const std::string &name) const;

    /// Numbers between commas.
    std::vector<double>
    numbers(const std::string &name) const;

    /// Exactly n numbers between commas.
    template <std::size_t n>
    std::array<double, n>
    array(const std::string &name) const
    {
      const std::vector<double> values = numbers(name);
      if (values.size() != n)
        fail(name, text(name), std::to_string(n) + " numbers");
      std::array<double, n> result{};
      std::copy(values.begin(), values.end(), result.begin());
      return result;
    }

    /// Three components between ';' or, without any ';', between ','. Absent
    /// for an empty text; "exact" stands for three of it.
    std::optional<Components>
    components(const std::string &name, const std::string &allowed) const;

    /// "a: b; c: d; ..." as records of @p n parts, none of them empty.
    std::vector<std::vector<std::string>>
    records(const std::string &name,
            std::size_t        n,
            const std::string &allowed) const;

    /// Index of @p body among the bodies of the scene.
    unsigned int
    body_index(const std::string &name, const std::string &body) const;

  private:
    const ParameterSchema         &schema;
    const Parameters              &parameters;
    const std::vector<std::string> sections;
  };
} // namespace mortise
