// Pressures as coefficients of the bodies, to and from values at nodes:
// members of NodalSystem.
#include <mortise/operators/cells/cell_order.h>
#include <mortise/operators/nodal_system.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// For the pressures of the owned cells of all bodies: what
    /// read(body, dof, node) returns, times @p matrix(degree) along each line,
    /// to write(body, dof, node, value).
    template <typename Matrix, typename Read, typename Write>
    void
    transform_pressures(const NodalSpace &space,
                        const Matrix     &matrix,
                        const Read       &read,
                        const Write      &write)
    {
      std::vector<types::global_dof_index> dofs;
      std::vector<double>                  values;
      space.for_each_cell(
        [&](const Body &body, const auto &cell, const auto &nodes) {
          const auto         own    = body.pressure->cell(cell);
          const unsigned int degree = own->get_fe().degree;
          const auto         order  = cell_dof_indices(degree);
          dofs.resize(order.size());
          own->get_dof_indices(dofs);
          values.clear();
          for (const unsigned int i : order)
            values.push_back(read(body, dofs[i], nodes[i]));
          transform_along_lines(matrix(degree), values);
          for (unsigned int k = 0; k < order.size(); ++k)
            write(body, dofs[order[k]], nodes[order[k]], values[k]);
        });
    }
  } // namespace

  void
  NodalSystem::set_pressure(const Coefficients &coefficient,
                            Vector             &pressure) const
  {
    p_in             = 0.;
    const auto nodes = pressures->nodes();
    transform_pressures(
      nodes.space,
      modes_to_nodes,
      [&](const Body &body, const auto dof, const auto) {
        return coefficient(body.index, dof);
      },
      [&](const Body &, const auto, const auto node, const double value) {
        if (nodes.layout.in_local_range(node) &&
            !nodes.space.hanging_nodes().is_constrained(node))
          p_in.local_element(nodes.layout.global_to_local(node)) = value;
      });
    std::copy_n(p_in.begin(), p_in.locally_owned_size(), pressure.begin());
  }

  void
  NodalSystem::for_each_pressure_coefficient(
    const Vector &pressure,
    const std::function<
      void(unsigned int body, types::global_dof_index dof, double value)> &set)
    const
  {
    std::copy_n(pressure.begin(), p_in.locally_owned_size(), p_in.begin());
    pressures->complete(p_in);
    const auto nodes = pressures->nodes();
    transform_pressures(
      nodes.space,
      nodes_to_modes,
      [&](const Body &, const auto, const auto node) {
        return p_in.local_element(nodes.layout.global_to_local(node));
      },
      [&](const Body &body, const auto dof, const auto, const double value) {
        set(body.index, dof, value);
      });
    pressures->release(p_in);
  }
} // namespace mortise
