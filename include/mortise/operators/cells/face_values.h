// One face of the cells of a body at the points of a rule: where they are,
// normals, weights, and the functions that do not vanish there. Made much
// faster than deal.II's FEFaceValues, which tabulates all functions on all
// faces in all orientations.
#pragma once

#include <mortise/operators/cells/cell_geometry.h>

#include <array>
#include <vector>

namespace mortise
{
  /// The Gauss rule of @p n points per direction (on triangles one of the same
  /// degree 2 n - 1) on face @p f of the cells of @p element, at points of the
  /// unit cell; the weights are those of the face.
  dealii::Quadrature<dim>
  face_rule(const dealii::FiniteElement<dim> &element,
            unsigned int                      f,
            unsigned int                      n);

  /// Points per direction at which tractions on faces of @p element are
  /// integrated.
  inline unsigned int
  traction_points(const dealii::FiniteElement<dim> &element)
  {
    return element.degree + 2;
  }

  class FaceGeometry
  {
  public:
    /// For face @p f of the cells of @p body; @p rule is one of face_rule().
    FaceGeometry(const Body                    &body,
                 unsigned int                   f,
                 const dealii::Quadrature<dim> &rule);

    void
    reinit(const Body::CellIterator &cell);

    std::vector<dealii::Point<dim>>     points;
    std::vector<double>                 weights; ///< JxW
    std::vector<dealii::Tensor<1, dim>> normals; ///< outward, of unit length
    /// Two edges of the reference face in space; their cross product points
    /// outwards.
    std::vector<std::array<dealii::Tensor<1, dim>, 2>> tangents;

    /// The same in the unit cell.
    const std::array<dealii::Tensor<1, dim>, 2> &
    reference_tangents() const
    {
      return along;
    }

  private:
    CellGeometry                          geometry;
    std::vector<double>                   reference_weights;
    std::array<dealii::Tensor<1, dim>, 2> along; ///< the face, in the unit cell
  };

  class FaceValues : public FaceGeometry
  {
  public:
    /// For face @p f of @p cell and of all cells with its element, with @p n
    /// points per direction.
    FaceValues(const Body               &body,
               const Body::CellIterator &cell,
               unsigned int              f,
               unsigned int              n);

    /// Value of function k of indices() at point @p q.
    double
    value(const unsigned int k, const unsigned int q) const
    {
      return values[q * functions.size() + k];
    }

    /// Functions of the scalar element, in the order of CellFace.
    const std::vector<unsigned int> &
    indices() const
    {
      return functions;
    }

  private:
    FaceValues(const Body                    &body,
               const Body::CellIterator      &cell,
               unsigned int                   f,
               const dealii::Quadrature<dim> &rule);

    std::vector<unsigned int> functions;
    std::vector<double>       values;
  };
} // namespace mortise
