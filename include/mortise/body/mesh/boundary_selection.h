// The parameter "Boundaries": boundaries of a file that are chosen by where
// they are and what shape they have.
#pragma once

#include <mortise/body/mesh/generators.h>

#include <string>
#include <vector>

namespace mortise
{
  /// One condition of an entry "name: condition and condition ...". Faces that
  /// satisfy any of them are in the boundary.
  struct FaceCondition
  {
    std::string kind; ///< plane, box, sphere, cylinder, free, faces, named
    std::vector<double>
           numbers;     ///< of plane: a point, a normal; of box: two corners
    double radius = 0.; ///< 0: any
    std::vector<double>      near;  ///< a point, or nothing
    std::vector<std::string> names; ///< of faces: their numbers
  };

  struct BoundarySelection
  {
    std::string                boundary;
    std::string                text; ///< the entry, for messages
    std::vector<FaceCondition> conditions;
  };

  /// Throws InputError (starting with @p where) for what it does not understand.
  std::vector<BoundarySelection>
  parse_boundaries(const std::string &text, const std::string &where);

  /// Give the chosen faces of @p mesh ids and names of their own; they leave the
  /// boundaries that the file has put them in. @p cad: see surface_patches().
  /// Entries that choose nothing, or what another one has, are findings of
  /// @p mesh. Throws InputError (starting with @p where) for what is no entry.
  void
  select_boundaries(CoarseMesh        &mesh,
                    const std::string &text,
                    bool               cad,
                    const std::string &where);
} // namespace mortise
