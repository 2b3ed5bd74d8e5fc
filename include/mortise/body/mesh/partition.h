// Partition of the cells of a mesh by METIS.
#pragma once

#include <deal.II/grid/tria.h>

#include <set>

namespace mortise
{
  /// Set the subdomain ids of all cells of the serial @p triangulation to @p n_parts parts with few
  /// common faces, each with about the same number of cells and, of cells with
  /// a face on one of
  /// @p boundaries (an interface costs there), about the same number as well. The same on every
  /// rank. With fewer cells than parts some parts stay empty. Source: Karypis
  /// and Kumar, Multilevel algorithms for multi-constraint graph partitioning
  /// (1998).
  void
  partition_cells(unsigned int                                n_parts,
                  const std::set<dealii::types::boundary_id> &boundaries,
                  dealii::Triangulation<3>                   &triangulation);
} // namespace mortise
