// Sizes and quality of the cells of a mesh that no triangulation was made of.
#pragma once

#include <mortise/body/mesh/generators.h>

#include <limits>
#include <vector>

namespace mortise
{
  /// Of a number that all cells (or edges) have.
  struct MeasureRange
  {
    double      least    = std::numeric_limits<double>::max();
    double      greatest = std::numeric_limits<double>::lowest();
    double      sum      = 0.;
    std::size_t count = 0, least_cell = 0, greatest_cell = 0;

    /// @p cell has @p value.
    void
    add(double value, std::size_t cell);

    double
    mean() const
    {
      return sum / count;
    }
  };

  struct MeshMeasures
  {
    std::vector<double> volumes;     ///< of the cells, curved ones as they are
    std::vector<double> areas;       ///< of the boundary faces
    MeasureRange        edges;       ///< straight lengths, of each cell
    MeasureRange        edge_ratios; ///< longest over shortest of a cell

    /// The least over the corners of a cell of the determinant of the unit
    /// vectors along its three edges; of a tetrahedron six times its volume
    /// over the largest product of the three edges at a vertex, times the root
    /// of two, so that a regular one has 1. Source: Stimpson, Ernst, Knupp,
    /// Pebay, Thompson, The Verdict library reference manual (2007).
    MeasureRange scaled_jacobians;
  };

  /// Cells may be inside out or have no volume.
  MeshMeasures
  measure(const CoarseMesh &mesh);
} // namespace mortise
