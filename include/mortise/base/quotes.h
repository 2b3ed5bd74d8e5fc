// Input as messages quote it: short, whatever they got.
#pragma once

#include <string>

namespace mortise
{
  /// @p text, or its start and "..." if it has more than @p most characters.
  std::string
  shortened(const std::string &text, std::size_t most = 80);

  /// @p text between quotation @p marks, shortened, with a question mark for
  /// what cannot be printed; a shortened one tells how many characters it has.
  std::string
  in_quotes(const std::string &text, char mark = '"');

  /// The same for the name of a file, of which much more is kept, and its end.
  std::string
  file_in_quotes(const std::string &name, char mark = '"');
} // namespace mortise
