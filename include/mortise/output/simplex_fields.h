// Fields on bodies of tetrahedra and on their surfaces, written as small linear
// cells. It never chooses what is written.
#pragma once

#include <mortise/output/fields.h>

#include <string>
#include <vector>

namespace mortise
{
  /// As write_body_fields(), for tetrahedra. Collective.
  void
  write_tetrahedra(const Body           &body,
                   const BodySolution   &solution,
                   const FieldSelection &selection,
                   const std::string    &file);

  struct FieldFile
  {
    std::string name; ///< with its directory
    MPI_Comm    comm;
  };

  /// As write_interface_fields(), for triangles; @p multiplier and @p gap by face: coefficients
  /// [c n_functions + k], empty where there are none. Collective.
  void
  write_triangles(const FieldFile                        &file,
                  const BodySurface                      &surface,
                  const std::vector<std::vector<double>> &multiplier,
                  const std::vector<std::vector<double>> &gap,
                  const BodyVector                       &displacement);
} // namespace mortise
