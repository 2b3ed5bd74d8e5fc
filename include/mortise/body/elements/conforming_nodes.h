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
  class ConformingNodes
  {
  public:
    /// Of owned and ghost cells of @p triangulation; @p mapping, of degree @p degree, has the nodes
    /// on the manifold, and must live on. The corrections of what hangs go on
    /// linearly to what does not (transfinite interpolation, Gordon and Hall
    /// 1973). Cells that share a vertex differ by one level at most.
    /// Collective.
    ConformingNodes(const HexahedralMapping        &mapping,
                    unsigned int                    degree,
                    const dealii::Triangulation<3> &triangulation);

    /// As HexahedralMapping::nodes().
    std::vector<dealii::Point<3>>
    nodes(const dealii::Triangulation<3>::cell_iterator &cell) const;

    /// The largest correction beside the shortest distance of vertices of its
    /// cell. Collective.
    double
    largest_shift() const;

  private:
    const HexahedralMapping        &mapping;
    const dealii::Triangulation<3> &triangulation;
    /// By level and index of a cell.
    std::map<std::pair<int, int>, std::vector<dealii::Point<3>>> changed;
  };
} // namespace mortise
