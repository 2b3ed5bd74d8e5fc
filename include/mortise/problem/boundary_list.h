// --boundaries: the faces of a mesh or CAD file, for the parameter
// "Boundaries".
#pragma once

#include <mortise/problem/input/parameters.h>
#include <mpi.h>

#include <string>

namespace mortise
{
  /// A table of the faces of @p file with number, shape, area, centre, box and
  /// name. Written beside it are NAME-faces.vtu, whose cells have the number of
  /// their face, and NAME-faces.svg, a picture from two opposite sides, into
  /// the working directory or --output. @p settings: also "Mesh size=..." and
  /// "Part=..." with the meaning that they have for a body. Collective; throws
  /// InputError or OutputError.
  std::string
  list_boundaries(const std::string &file,
                  const Settings    &settings,
                  MPI_Comm           comm);
} // namespace mortise
