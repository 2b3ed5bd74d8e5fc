// Bodies whose cells are much shorter along one direction than along the
// others, and how nodes lie across these. It knows nothing of numberings.
#pragma once

#include <deal.II/base/point.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/body/body.h>

#include <utility>
#include <vector>

namespace mortise
{
  /// By body: are its cells so much shorter along one direction than along the
  /// others that this pays? Those of one body are enough for the others to need
  /// less. Tetrahedra of several degrees above 2 are not. Collective.
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

  /// How the nodes of a cell of a flat body lie across it.
  struct NodesAcross
  {
    /// All that lie on one, by lines.
    std::vector<std::vector<unsigned int>> lines;

    /// Nodes of tetrahedra that lie on none, with what a function of the
    /// triangle that a cell becomes when its short edge shrinks, or times what
    /// is linear along that, has there: a sum of (node on a line, weight).
    std::vector<
      std::pair<unsigned int, std::vector<std::pair<unsigned int, double>>>>
      others;
  };

  NodesAcross
  nodes_across(const Body::CellIterator &cell, unsigned int degree);
} // namespace mortise
