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
  NodalPressure::gather_diagonal(LevelVector<double> &v) const
  {
    hanging.collect_diagonal(v.begin());
    v.compress(VectorOperation::add);
    for (const auto &line : space->hanging_nodes().get_lines())
      if (layout->in_local_range(line.index))
        v.local_element(layout->global_to_local(line.index)) = 1.;
  }
} // namespace mortise
