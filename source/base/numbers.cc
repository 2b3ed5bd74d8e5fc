#include <mortise/base/numbers.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace mortise
{
  namespace
  {
    std::string
    range(const double smallest, const double largest)
    {
      std::ostringstream text;
      text << "from " << smallest << " to " << largest;
      return text.str();
    }

    /// Has the decimal number @p text a digit that is not 0 before its exponent?
    bool
    is_not_zero(const std::string &text)
    {
      return text.substr(0, text.find_first_of("eE"))
               .find_first_of("123456789") != std::string::npos;
    }
  } // namespace

  std::string
  allowed_numbers()
  {
    return "0, or " + range(smallest_number, largest_number) + " in magnitude";
  }

  std::string
  allowed_lengths()
  {
    return range(smallest_length, largest_length);
  }

  std::string
  allowed_moduli()
  {
    return range(smallest_modulus, largest_modulus);
  }

  ReadNumber
  read_number(const std::string &text)
  {
    ReadNumber  result;
    char       *end   = nullptr;
    const char *begin = text.c_str();
    // never fails at numbers out of range: they become 0, denormal or infinite
    result.value = std::strtod(begin, &end);
    if (end == begin)
      {
        result.problem = "is no number";
        return result;
      }
    while (std::isspace(static_cast<unsigned char>(*end)))
      ++end;
    const double size = std::fabs(result.value);
    if (end != begin + text.size())
      result.problem = "is no number";
    else if (std::isnan(result.value))
      result.problem = "is not finite";
    else if (size > largest_number)
      result.problem = "is too large";
    else if (size < smallest_number && (size > 0. || is_not_zero(text)))
      result.problem = "is too small";
    return result;
  }
} // namespace mortise
