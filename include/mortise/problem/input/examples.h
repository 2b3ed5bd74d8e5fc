// The scenes that come with the program.
#pragma once

#include <mpi.h>

#include <string>

namespace mortise
{
  /// A line for each scene: its name and its title.
  std::string
  list_of_examples();

  /// Write the scene @p name and the mesh files that it names into the current
  /// directory; returns what was written and how to run it. Throws InputError
  /// on all ranks if there is no such scene, or if one of the files is there
  /// already, and then writes none. Collective.
  std::string
  write_example(const std::string &name, MPI_Comm comm);
} // namespace mortise
