#include <mortise/operators/levels/nodal_pressure.h>

namespace mortise
{
  using namespace dealii;

  NodalPressure::NodalPressure(std::shared_ptr<const NodalSpace> nodes,
                               const MPI_Comm                    comm)
    : space(std::move(nodes))
    , layout(std::make_shared<const Utilities::MPI::Partitioner>(
        space->owned_nodes(),
        space->relevant_nodes(),
        comm))
    , hanging(*space, *layout)
  {}

  void
  NodalPressure::complete(const LevelVector<double> &v) const
  {
    v.update_ghost_values();
    // these indices hold no values of v's own, as those of ghosts
    hanging.fill(const_cast<double *>(v.begin()));
  }

  void
  NodalPressure::release(const LevelVector<double> &v) const
  {
    hanging.clear(const_cast<double *>(v.begin()));
    v.zero_out_ghost_values();
  }

  void
  NodalPressure::gather(LevelVector<double> &v) const
  {
    hanging.collect(v.begin());
    v.compress(VectorOperation::add);
  }

  void
  NodalPressure::gather_diagonal(LevelVector<double> &v) const
  {
    hanging.collect_diagonal(v.begin());
    v.compress(VectorOperation::add);
    for (const auto &line : space->hanging_nodes().get_lines())
      if (layout->in_local_range(line.index))
        v.local_element(layout->global_to_local(line.index)) = 1.;
  }
} // namespace mortise
