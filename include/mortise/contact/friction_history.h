// What friction keeps from one load step to the next, by the positions of the
// nodes of contact, so that it does not depend on how these are numbered.
#pragma once

#include <mortise/contact/friction.h>
#include <mortise/contact/multiplier_positions.h>

#include <array>
#include <utility>
#include <vector>

namespace mortise
{
  /// Of a node.
  struct FrictionRecord
  {
    bool                  closed = false; ///< at the end of the last step
    bool                  slips  = false; ///< likewise
    std::array<double, 3> slip{}; ///< sum of those of all steps, a length
    double                dissipated = 0.; ///< energy

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &closed &slips &slip &dissipated;
    }
  };

  /// Records of the nodes of all ranks.
  class FrictionHistory
  {
  public:
    /// Without nodes.
    FrictionHistory() = default;

    /// @p records: by owned node. Collective.
    FrictionHistory(const MultiplierPositions         &positions,
                    const std::vector<FrictionRecord> &records,
                    MPI_Comm                           comm);

    /// By owned node: the record of the nearest node on its surface; of an open
    /// one on surfaces that are not known.
    std::vector<FrictionRecord>
    nearest(const MultiplierPositions &positions) const;

    /// Are all numbers finite?
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
    std::vector<std::vector<std::pair<Position, FrictionRecord>>> by_surface;
  };
} // namespace mortise
