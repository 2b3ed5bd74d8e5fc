// Pressures as coefficients of the bodies, to and from values at nodes:
// members of BulkSystem.
#include <mortise/operators/bulk_system.h>
#include <mortise/operators/cells/cell_order.h>

#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// For the pressures of the owned cells of all bodies: what
    /// read(body, dof, node) returns, by @p transform, to
    /// write(body, dof, node, value).
    template <typename Read, typename Write>
    void
    transform_pressures(const NodalSpace &space,
                        void (CellOrder::*transform)(),
                        const Read  &read,
                        const Write &write)
    {
      std::map<std::pair<unsigned int, unsigned int>, CellOrder>
                                           orders; // by body and element
      std::vector<types::global_dof_index> dofs;
      space.for_each_cell(
        [&](const Body &body, const auto &cell, const auto &nodes) {
          const auto own = body.pressure->cell(cell);
          CellOrder &order =
            orders
              .try_emplace({body.index, own->active_fe_index()}, own->get_fe())
              .first->second;
          dofs.resize(order.scalar.size());
          own->get_dof_indices(dofs);
          for (unsigned int k = 0; k < order.scalar.size(); ++k)
            order.values[k] =
              read(body, dofs[order.scalar[k]], nodes[order.scalar[k]]);
          (order.*transform)();
          for (unsigned int k = 0; k < order.scalar.size(); ++k)
            write(body,
                  dofs[order.scalar[k]],
                  nodes[order.scalar[k]],
                  order.values[k]);
        });
    }
  } // namespace

  void
  BulkSystem::set_pressure(const Coefficients &coefficient,
                           Vector             &pressure) const
  {
    pressure         = 0.;
    const auto nodes = pressures->nodes();
    transform_pressures(
      nodes.space,
      &CellOrder::transform_to_nodes,
      [&](const Body &body, const auto dof, const auto) {
        return coefficient(body.index, dof);
      },
      [&](const Body &, const auto, const auto node, const double value) {
        if (nodes.layout.in_local_range(node) &&
            !nodes.space.hanging_nodes().is_constrained(node))
          pressure.local_element(nodes.layout.global_to_local(node)) = value;
      });
  }

  void
  BulkSystem::for_each_pressure_coefficient(
    const Vector &pressure,
    const std::function<
      void(unsigned int body, types::global_dof_index dof, double value)> &set)
    const
  {
    pressures->complete(pressure);
    const auto nodes = pressures->nodes();
    transform_pressures(
      nodes.space,
      &CellOrder::transform_to_modes,
      [&](const Body &, const auto, const auto node) {
        return pressure.local_element(nodes.layout.global_to_local(node));
      },
      [&](const Body &body, const auto dof, const auto, const double value) {
        set(body.index, dof, value);
      });
    pressures->release(pressure);
  }
} // namespace mortise
