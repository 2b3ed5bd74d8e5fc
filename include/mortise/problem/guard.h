// The one place where errors become messages and exit codes, on any number of
// ranks.
#pragma once

#include <mpi.h>

#include <functional>
#include <iosfwd>
#include <stdexcept>

namespace mortise
{
  /// The solver did not reach its tolerance. Thrown after what was reached has
  /// been written.
  class ConvergenceError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// Run @p program on every rank of @p comm and return the exit code of the process: 0, 2 after
  /// InputError, 3 after ConvergenceError, 4 when memory ran out, 1 after
  /// anything else. If any rank fails, one message (of the lowest failed rank)
  /// goes to @p error, and every rank returns the same code. When a rank fails
  /// alone, so that others wait for it in vain, it prints and aborts all of
  /// them with the code after @p patience seconds; after one second when memory
  /// ran out, which happens to one rank easily. Collective.
  int
  run_guarded(MPI_Comm                     comm,
              const std::function<void()> &program,
              std::ostream                &error,
              double                       patience = 10.);
} // namespace mortise
