// The points of a face of a cell in the unit cell of its neighbour, from
// vertices alone, without orientation flags.
#pragma once

#include <mortise/body/body.h>

#include <array>
#include <optional>
#include <vector>

namespace mortise
{
  struct NeighbourFace
  {
    unsigned int                number = 0; ///< of the face in the neighbour
    std::array<unsigned int, 3> corners{};  ///< its vertices there
    /// Number of the cell among the children of a cell with these corners;
    /// nothing: they are its own.
    std::optional<unsigned int> child;
  };

  /// The face of @p neighbour at face @p f of @p cell, which is as large or one
  /// halving smaller.
  NeighbourFace
  neighbour_face(const Body::CellIterator &cell,
                 unsigned int              f,
                 const Body::CellIterator &neighbour);

  /// The points of face_rule() with @p n points per direction on face @p f of the cells of
  /// @p element, in the unit cell @p beyond.
  std::vector<dealii::Point<dim>>
  points_in_neighbour(const dealii::FiniteElement<dim> &element,
                      unsigned int                      f,
                      unsigned int                      n,
                      const NeighbourFace              &beyond);
} // namespace mortise
