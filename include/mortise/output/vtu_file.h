// VTU files of all ranks' cells. It chooses no fields.
#pragma once

#include <deal.II/base/point.h>

#include <mortise/output/lagrange_cells.h>
#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mortise
{
  /// A field of 1, 3 (vector) or 9 (tensor) components, those of a point or
  /// cell one after the other. Single precision: its digits are those of a
  /// solution.
  struct VtuField
  {
    std::string        name;
    unsigned int       n_components = 1;
    std::vector<float> values;
  };

  /// Data of one rank: cells without common points, so that fields may jump.
  struct VtuPiece
  {
    /// The next cell has the points that are added until the next call.
    void
    begin_cell(LagrangeShape shape, unsigned int degree);

    /// The next point of the cell, in the order of lagrange_nodes().
    void
    add_point(const dealii::Point<3> &point)
    {
      points.insert(points.end(), point.begin_raw(), point.end_raw());
    }

    /// Double precision: areas of small cells far from the origin are
    /// differences.
    std::vector<double>       points;
    std::vector<std::int32_t> offsets; ///< by cell: points up to its end
    std::vector<std::uint8_t> types;
    std::vector<VtuField>     of_points, of_cells;
  };

  /// Write the pieces of all ranks, which have the same fields, into @p file.
  /// Throws OutputError on every rank as write_whole_file() does. Collective.
  void
  write_vtu_file(const VtuPiece &piece, const std::string &file, MPI_Comm comm);
} // namespace mortise
