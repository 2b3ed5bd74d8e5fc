// Proves that sizes of edges are linear on cells, go on outside as on the
// nearest face, and are found in a mesh with many cells.
#include <mortise/body/mesh/size_field.h>

#include <cmath>

#include "../verdict.h"

using namespace dealii;
using mortise::SizeField;

namespace
{
  double
  linear(const Point<3> &x)
  {
    return 1. + 0.5 * x[0] + 0.25 * x[1] + 0.125 * x[2];
  }

  /// The unit cube as n^3 cubes of six tetrahedra each around its diagonals.
  std::vector<SizeField::Cell>
  cube(const unsigned int n)
  {
    constexpr unsigned int axes[6][3] = {
      {0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
    std::vector<SizeField::Cell> cells;
    for (unsigned int i = 0; i < n * n * n; ++i)
      for (const auto &order : axes)
        {
          SizeField::Cell cell;
          Point<3>        x(i % n, i / n % n, i / n / n);
          for (unsigned int v = 0; v < 4; ++v)
            {
              cell.vertices[v] = Point<3>(x / double(n));
              cell.sizes[v]    = linear(cell.vertices[v]);
              if (v < 3)
                x[order[v]] += 1.;
            }
          cells.push_back(cell);
        }
    return cells;
  }
} // namespace

int
main()
{
  const unsigned int n     = 6;
  const auto         cells = cube(n);
  const SizeField    field(cells);
  double             off     = 0.;
  unsigned int       n_wrong = 0;
  for (unsigned int i = 0; i < 1000; ++i)
    {
      const Point<3> x(std::fmod(0.37 * i + 0.011, 1.),
                       std::fmod(0.619 * i + 0.023, 1.),
                       std::fmod(0.781 * i + 0.007, 1.));
      off               = std::max(off, std::fabs(field(x) - linear(x)));
      const auto &found = cells[field.cell_at(x)].vertices;
      for (unsigned int d = 0; d < 3; ++d)
        n_wrong += x[d] < found[0][d] - 1e-12 || x[d] > found[3][d] + 1e-12;
    }
  verdict("linear inside", off, 1e-14);
  verdict("cells that do not have the point", n_wrong, 0.);
  verdict("outside of a corner",
          std::fabs(field(Point<3>(1.1, 1.2, 1.1)) - linear(Point<3>(1, 1, 1))),
          0.03);
  verdict("beside a face",
          std::fabs(field(Point<3>(0.4, 0.3, -0.01)) -
                    linear(Point<3>(0.4, 0.3, 0.))),
          0.01);
}
