// Numbers and texts of a JSON file that others may have changed: nothing is
// converted.
#pragma once

#include <nlohmann/json.hpp>

#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace mortise
{
  /// The T that @p json is; null is a number that is not finite. Throws
  /// std::out_of_range if it is something else or does not fit.
  template <typename T>
  T
  json_value(const nlohmann::ordered_json &json)
  {
    bool fits = false;
    if constexpr (std::is_same_v<T, std::string>)
      fits = json.is_string();
    else if constexpr (std::is_same_v<T, bool>)
      fits = json.is_boolean();
    else if constexpr (std::is_floating_point_v<T>)
      {
        if (json.is_null())
          return std::numeric_limits<T>::quiet_NaN();
        fits = json.is_number();
      }
    else
      {
        static_assert(std::is_unsigned_v<T>);
        fits =
          json.is_number_unsigned() &&
          json.template get<std::uint64_t>() <= std::numeric_limits<T>::max();
      }
    if (!fits)
      throw std::out_of_range("there is " +
                              json.dump(-1, ' ', true).substr(0, 40) +
                              " where another kind of value is expected");
    return json.template get<T>();
  }
} // namespace mortise
