// Errors that end the program with one message and a documented exit code.
#pragma once

#include <mpi.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace mortise
{
  /// Exit codes of the program (the contract with scripts).
  enum class ExitCode : int
  {
    success = 0,
    defect  = 1, ///< a defect of the program
    invalid_input =
      2, ///< the input is wrong: what, where, what was got, what is allowed
    not_converged = 3, ///< the solver did not reach its tolerance; what was
                       ///< reached is written
    memory = 4         ///< the machine is too small
  };                   // 128 + signal when interrupted

  /// Wrong input. The message says what is wrong, where, what was got and what
  /// is allowed.
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// Throw InputError with @p message on every rank of @p comm if any rank passes a message that
  /// is not empty (the message of the lowest such rank). Collective: every rank
  /// must call it, so that an error seen by one rank never leaves the others
  /// waiting.
  void
  throw_if_any(const std::string &message, MPI_Comm comm);

  /// The entry of @p allowed nearest to @p got by edit distance; empty if none is near.
  std::string
  nearest_name(const std::string &got, const std::vector<std::string> &allowed);

  /// The lines of @p texts below each other, @p most of them.
  std::string
  join_lines(const std::vector<std::string> &texts, std::size_t most);

  /// Entries joined as "a, b, c", the first of them if they are many; "(none)"
  /// for an empty list.
  std::string
  join_names(const std::vector<std::string> &names);
} // namespace mortise
