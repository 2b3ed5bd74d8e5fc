// One entry per parameter: name, member (whose initialiser is the default),
// meaning with the unit, and allowed values. Declaration, printing, reading and
// checks follow from the entry.
#pragma once

#include <mortise/base/quotes.h>
#include <mortise/problem/input/parameters.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace mortise
{
  /// Allowed values of a parameter in words and as checks.
  struct Allowed
  {
    std::string                 words;
    std::function<bool(double)> contains{}; ///< empty: any number
    std::vector<std::string>    choices{};  ///< empty: any text

    static Allowed
    positive_number()
    {
      return {"a positive number",
              [](const double value) { return value > 0.; }};
    }

    static Allowed
    integer(unsigned int least, unsigned int most = no_limit);

    static Allowed
    one_of(const std::vector<std::string> &names)
    {
      return {names.size() == 1 ? names[0] : "one of: " + join_names(names),
              {},
              names};
    }

    static constexpr unsigned int no_limit = 0x7fffffff;
  };

  template <typename T>
  constexpr bool is_choice = std::is_enum_v<T> || std::is_same_v<T, bool>;

  /// The text of a parameter and its conversions, which throw InputError with
  /// the location, the value found and the allowed ones.
  struct ParameterValue
  {
    std::string    text;  ///< normalised
    std::string    where; ///< "Body inner/Degree (line 7 of FILE)"
    const Allowed &allowed;

    [[noreturn]] void
    fail(const std::string &got) const
    {
      fail(got, allowed.words);
    }

    [[noreturn]] void
    fail(const std::string &got, const std::string &allowed) const
    {
      throw InputError(where + ": got " + got + "; allowed: " + allowed);
    }

    /// @p part of the text as a number that a run can use.
    double
    number(const std::string &part) const;

    /// @p part of the text as an integer of 0 or more.
    unsigned int
    integer(const std::string &part) const;

    /// @p part of the text as the index of a choice.
    std::size_t
    choice(const std::string &part) const;

    /// "a: b; c: d; ..." as records of @p n parts, none of them empty.
    std::vector<std::vector<std::string>>
    records(std::size_t n) const;

    void
    read(std::string &member) const;
    void
    read(double &member) const;
    void
    read(unsigned int &member) const;
    void
    read(std::vector<double> &member) const;
    void
    read(std::vector<unsigned int> &member) const;

    /// Three components between ';' or, without any ';', between ','. "exact"
    /// stands for three of it.
    void
    read(Components &member) const;

    /// Absent for an empty text.
    template <typename T>
    void
    read(std::optional<T> &member) const
    {
      member.reset();
      if (!text.empty())
        read(member.emplace());
    }

    template <std::size_t n>
    void
    read(std::array<double, n> &member) const
    {
      std::vector<double> numbers;
      read(numbers);
      if (numbers.size() != n)
        fail(in_quotes(text));
      std::copy(numbers.begin(), numbers.end(), member.begin());
    }

    /// An enumeration or bool, whose values are in the order of the choices.
    template <typename Choice>
    std::enable_if_t<is_choice<Choice>>
    read(Choice &member) const
    {
      member = static_cast<Choice>(choice(text));
    }
  };

  struct ParameterEntry
  {
    std::vector<std::string>                    sections;
    std::string                                 name;
    std::string                                 default_value;
    std::string                                 meaning; ///< with the unit
    Allowed                                     allowed;
    std::function<void(const ParameterValue &)> set; ///< the member
    std::string value; ///< the default, or what was assigned last
    std::string where; ///< its location, for messages
  };

  /// Adds the entries of one subsection. Members must outlive them.
  class ParameterSection
  {
  public:
    explicit ParameterSection(std::vector<ParameterEntry>    &entries,
                              const std::vector<std::string> &path = {});

    ParameterSection
    subsection(const std::string &name) const
    {
      std::vector<std::string> below = path;
      below.push_back(name);
      return ParameterSection(entries, below);
    }

    /// An entry that sets @p member, of a type that ParameterValue reads.
    template <typename T>
    void
    add(const std::string &name,
        T                 &member,
        const std::string &meaning,
        const Allowed     &allowed) const
    {
      add(name,
          text_of(member, allowed),
          meaning,
          allowed,
          [&member](const ParameterValue &value) { value.read(member); });
    }

    /// An entry of its own kind.
    void
    add(const std::string                          &name,
        const std::string                          &default_value,
        const std::string                          &meaning,
        const Allowed                              &allowed,
        std::function<void(const ParameterValue &)> set) const;

  private:
    template <typename T>
    static std::string
    text_of(const std::optional<T> &, const Allowed &)
    {
      return "";
    }

    template <typename T>
    static std::string
    text_of(const T &member, const Allowed &allowed)
    {
      std::ostringstream text;
      if constexpr (is_choice<T>)
        text << allowed.choices[static_cast<std::size_t>(member)];
      else if constexpr (std::is_arithmetic_v<T> ||
                         std::is_same_v<T, std::string>)
        text << member;
      else
        for (std::size_t i = 0; i < member.size(); ++i)
          text << (i > 0 ? ", " : "") << member[i];
      return text.str();
    }

    std::vector<ParameterEntry>   &entries;
    const std::vector<std::string> path;
  };
} // namespace mortise
