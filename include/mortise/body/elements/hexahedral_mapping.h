// The mapping of hexahedra: deal.II's cached one, whose nodes can be read.
#pragma once

#include <deal.II/fe/mapping_q_cache.h>

#include <vector>

namespace mortise
{
  class HexahedralMapping : public dealii::MappingQCache<3>
  {
  public:
    using dealii::MappingQCache<3>::MappingQCache;

    /// Points of the cell at the Gauss-Lobatto points of the mapping's degree,
    /// in the order of deal.II's FE_Q; valid after initialize().
    std::vector<dealii::Point<3>>
    nodes(const dealii::Triangulation<3>::cell_iterator &cell) const
    {
      return compute_mapping_support_points(cell);
    }
  };
} // namespace mortise
