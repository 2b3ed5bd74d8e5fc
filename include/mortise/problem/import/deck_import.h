// --import: a scene of an input deck of Abaqus or CalculiX.
#pragma once

#include <mortise/problem/input/parameters.h>
#include <mpi.h>

#include <string>

namespace mortise
{
  /// Write a scene of the deck @p file, NAME.inp, into the working directory or
  /// --output of @p settings: NAME.prm, and beside it NAME_BODY.inp with the mesh
  /// of each body. A body is what is connected and of one section; faces at
  /// which bodies share nodes are ties. Returns what was written, and what of
  /// the deck was left out or approximated, with its lines, which stands in the
  /// first lines of the scene, too. Collective; throws InputError for a deck
  /// that cannot be read, other settings, or files that are there already.
  std::string
  import_deck(const std::string &file, const Settings &settings, MPI_Comm comm);
} // namespace mortise
