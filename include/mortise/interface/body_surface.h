// The faces of a body on one named boundary: geometry as SurfaceFace, and the
// trace of the displacement on each as plain data that can travel to another
// rank.
#pragma once

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

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
    double       modulus = 1.; ///< Young's modulus behind the face
    double       depth   = 1.; ///< of the cell behind the face, normal to it
    std::vector<unsigned int> begin; ///< by row, one past the end included
    std::vector<dealii::types::global_dof_index>
                        column; ///< numbering of the scene
    std::vector<double> weight;
    /// By row: whose prescribed value is added, invalid where it is free.
    std::vector<dealii::types::global_dof_index> prescribed;
    /// By level, for iterative solvers that use a NodalSpace, else empty.
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

  /// Faces of one boundary, or of a part of it, that belong to cells this rank
  /// owns, in one order.
  struct BodySurface
  {
    std::vector<SurfaceFace>
      faces; ///< finalized; the payload is the packed trace
    std::vector<FaceTrace>          traces;
    std::vector<Body::CellIterator> cells;
    std::vector<unsigned int>       face_numbers;
    std::vector<BoundaryFace>       known; ///< of ghost cells, too
    /// What stands for the normal along which bodies are tied, of unit length;
    /// absent: it does.
    std::optional<dealii::Tensor<1, dim>> direction;
  };

  /// The displacement u of a body by dof, with the values of ghosts, which
  /// takes surfaces to the configuration x = X + u; null: that of the mesh.
  using Displacement =
    const dealii::LinearAlgebra::distributed::Vector<double> *;

  /// The face's geometry, exactly; not finalized: that of the body's mapping,
  /// of its degree, or of that of the element if this is higher and the body is
  /// displaced.
  SurfaceFace
  face_geometry(const Body         &body,
                const BoundaryFace &face,
                Displacement        displacement = nullptr);

  /// The owned faces of the whole boundary, finalized; their normals are their
  /// own.
  std::vector<SurfaceFace>
  whole_boundary(const Body &body, Displacement displacement = nullptr);

  /// Numbers of the face's vertices in the mesh, as average_vertex_normals()
  /// takes them.
  std::array<std::uint64_t, 4>
  face_vertices(const BoundaryFace &face);

  /// The surface that consists of @p faces, which include those of ghost cells.
  /// Vertex normals are averaged over all faces among them around the vertex.
  /// @p constraints are those of the scene; @p levels fill the traces' nodes.
  BodySurface
  extract_surface(const Body                              &body,
                  const std::vector<BoundaryFace>         &faces,
                  const FieldNumbering                    &numbering,
                  const dealii::AffineConstraints<double> &constraints,
                  const NodalSpaces                       &levels = {},
                  Displacement displacement                       = nullptr);

  /// What faces @p surface everywhere and never moves: the same faces seen from the other side,
  /// with traces without columns.
  BodySurface
  rigid_counterpart(const BodySurface &surface);

  /// Dofs (numbering of the body's DoFHandler) of the face functions of
  /// component c: entry [c][k], k as in FaceTrace.
  std::array<std::vector<dealii::types::global_dof_index>, dim>
  face_dofs(const Body::CellIterator &cell, unsigned int face_number);
} // namespace mortise
