// Fields of a solution as VTU files for ParaView: one file per body, one per
// interface.
#pragma once

#include <mortise/output/errors.h>

#include <string>
#include <vector>

namespace mortise
{
  /// The root of 3/2 s : s, s the deviator of @p stress.
  double
  von_mises(const dealii::SymmetricTensor<2, dim> &stress);

  struct FieldSelection
  {
    bool displacement         = false; ///< length
    bool stress               = false; ///< force per area: tensor and von Mises
    bool pressure             = false; ///< mean pressure, -tr(stress) / 3
    bool plastic_strain       = false; ///< equivalent; zero of laws without
    bool deformation_gradient = false; ///< F = I + Grad u
    bool traction = false; ///< on slave surfaces: traction, gap, contact
  };

  /// A number for each cell.
  struct CellField
  {
    std::string         name;
    std::vector<double> values; ///< by active cell; those of owned cells count
  };

  /// @p file (.vtu) with displacement, stress and pressure of one body, and @p of_cells:
  /// Lagrange cells of VTK, each of the degree of its displacement, or of its
  /// geometry where that is higher. Collective; all ranks write one file.
  void
  write_body_fields(const Body                   &body,
                    const BodySolution           &solution,
                    const FieldSelection         &selection,
                    const std::vector<CellField> &of_cells,
                    const std::string            &file);

  /// @p file (.vtu) with the traction that the slave side bears (force per
  /// area), the displacement, and the gap (x_master - x_slave before
  /// deformation, a length) on the slave surface, and the covered fraction of
  /// each face. @p coefficients as of
  /// multiplier_on_faces(). @p contact: by face, coefficients of pressure, gap that is left and status of
  /// a contact, which are written in place of that gap; else empty.
  ///
  /// Traction and pressure are the polynomials on each face that do the same
  /// work on its functions as what acts on its covered part: their integrals
  /// are forces and moments on any mesh. Where nothing faces they and the gap
  /// are no number (NaN); the gap of a tie is also none where less than half of
  /// a face is covered. Collective.
  void
  write_interface_fields(const Body                             &slave_body,
                         const Coupling                         &coupling,
                         const std::vector<std::vector<double>> &coefficients,
                         const std::vector<std::vector<double>> &contact,
                         const BodyVector                       &displacement,
                         const std::string                      &file);
} // namespace mortise
