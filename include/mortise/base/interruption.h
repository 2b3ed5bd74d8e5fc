// Handling of signals that end the program: one message with the complete
// files, no unfinished file, exit code 128 + signal. A run that can stop
// between two steps is patient: the first signal asks it to, the second ends
// it.
#pragma once

#include <mpi.h>

#include <stdexcept>
#include <string>

// A handler of signals gets no argument: this is the one place of the program
// whose state is static.
namespace mortise::interruption
{
  /// From now on SIGINT, SIGTERM, SIGUSR1 and their like end the program as
  /// said above. Of several ranks the first speaks, until share_silence(): all
  /// of them are ended together. Call it before anything else and again when
  /// libraries are initialised, which may take signals for themselves.
  void
  catch_signals();

  /// Let the ranks on the machine of the first know from each other who has
  /// spoken: from now on the one that is interrupted first speaks, since Open
  /// MPI 5 may kill the others before they can. Collective.
  void
  share_silence(MPI_Comm comm);

  /// True if no rank of this machine has said why the program ends: the caller
  /// is to say it, and whoever is ended because of it says nothing more.
  bool
  speak_first();

  /// If @p patient, the first SIGINT, SIGTERM or SIGUSR1 from now on is kept for
  /// agreed_signal(). What was kept before stays.
  void
  be_patient(bool patient);

  /// The signal that a rank has kept, the greatest if they differ; 0: none.
  /// Collective.
  int
  agreed_signal(MPI_Comm comm);

  /// "SIGINT".
  std::string
  name_of_signal(int number);

  /// The run has stopped in good order because of a signal.
  class Interrupted : public std::runtime_error
  {
  public:
    Interrupted(const int signal, const std::string &what)
      : std::runtime_error(what)
      , signal(signal)
    {}

    const int signal;
  };

  /// The file to be removed; none if empty.
  void
  set_unfinished(const std::string &file);

  /// A result is complete.
  void
  add_complete(const std::string &file);

  /// "complete are: A, B", of many only the last, or that nothing was written.
  std::string
  what_is_complete();
} // namespace mortise::interruption
