// A curved face of a body's surface as plain data, with box, size, frame,
// vertex normals and area.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <mortise/interface/reference_face.h>

#include <array>
#include <cstdint>
#include <vector>

namespace mortise
{
  /// Linearisation of a face about its centre for search and initial guesses.
  /// The chart of a point x is center_xi + dual[i] . (x - center), exact for an
  /// affine face and independent of the position along @p normal.
  struct FaceFrame
  {
    double           center_xi = 0.5; ///< see center_coordinate()
    dealii::Point<3> center; ///< the face's point at (center_xi, center_xi)
    std::array<dealii::Tensor<1, 3>, 2> tangent; ///< derivatives at the centre
    std::array<dealii::Tensor<1, 3>, 2>
      dual; ///< dual[i].tangent[j] = delta_ij, dual.normal = 0
    dealii::Tensor<1, 3> normal; ///< mean of the vertex normals, unit length
    ReferenceBox         chart;  ///< of the whole face in its own chart
    double               height_lower; ///< extent along normal about the centre
    double               height_upper;

    /// Gradients of the chart coordinates and, third, of their sum, which
    /// bounds a triangle as well.
    dealii::Tensor<1, 3>
    axis(const unsigned int i) const
    {
      return i < 2 ? dual[i] : dual[0] + dual[1];
    }
  };

  /// One curved face. The caller fills the first group; finalize() derives the
  /// second.
  struct SurfaceFace
  {
    FaceShape    shape  = FaceShape::quadrilateral;
    unsigned int degree = 1; ///< of the geometry, 1..8

    /// (degree+1)^2 support points of the tensor Lagrange basis on the
    /// Gauss-Lobatto nodes of [0,1]^2, first coordinate fastest. The geometry
    /// of a triangle is a polynomial of total degree g: those points (i, j) of
    /// the square with i + j <= g lie in it and define it; finalize() computes
    /// the others, on its continuation. Any origin; lengths in the scene's
    /// unit.
    std::vector<dealii::Point<3>> points;

    /// orientation * (dx/dxi_1 x dx/dxi_2) is the outward normal of the face's
    /// body; +1 or -1.
    double orientation = 1.;

    /// The continuous normal field at the vertices (0,0), (1,0), (0,1), (1,1):
    /// outward, unit length, equal on all faces around a vertex. All zero:
    /// finalize() takes the face's own. A triangle's last entry is n[1] + n[2]
    /// - n[0], set by finalize(): it makes the bilinear field the linear one.
    std::array<dealii::Tensor<1, 3>, 4> vertex_normals;

    std::uint64_t id    = 0; ///< global, unique on its side of the interface
    unsigned int  owner = 0; ///< rank that owns the face

    /// Data that travel with the face (for instance dof indices).
    std::vector<char> payload;

    // Derived by finalize():
    bool affine = false; ///< a parallelogram or a flat straight triangle, to
                         ///< rounding (1e-12 of its size)
    bool linear = false; ///< affine, and all vertex normals equal to rounding
    dealii::Point<3> lower; ///< box that contains the whole curved face
    dealii::Point<3> upper;
    double           size = 0; ///< longest distance between two vertices
    FaceFrame        frame;

    /// Derive box, size, frame and flags from the points and normals. Throws
    /// InputError for a wrong number of points, a degree out of range and a
    /// face without area at its centre.
    void
    finalize();

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int version);
  };

  /// orientation * (dx/dxi_1 x dx/dxi_2) at the vertices: the outward normals
  /// of the face, weighted by area (not of unit length); a triangle's last
  /// entry is zero. Needs shape, points, degree and orientation only.
  std::array<dealii::Tensor<1, 3>, 4>
  corner_normals(const SurfaceFace &face);

  /// Set the vertex normals of all faces to the unit mean of the area-weighted
  /// corner normals of
  /// the faces that share a vertex; @p vertices holds four vertex numbers per face,
  /// of which a triangle's last one is ignored. Faces that
  /// other ranks own have to be among @p faces for the field to be the same on every rank.
  /// Call finalize() afterwards.
  void
  average_vertex_normals(
    std::vector<SurfaceFace>                        &faces,
    const std::vector<std::array<std::uint64_t, 4>> &vertices);

  /// Area of a face by the Gauss rule with @p n points per direction (0: exact for an
  /// affine face and to about 1e-13 for moderately curved faces).
  double
  face_area(const SurfaceFace &face, const unsigned int n = 0);

  /// Distance of @p face from the smooth surface that it approximates: size
  /// times angle / 4, with the angle between its own vertex normals and the
  /// averaged ones. Zero where faces meet smoothly.
  double
  sagitta(const SurfaceFace &face);

  /// The point of a face at reference coordinates @p xi.
  dealii::Point<3>
  face_point(const SurfaceFace &face, const dealii::Point<2> &xi);

  /// Outward unit normal of the curved face itself (not of the averaged field) at @p xi.
  dealii::Tensor<1, 3>
  face_normal(const SurfaceFace &face, const dealii::Point<2> &xi);

  /// The continuous normal field at @p xi: bilinear in the vertex normals, not normalised.
  dealii::Tensor<1, 3>
  averaged_normal(const SurfaceFace &face, const dealii::Point<2> &xi);


  template <class Archive>
  void
  SurfaceFace::serialize(Archive &archive, const unsigned int /*version*/)
  {
    int shape_number = static_cast<int>(shape);
    archive &shape_number &degree &points &orientation &id &owner &payload;
    shape = static_cast<FaceShape>(shape_number);
    for (auto &normal : vertex_normals)
      archive &normal;
    archive &affine &linear &lower &upper &size &frame.center_xi &frame
      .center                                                    &frame.normal;
    for (unsigned int i = 0; i < 2; ++i)
      archive &frame.tangent[i] & frame.dual[i] & frame.chart.lower[i];
    for (double &bound : frame.chart.upper)
      archive &bound;
    archive &frame.height_lower &frame.height_upper;
  }
} // namespace mortise
