// Where the multipliers of contact are, which tells discretisations of the same
// surfaces what another one has found.
#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <memory>
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
    /// Both by owned multiplier. Collective.
    ActivePlaces(const MultiplierPlaces  &places,
                 const std::vector<bool> &active,
                 MPI_Comm                 comm);

    /// By owned multiplier of another discretisation: is the nearest one on its
    /// surface active? True for those that are not of contact, and on surfaces
    /// that had none.
    std::vector<bool>
    nearest(const MultiplierPlaces &places) const;

  private:
    struct Trees;
    std::shared_ptr<const Trees> trees;
  };
} // namespace mortise
