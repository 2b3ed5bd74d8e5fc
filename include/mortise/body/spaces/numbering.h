// One numbering of one field (displacements, pressures) of all bodies: rank by
// rank, and within a rank body by body, so that each rank owns one contiguous
// range. It never renumbers a DoFHandler.
#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/base/types.h>

#include <deal.II/dofs/dof_handler.h>

#include <vector>

namespace mortise
{
  class FieldNumbering
  {
  public:
    using Index = dealii::types::global_dof_index;

    FieldNumbering() = default;

    /// By body; null for a body without the field. Collective. The handlers'
    /// dofs must be distributed (contiguous per rank).
    FieldNumbering(const std::vector<const dealii::DoFHandler<3> *> &handlers,
                   MPI_Comm                                          comm);

    /// Index in the numbering of the scene of dof @p dof of body @p body; any rank's dof.
    Index
    operator()(const unsigned int body, const Index dof) const
    {
      const unsigned int rank = owner(body, dof);
      return system_start[rank * n_bodies + body] +
             (dof - body_start[body][rank]);
    }

    /// Owned range of this rank, over all bodies.
    const dealii::IndexSet &
    owned() const
    {
      return owned_set;
    }

    Index
    size() const
    {
      return owned_set.size();
    }

    /// @p body_set, indices of body @p body, in the numbering of the scene, added to @p scene_set.
    void
    add_to(const unsigned int      body,
           const dealii::IndexSet &body_set,
           dealii::IndexSet       &scene_set) const;

  private:
    unsigned int
    owner(const unsigned int body, const Index dof) const;

    unsigned int n_bodies = 0;
    std::vector<std::vector<Index>>
      body_start; ///< [body][rank], one past the last rank included
    std::vector<Index> system_start; ///< [rank * n_bodies + body]
    dealii::IndexSet   owned_set;
  };
} // namespace mortise
