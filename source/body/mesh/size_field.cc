#include <boost/iterator/function_output_iterator.hpp>

#include <mortise/body/mesh/size_field.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  SizeField::SizeField(std::vector<Cell> given)
    : cells(std::move(given))
  {
    std::vector<std::pair<Box, unsigned int>> found;
    for (const Cell &cell : cells)
      {
        Tensor<2, 3> edges;
        Point<3>     lower = cell.vertices[0], upper = lower;
        for (unsigned int v = 1; v < 4; ++v)
          for (unsigned int d = 0; d < 3; ++d)
            {
              edges[d][v - 1] = cell.vertices[v][d] - cell.vertices[0][d];
              lower[d]        = std::min(lower[d], cell.vertices[v][d]);
              upper[d]        = std::max(upper[d], cell.vertices[v][d]);
            }
        inverses.push_back(invert(edges));
        found.emplace_back(Box({lower, upper}), found.size());
      }
    boxes = pack_rtree(found);
  }

  unsigned int
  SizeField::cell_at(const Point<3> &x) const
  {
    namespace index               = boost::geometry::index;
    constexpr unsigned int n_near = 32;
    unsigned int           best   = 0;
    double                 inside = -1e300;
    const auto             take   = boost::make_function_output_iterator(
      [&](const std::pair<Box, unsigned int> &entry) {
        const auto   lambda = barycentric(entry.second, x);
        const double least = *std::min_element(lambda.begin(), lambda.end());
        if (least > inside)
          {
            inside = least;
            best   = entry.second;
          }
      });
    boxes.query(index::intersects(x), take);
    if (inside < 0.)
      boxes.query(index::nearest(x, n_near), take);
    return best;
  }

  double
  SizeField::operator()(const Point<3> &x) const
  {
    const unsigned int cell   = cell_at(x);
    const auto         lambda = barycentric(cell, x);
    double             sum = 0., size = 0.;
    for (unsigned int v = 0; v < 4; ++v)
      {
        const double weight = std::max(0., lambda[v]);
        sum += weight;
        size += weight * cells[cell].sizes[v];
      }
    return size / sum;
  }
} // namespace mortise
