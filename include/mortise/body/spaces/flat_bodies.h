// Bodies whose cells are much shorter along one direction than along the
// others, and how nodes lie across these. It knows nothing of numberings.
#pragma once

#include <deal.II/base/point.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/body/body.h>

#include <vector>

namespace mortise
{
  /// By body: are its cells, hexahedra of any degree or tetrahedra of degree 1
  /// or 2, so much shorter along one direction than along the others that this
  /// pays? Those of one body are enough for the others to need less.
  /// Collective.
  std::vector<bool>
  find_flat_bodies(const std::vector<const Body *> &bodies);

  /// Values at the nodes of a cell of the functions of degree one: entry (node,
  /// vertex). Nodes are in the order of NodalSpace::get_nodes(), here and
  /// below.
  dealii::FullMatrix<double>
  linear_values(const Body::CellIterator &cell, unsigned int degree);

  /// The nodes of a cell as if its edges were straight.
  std::vector<dealii::Point<dim>>
  straight_positions(const Body::CellIterator &cell, unsigned int degree);

  /// The nodes of a cell of a flat body by the lines across it that they lie
  /// on.
  std::vector<std::vector<unsigned int>>
  lines_across(const Body::CellIterator &cell, unsigned int degree);
} // namespace mortise
