// --pairs: the bodies of a file, which of their faces lie opposite each other,
// and a scene to begin with.
#pragma once

#include <mortise/problem/input/parameters.h>
#include <mpi.h>

#include <string>

namespace mortise
{
  /// A table of the pairs of faces of different bodies (physical volumes,
  /// solids
  /// of a CAD file) of @p file. NAME.prm is written into the working directory
  /// or --output: the bodies, with the pairs as ties where they touch and as
  /// contact where they are apart; materials, supports and loads are left to
  /// the
  /// user. @p settings: also "Mesh size=..." and "Search distance=...", which
  /// is a fiftieth of the smallest body otherwise. Collective; throws
  /// InputError for a file that cannot be read, or if NAME.prm is there.
  std::string
  list_pairs(const std::string &file, const Settings &settings, MPI_Comm comm);
} // namespace mortise
