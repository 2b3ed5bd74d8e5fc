// Preparation of a process before MPI starts: processors, memory, signals.
#pragma once

namespace mortise
{
  /// Catch signals, take one BLAS thread and its memory, and look for no
  /// network in a run without mpirun. Begin again with the @p arguments of main() where BLAS would take
  /// kernels of an old processor. Ends the program with a message and
  /// ExitCode::memory if there is not even room to start. To be called once,
  /// first of all.
  void
  prepare_process(char *arguments[]);
} // namespace mortise
