// One entry per parameter: name, member (whose initialiser is the default),
// meaning with the unit, and allowed values. Declaration, printing, reading and
// checks follow from the entry.
#pragma once

#include <mortise/base/quotes.h>
#include <mortise/problem/input/parameter_description.h>
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
    Meaning                                     meaning;
    Allowed                                     allowed;
    std::function<void(const ParameterValue &)> set;  ///< the member
    std::string                                 type; ///< see type_of()
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

    /// An entry that sets @p member, of a type that ParameterValue reads. @p
    /// type: where that does not tell.
    template <typename T>
    void
    add(const std::string &name,
        T                 &member,
        const Meaning     &meaning,
        const Allowed     &allowed,
        const std::string &type = "") const
    {
      add(
        name,
        text_of(member, allowed),
        meaning,
        allowed,
        [&member](const ParameterValue &value) { value.read(member); },
        type.empty() ? type_of<T>(allowed) : type);
    }

    /// An entry of its own kind. Without @p type it is a selection if there are
    /// choices, else a text.
    void
    add(const std::string                          &name,
        const std::string                          &default_value,
        const Meaning                              &meaning,
        const Allowed                              &allowed,
        std::function<void(const ParameterValue &)> set,
        const std::string                          &type = "") const;

  private:
    template <typename T>
    struct IsOptional : std::false_type
    {};
    template <typename T>
    struct IsOptional<std::optional<T>> : std::true_type
    {};

    /// In one or two words, for programs that write parameter files.
    template <typename T>
    static std::string
    type_of(const Allowed &allowed)
    {
      if constexpr (std::is_same_v<T, bool>)
        return allowed.choices.back() == "true" ? "boolean" : "selection";
      else if constexpr (std::is_same_v<T, std::optional<std::string>>)
        return "expression";
      else if constexpr (IsOptional<T>::value)
        return type_of<typename T::value_type>(allowed);
      else if constexpr (std::is_same_v<T, Components>)
        return "list of expressions";
      else if constexpr (std::is_floating_point_v<T>)
        return "real";
      else if constexpr (std::is_integral_v<T>)
        return "integer";
      else if constexpr (std::is_enum_v<T> || std::is_same_v<T, std::string>)
        return allowed.choices.empty() ? "text" : "selection";
      else
        return "list of " + type_of<typename T::value_type>(allowed) + "s";
    }

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
