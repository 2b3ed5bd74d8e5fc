// Nodes of curved hexahedra beside larger ones: where a face or an edge hangs
// the smaller cells follow the polynomial of the larger one, not the manifold,
// so that no gap of order h^(p + 1) opens between them.
#pragma once

#include <mortise/body/elements/hexahedral_mapping.h>

#include <map>
#include <utility>
#include <vector>

namespace mortise
{
  /// By level and index of a cell, HexahedralMapping::nodes().
  using NodesOfCells =
    std::map<std::pair<int, int>, std::vector<dealii::Point<3>>>;

  /// Of those owned and ghost cells of @p triangulation that @p mapping, of degree @p degree, is to have other
  /// nodes on: the corrections of what hangs go on linearly to what does not
  /// (transfinite interpolation, Gordon and Hall 1973). Cells that share a vertex differ by one
  /// level at most. Collective.
  NodesOfCells
  conforming_nodes(const HexahedralMapping        &mapping,
                   unsigned int                    degree,
                   const dealii::Triangulation<3> &triangulation);
} // namespace mortise
