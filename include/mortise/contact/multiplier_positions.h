// Positions of the multipliers of contact, by which an active set passes from
// one discretisation to another.
#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace mortise
{
  /// By owned multiplier.
  struct MultiplierPositions
  {
    std::vector<dealii::Point<3>> points;
    /// Number of the surface of each, from 1 on; 0: not of contact.
    std::vector<unsigned int> surfaces;
  };

  /// An active set of all ranks as a set of points.
  class ActivePositions
  {
  public:
    /// Without surfaces.
    ActivePositions() = default;

    /// Both by owned multiplier. Collective.
    ActivePositions(const MultiplierPositions &positions,
                    const std::vector<bool>   &active,
                    MPI_Comm                   comm);

    /// By owned multiplier of another discretisation: is the nearest multiplier
    /// on its surface active? True for multipliers that are not of contact, and
    /// on surfaces that are not known.
    std::vector<bool>
    nearest(const MultiplierPositions &positions) const;

    /// Are all coordinates numbers?
    bool
    is_finite() const;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &by_surface;
    }

  private:
    using Position = std::array<double, 3>;
    /// By surface: inactive, then active points.
    std::vector<std::array<std::vector<Position>, 2>> by_surface;
  };
} // namespace mortise
