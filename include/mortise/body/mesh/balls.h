// Balls in a parameter file, "x, y, z, radius, number; ...": the cells that one
// touches get what the number says.
#pragma once

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace mortise
{
  struct Ball
  {
    dealii::Point<3> centre;
    double           radius;
    unsigned int     number;

    /// Is the centre of @p cell, or a vertex, in the ball?
    template <typename Cell>
    bool
    touches(const Cell &cell) const
    {
      bool result = cell->center().distance(centre) <= radius;
      for (const unsigned int v : cell->vertex_indices())
        result = result || cell->vertex(v).distance(centre) <= radius;
      return result;
    }
  };

  /// @p text with entries between ';', whose numbers, from 1 to @p most, are called @p number. Throws InputError for
  /// anything else, whose message begins with @p where, as in "Body inner, Mesh: Refine near".
  std::vector<Ball>
  parse_balls(const std::string &text,
              const std::string &where,
              const std::string &number,
              unsigned int       most);

  /// Throws InputError: no cell is touched. @p where: as above.
  [[noreturn]] void
  fail_untouched(const Ball &ball, const std::string &where);
} // namespace mortise
