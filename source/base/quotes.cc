#include <mortise/base/quotes.h>


namespace mortise
{
  std::string
  shortened(const std::string &text, const std::size_t most)
  {
    if (text.size() <= most)
      return text;
    std::size_t end = most;
    // not within a character of several bytes (UTF-8)
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
      --end;
    return text.substr(0, end) + "...";
  }

  std::string
  in_quotes(const std::string &text, const char mark)
  {
    std::string shorter = shortened(text);
    const bool  whole   = shorter == text;
    // a message ends with its line, and at a zero
    for (char &c : shorter)
      if (std::iscntrl(static_cast<unsigned char>(c)))
        c = '?';
    return mark + shorter + mark +
           (whole ? "" : " (" + std::to_string(text.size()) + " characters)");
  }

  std::string
  file_in_quotes(const std::string &name, const char mark)
  {
    constexpr std::size_t most = 400, end = 100;
    return mark +
           (name.size() <= most ?
              name :
              shortened(name, most - end) + name.substr(name.size() - end)) +
           mark;
  }
} // namespace mortise
