// The lines that tests print, on rank 0 of the world alone, and what they ask
// of messages.
#pragma once

#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>

#include <functional>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

/// Many tests are programs without MPI.
inline bool
uses_mpi()
{
  int initialized = 0;
  MPI_Initialized(&initialized);
  return initialized != 0;
}

/// Prints "OK  what", or "FAILED  what" with what was @p got instead; returns
/// @p good.
template <typename Got = std::string>
bool
verdict(const bool good, const std::string &what, const Got &got = "nothing")
{
  if (!uses_mpi() ||
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      std::cout << (good ? "OK  " : "FAILED  ") << what;
      if (!good)
        std::cout << ": got " << got;
      std::cout << std::endl;
    }
  return good;
}

/// Verdict: @p got is at most @p allowed.
inline bool
verdict(const std::string &what, const double got, const double allowed)
{
  std::ostringstream text;
  text << got << ", allowed " << allowed;
  return verdict(got <= allowed, what, text.str());
}

/// Message of an error of @p action, "(no error)" without one.
inline std::string
message_of(const std::function<void()> &action)
{
  try
    {
      action();
    }
  catch (const mortise::InputError &error)
    {
      return error.what();
    }
  catch (const std::exception &error)
    {
      return std::string("another kind of error: ") + error.what();
    }
  return "(no error)";
}

/// Verdict: all ranks have the same @p message, with all @p fragments.
/// Collective.
inline void
check_message(const std::string              &what,
              const std::string              &message,
              const std::vector<std::string> &fragments)
{
  namespace Ranks = dealii::Utilities::MPI;
  bool good       = true;
  for (const std::string &fragment : fragments)
    good = good && message.find(fragment) != std::string::npos;
  if (uses_mpi())
    {
      const bool same = message == Ranks::broadcast(MPI_COMM_WORLD, message, 0);
      good            = Ranks::min<int>(good && same, MPI_COMM_WORLD) == 1;
    }
  verdict(good, what, "\"" + message + "\"");
}

/// Verdict: what an error of @p action says has all @p fragments. Collective.
inline void
check_message(const std::string              &what,
              const std::function<void()>    &action,
              const std::vector<std::string> &fragments)
{
  check_message(what, message_of(action), fragments);
}
