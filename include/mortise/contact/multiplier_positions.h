// Positions of the nodes of contact, by which an active set passes from
// one discretisation to another.
#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace mortise
{
  /// By owned node of contact.
  struct MultiplierPositions
  {
    std::vector<dealii::Point<3>> points;
    /// Number of the surface of each, from 1 on.
    std::vector<unsigned int> surfaces;
  };

  /// An active set of all ranks as a set of points.
  class ActivePositions
  {
  public:
    /// Without surfaces.
    ActivePositions() = default;

    /// Both by owned node. Collective.
    ActivePositions(const MultiplierPositions &positions,
                    const std::vector<bool>   &active,
                    MPI_Comm                   comm);

    /// By owned node of another discretisation: is the nearest node on its
    /// surface active? True on surfaces that are not known.
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
