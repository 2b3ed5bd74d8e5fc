// The faces of a body on one named boundary: geometry as SurfaceFace, and the
// trace of the displacement on each as plain data that can travel to another
// rank.
#pragma once

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/base/rigid_motion.h>
#include <mortise/body/body.h>
#include <mortise/body/boundary_faces.h>
#include <mortise/body/elements/trace_basis.h>
#include <mortise/body/spaces/nodal_space.h>
#include <mortise/body/spaces/numbering.h>
#include <mortise/interface/surface_face.h>

#include <optional>
#include <vector>

namespace mortise
{
  /// Displacement on one face: u_c(xi) = sum_k N_k(xi) (sum_j weight_j
  /// d_column_j + g_dof), with N_k the functions of basis() and row = c
  /// n_functions() + k. Constraints of the body are resolved.
  struct FaceTrace
  {
    FaceShape    shape   = FaceShape::quadrilateral;
    unsigned int degree  = 1;
    double       modulus = 1.;       ///< Young's modulus behind the face
    double       depth   = 1.;       ///< height of the cell behind the face
    std::vector<unsigned int> begin; ///< by row, one past the end included
    std::vector<dealii::types::global_dof_index>
                        column; ///< numbering of the scene
    std::vector<double> weight;
    /// By row: the dof whose prescribed value g is added; invalid where there
    /// is none.
    std::vector<dealii::types::global_dof_index> prescribed;
    /// By level of the multigrid; empty for the direct solver.
    std::vector<FaceNodes> nodes;

    const TraceBasis &
    basis() const
    {
      return trace_basis(shape, degree);
    }

    unsigned int
    n_functions() const
    {
      return basis().size();
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      int shape_number = static_cast<int>(shape);
      archive &shape_number &degree &modulus &depth &begin &column &weight
        &prescribed &nodes;
      shape = static_cast<FaceShape>(shape_number);
    }
  };

  /// The faces of a boundary, or of a part of it, on owned cells. The vectors
  /// have the same order.
  struct BodySurface
  {
    std::vector<SurfaceFace>
      faces; ///< finalized; the payload is the packed trace
    /// Of a displaced slave the faces where they were, finalized; else empty.
    std::vector<SurfaceFace>        undeformed;
    std::vector<FaceTrace>          traces;
    std::vector<Body::CellIterator> cells;
    std::vector<unsigned int>       face_numbers;
    std::vector<BoundaryFace>       known; ///< of ghost cells, too
    /// Unit vector that takes the place of the normal, for supports.
    std::optional<dealii::Tensor<1, dim>> direction;

    /// Face @p s in its body.
    const SurfaceFace &
    undeformed_face(const unsigned int s) const
    {
      return undeformed.empty() ? faces[s] : undeformed[s];
    }
  };

  /// The displacement u of a body by dof, with ghost values, of the
  /// configuration x = X + u; null: u = 0.
  using Displacement =
    const dealii::LinearAlgebra::distributed::Vector<double> *;

  /// The exact geometry of the face, not finalized. Its degree is that of the
  /// mapping, in a displaced body at least that of the element.
  SurfaceFace
  face_geometry(const Body         &body,
                const BoundaryFace &face,
                Displacement        displacement = nullptr);

  /// The owned faces of the whole boundary, finalized, with normals of their
  /// own. Collective; throws InputError where a face has no area.
  std::vector<SurfaceFace>
  whole_boundary(const Body &body, Displacement displacement = nullptr);

  /// Numbers of the face's vertices in the mesh, as average_vertex_normals()
  /// takes them.
  std::array<std::uint64_t, 4>
  face_vertices(const BoundaryFace &face);

  /// The surface that consists of @p faces, which include those of ghost cells.
  /// Vertex normals are averaged over all faces among them around the vertex.
  /// @p constraints are those of the scene; @p levels fill the traces' nodes.
  /// Collective; throws InputError where a face has no area.
  BodySurface
  extract_surface(const Body                              &body,
                  const std::vector<BoundaryFace>         &faces,
                  const FieldNumbering                    &numbering,
                  const dealii::AffineConstraints<double> &constraints,
                  const NodalSpaces                       &levels = {},
                  Displacement displacement                       = nullptr);

  /// BodySurface::undeformed of @p surface, whose body is displaced.
  std::vector<SurfaceFace>
  undeformed_faces(const Body &body, const BodySurface &surface);

  /// Move @p faces by @p motion.
  void
  place(const RigidMotion &motion, std::vector<SurfaceFace> &faces);

  /// A rigid surface that coincides with @p surface and faces it; its traces
  /// have no columns.
  BodySurface
  rigid_obstacle(const BodySurface &surface);

  /// Dofs (numbering of the body's DoFHandler) of the face functions of
  /// component c: entry [c][k], k as in FaceTrace.
  std::array<std::vector<dealii::types::global_dof_index>, dim>
  face_dofs(const Body::CellIterator &cell, unsigned int face_number);
} // namespace mortise
