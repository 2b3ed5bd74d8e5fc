// Prescribed displacements of one body as constraints, and prescribed tractions
// as data.
#pragma once

#include <mortise/body/boundary_faces.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace mortise
{
  /// A straight line, or a point where both ends are the same.
  using Segment = std::array<dealii::Point<dim>, 2>;

  /// A prescribed displacement of some components on one boundary, or at
  /// vertices and edges of the mesh on the surface of the body.
  struct DirichletCondition
  {
    dealii::types::boundary_id boundary = dealii::numbers::invalid_boundary_id;
    std::array<bool, dim>      fixed{}; ///< components it prescribes
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>
                           value;     ///< a length; empty: zero
    std::optional<Segment> segment{}; ///< in place of a boundary
    /// The boundary belongs to a rigid part, whose motion is an unknown; the
    /// value is empty.
    bool is_rigid = false;
  };

  /// A prescribed traction on one boundary.
  struct TractionCondition
  {
    dealii::types::boundary_id boundary;
    /// Force per area at a point with outward unit normal.
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &,
                                         const dealii::Tensor<1, dim> &)>
      traction;
  };

  /// A pressure that acts on the deformed boundary.
  struct PressureCondition
  {
    dealii::types::boundary_id boundary;
    /// Force per deformed area at a point of the undeformed boundary, positive
    /// when pressing.
    std::function<double(const dealii::Point<dim> &)> pressure;
  };

  /// Faces of owned and ghost cells of @p body with a vertex at which @p condition prescribes something.
  std::vector<BoundaryFace>
  faces_of(const Body &body, const DirichletCondition &condition);

  /// Does @p condition prescribe something at vertex @p v of the cell of one of its faces? On a segment it
  /// does to a millionth of the cell's size.
  bool
  prescribes_vertex(const DirichletCondition &condition,
                    const Body::CellIterator &cell,
                    unsigned int              v);

  /// Constrain the displacements of @p body on its Dirichlet boundaries. The values are interpolated
  /// by projections: at vertices, then in L2 on edges, then on faces, up to the
  /// degree that conformity leaves (Demkowicz, projection-based interpolation).
  /// Where boundaries meet, the first
  /// condition that prescribes a component counts. @p constraints holds the body's conformity
  /// constraints, is not closed, and stays so; dofs that it constrains are left
  /// alone. Collective.
  void
  add_dirichlet_constraints(const Body                            &body,
                            const std::vector<DirichletCondition> &conditions,
                            dealii::AffineConstraints<double>     &constraints);
} // namespace mortise
