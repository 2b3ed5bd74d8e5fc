// The cells of Abaqus, CalculiX and VTK, which have the same order of nodes.
#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace mortise
{
  /// Vertices in gmsh's reference cells, edges in the order of the nodes in
  /// their middles, and faces S1, S2, ...
  struct InpShape
  {
    std::string                              name; ///< gmsh's
    std::vector<dealii::Point<3>>            vertices;
    std::vector<std::array<unsigned int, 2>> edges;
    std::vector<std::vector<unsigned int>>   faces;
  };

  /// @p n_vertices: 4, 5, 6 or 8.
  const InpShape &
  inp_shape(unsigned int n_vertices);

  /// What TYPE of *ELEMENT says: "C3D10M" is a solid of 10 nodes, "S4R" a part
  /// of a surface.
  struct InpType
  {
    unsigned int dimension  = 0; ///< 3; 2; 0: neither
    unsigned int n_nodes    = 0;
    unsigned int n_vertices = 0; ///< 0: unknown
  };

  /// @p name in capitals.
  InpType
  inp_type(const std::string &name);
} // namespace mortise
