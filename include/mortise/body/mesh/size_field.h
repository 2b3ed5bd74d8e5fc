// Edge lengths that are wanted of a new mesh, from point to point: linear on
// the cells of the old one.
#pragma once

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <deal.II/numerics/rtree.h>

#include <array>
#include <utility>
#include <vector>

namespace mortise
{
  class SizeField
  {
  public:
    /// A tetrahedron of positive volume, and edge lengths at its vertices.
    struct Cell
    {
      std::array<dealii::Point<3>, 4> vertices;
      std::array<double, 4>           sizes;
    };

    /// At least one cell; points in the coordinates of the file that the mesh
    /// is made of, before Rotate and Translate.
    explicit SizeField(std::vector<Cell> cells);

    /// Outside of all cells that of the nearest point of a cell that is near.
    double
    operator()(const dealii::Point<3> &x) const;

    /// As given.
    const std::vector<Cell> &
    all() const
    {
      return cells;
    }

    /// Which cell has @p x, or one that is near.
    unsigned int
    cell_at(const dealii::Point<3> &x) const;

  private:
    using Box = dealii::BoundingBox<3>;

    std::array<double, 4>
    barycentric(unsigned int cell, const dealii::Point<3> &x) const
    {
      const dealii::Tensor<1, 3> y =
        inverses[cell] * (x - cells[cell].vertices[0]);
      return {{1. - y[0] - y[1] - y[2], y[0], y[1], y[2]}};
    }

    std::vector<Cell>                 cells;
    std::vector<dealii::Tensor<2, 3>> inverses; ///< of edges at vertex 0
    dealii::RTree<std::pair<Box, unsigned int>> boxes;
  };
} // namespace mortise
