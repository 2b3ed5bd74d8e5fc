// The pressures of a matrix-free system: where they stand in vectors, and those
// at hanging nodes.
#pragma once

#include <mortise/operators/levels/nodal_level.h>
#include <mortise/operators/matrix_free/hanging_nodes.h>

#include <memory>

namespace mortise
{
  class NodalPressure
  {
  public:
    /// Collective.
    NodalPressure(std::shared_ptr<const NodalSpace> space, MPI_Comm comm);

    PressureNodes
    nodes() const
    {
      return {*space, *layout};
    }

    void
    initialize(LevelVector<double> &v) const
    {
      v.reinit(layout);
    }

    /// Ghost values and those at hanging nodes of the function that @p v holds.
    /// Collective.
    void
    complete(const LevelVector<double> &v) const
    {
      v.update_ghost_values();
      // these indices hold no values of v's own, as those of ghosts
      hanging.fill(const_cast<double *>(v.begin()));
    }

    /// Undoes complete().
    void
    release(const LevelVector<double> &v) const
    {
      hanging.clear(const_cast<double *>(v.begin()));
      v.zero_out_ghost_values();
    }

    /// What local products left in @p v brought to the nodes that do not hang
    /// and to their owners. Collective.
    void
    gather(LevelVector<double> &v) const
    {
      hanging.collect(v.begin());
      v.compress(dealii::VectorOperation::add);
    }

    /// The same for a diagonal, without what couples hanging nodes; 1 at these.
    void
    gather_diagonal(LevelVector<double> &v) const;

  private:
    std::shared_ptr<const NodalSpace>                          space;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    HangingNodes<double, 1>                                    hanging;
  };
} // namespace mortise
