// Conversion of errors into messages and exit codes on any number of ranks.
#pragma once

#include <mpi.h>

#include <functional>
#include <iosfwd>
#include <stdexcept>

namespace mortise
{
  /// The solver did not reach its tolerance. Thrown after the last result has
  /// been written.
  class ConvergenceError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// Run @p program on every rank of @p comm and return the exit code of the
  /// process: 0, 2 after InputError, 3 after ConvergenceError, 4 when memory
  /// ran out, 1 after anything else. If any rank fails, one message (of the
  /// lowest failed rank) goes to @p error, and every rank returns the same
  /// code. A rank that fails while others wait for it prints its message and
  /// aborts all with the code after @p patience seconds, after one second if
  /// memory ran out. Collective.
  int
  run_guarded(MPI_Comm                     comm,
              const std::function<void()> &program,
              std::ostream                &error,
              double                       patience = 10.);
} // namespace mortise
