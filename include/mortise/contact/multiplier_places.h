// Where the multipliers of contact are, which tells discretisations of the same
// surfaces what another one has found.
#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace mortise
{
  /// By owned multiplier.
  struct MultiplierPlaces
  {
    std::vector<dealii::Point<3>> points;
    /// A number from 1 on for the surface of each; 0: not of contact.
    std::vector<unsigned int> surfaces;
  };

  /// Which multipliers are active, of all ranks, by place.
  class ActivePlaces
  {
  public:
    /// None of any surface.
    ActivePlaces() = default;

    /// Both by owned multiplier. Collective.
    ActivePlaces(const MultiplierPlaces  &places,
                 const std::vector<bool> &active,
                 MPI_Comm                 comm);

    /// By owned multiplier of another discretisation: is the nearest one on its
    /// surface active? True for those that are not of contact, and on surfaces
    /// that had none.
    std::vector<bool>
    nearest(const MultiplierPlaces &places) const;

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
    using Place = std::array<double, 3>;
    /// By surface: those that are not active, and those that are.
    std::vector<std::array<std::vector<Place>, 2>> by_surface;
  };
} // namespace mortise
