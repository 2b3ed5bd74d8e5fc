#include <mortise/operators/nodal_pressure.h>

namespace mortise
{
  using namespace dealii;

  NodalPressure::NodalPressure(std::unique_ptr<NodalSpace> nodes,
                               const MPI_Comm              comm)
    : space(std::move(nodes))
    , layout(std::make_shared<const Utilities::MPI::Partitioner>(
        space->owned_nodes(),
        space->relevant_nodes(),
        comm))
  {
    for (const auto &line : space->hanging_nodes().get_lines())
      {
        hanging.push_back({layout->global_to_local(line.index), {}});
        for (const auto &[node, weight] : line.entries)
          hanging.back().entries.emplace_back(layout->global_to_local(node),
                                              weight);
      }
  }

  void
  NodalPressure::complete(const LevelVector<double> &v) const
  {
    v.update_ghost_values();
    // these places hold no values of v's own, as those of ghosts
    double *values = const_cast<double *>(v.begin());
    for (const HangingNode &node : hanging)
      {
        double sum = 0.;
        for (const auto &[place, weight] : node.entries)
          sum += weight * values[place];
        values[node.place] = sum;
      }
  }

  void
  NodalPressure::release(const LevelVector<double> &v) const
  {
    for (const HangingNode &node : hanging)
      const_cast<double *>(v.begin())[node.place] = 0.;
    v.zero_out_ghost_values();
  }

  void
  NodalPressure::gather(LevelVector<double> &v) const
  {
    double *values = v.begin();
    for (const HangingNode &node : hanging)
      {
        for (const auto &[place, weight] : node.entries)
          values[place] += weight * values[node.place];
        values[node.place] = 0.;
      }
    v.compress(VectorOperation::add);
  }

  void
  NodalPressure::gather_diagonal(LevelVector<double> &v) const
  {
    double *values = v.begin();
    for (const HangingNode &node : hanging)
      {
        for (const auto &[place, weight] : node.entries)
          values[place] += weight * weight * values[node.place];
        values[node.place] = 0.;
      }
    v.compress(VectorOperation::add);
    for (const HangingNode &node : hanging)
      if (node.place < v.locally_owned_size())
        v.local_element(node.place) = 1.;
  }
} // namespace mortise
