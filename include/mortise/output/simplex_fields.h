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
  write_tetrahedra(const Body                   &body,
                   const BodySolution           &solution,
                   const FieldSelection         &selection,
                   const std::vector<CellField> &of_cells,
                   const std::string            &file);

  struct FieldFile
  {
    std::string name; ///< with its directory
    MPI_Comm    comm;
  };

  /// What write_interface_fields() writes of contact.
  inline std::vector<std::string>
  contact_field_names()
  {
    return {"pressure", "gap", "status"};
  }

  /// As write_interface_fields(), for triangles; @p multiplier and @p gap by face: coefficients
  /// [c n_functions + k], empty where there are none. @p is_contact: the components of the gap
  /// are contact_field_names(). Collective.
  void
  write_triangles(const FieldFile                        &file,
                  const BodySurface                      &surface,
                  const std::vector<std::vector<double>> &multiplier,
                  const std::vector<std::vector<double>> &gap,
                  bool                                    is_contact,
                  const BodyVector                       &displacement);
} // namespace mortise
