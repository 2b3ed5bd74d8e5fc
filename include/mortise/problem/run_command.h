// What the program does with its arguments once MPI has started.
#pragma once

#include <mortise/problem/input/command_line.h>
#include <mpi.h>

namespace mortise
{
  /// Run, continue or validate a scene, or print what was asked for, to
  /// std::cout. Collective; throws what run_guarded() makes exit codes of, also
  /// if something printed was lost.
  void
  run_command(const CommandLine &command, MPI_Comm comm);
} // namespace mortise
