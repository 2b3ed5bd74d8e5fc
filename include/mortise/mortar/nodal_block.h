// Change of basis on faces from hierarchical functions to nodal ones of the
// same or a lower degree.
#pragma once

#include <deal.II/base/point.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/body/elements/face_shape.h>
#include <mortise/body/spaces/nodal_space.h>

#include <vector>

namespace mortise
{
  /// Functions of the rows or columns of a block before and after.
  struct BlockSide
  {
    FaceShape    shape;
    unsigned int modal; ///< degree of the hierarchical functions
    unsigned int nodal; ///< degree of the nodal functions; 0: left as it is
  };

  /// @p modal in nodal functions: F_r^T modal F_c, where F expands the nodal
  /// functions of a face in the hierarchical ones. All in the order of
  /// TraceBasis.
  dealii::FullMatrix<double>
  nodal_block(const dealii::FullMatrix<double> &modal,
              const BlockSide                  &rows,
              const BlockSide                  &columns);

  /// The nodal functions of a face: N, the values of the hierarchical functions
  /// at the nodes (node, function), and F = N^{-1}, which expands the nodal
  /// functions in the hierarchical ones (function, node). Both are block
  /// triangular, vertices in front of edges in front of what is inside.
  struct FaceNodalBasis
  {
    dealii::FullMatrix<double> values, functions;
  };

  /// Made once for each shape and degree.
  const FaceNodalBasis &
  face_nodal_basis(FaceShape shape, unsigned int degree);

  /// The nodes, in coordinates of the face.
  std::vector<dealii::Point<2>>
  face_nodes(FaceShape shape, unsigned int degree);

  /// F_r^T A F_c, where F_r and F_c are the constraints of hanging nodes on the
  /// faces of rows and columns; A if there are none.
  dealii::FullMatrix<double>
  resolve_hanging(dealii::FullMatrix<double> A,
                  const FaceNodes           &rows,
                  const FaceNodes           &columns);
} // namespace mortise
