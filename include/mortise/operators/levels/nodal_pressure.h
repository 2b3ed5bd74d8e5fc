// The pressures of the matrix-free operator: layout of vectors and hanging
// nodes.
#pragma once

#include <mortise/operators/levels/multigrid_level.h>
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

    /// Set the values of @p v at ghosts and hanging nodes. Collective.
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

    /// Add the results of local products in @p v at ghosts and hanging nodes to
    /// owned nodes. Collective.
    void
    gather(LevelVector<double> &v) const
    {
      hanging.collect(v.begin());
      v.compress(dealii::VectorOperation::add);
    }

    /// The same for a diagonal without the coupling of hanging nodes; 1 at
    /// these.
    void
    gather_diagonal(LevelVector<double> &v) const;

  private:
    std::shared_ptr<const NodalSpace>                          space;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    HangingNodes<double, 1>                                    hanging;
  };
} // namespace mortise
