// The solved contact of a load step by the positions of its nodes, so that it
// passes to another numbering or another discretisation.
#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <mortise/contact/node_positions.h>

#include <array>
#include <utility>
#include <vector>

namespace mortise
{
  /// Of a node; vectors in space. Without friction nothing is more than closed.
  struct ContactRecord
  {
    bool                 closed = false;
    bool                 slips  = false;
    dealii::Tensor<1, 3> traction;        ///< on the master, force per area
    dealii::Tensor<1, 3> increment;       ///< slip of the step, a length
    dealii::Tensor<1, 3> slip;            ///< sum of those of all steps
    double               dissipated = 0.; ///< energy of all steps

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &closed &slips &dissipated;
      for (unsigned int c = 0; c < 3; ++c)
        archive &traction[c] & increment[c] & slip[c];
    }
  };

  /// Records of the nodes of all ranks.
  class ContactRecords
  {
  public:
    /// Without surfaces.
    ContactRecords() = default;

    /// Both by owned node. @p dissipated_apart: by surface, see dissipated().
    /// Collective.
    ContactRecords(const NodePositions              &positions,
                   const std::vector<ContactRecord> &records,
                   std::vector<double>               dissipated_apart,
                   MPI_Comm                          comm);

    /// By surface, energy that nodes have dissipated, and those that had been
    /// in contact before and are none any more.
    std::vector<double>
    dissipated() const;

    /// By owned node of another discretisation: the record of the nearest node
    /// on its surface, of a closed one where two are equally near. On surfaces
    /// that are not known nodes are closed.
    std::vector<ContactRecord>
    nearest(const NodePositions &positions) const;

    /// Are all numbers finite?
    bool
    is_finite() const;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &by_surface &dissipated_apart;
    }

  private:
    using Position = std::array<double, 3>;
    std::vector<std::vector<std::pair<Position, ContactRecord>>> by_surface;
    std::vector<double> dissipated_apart;
  };
} // namespace mortise
