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
    /// Calls @p visit(body, degree, dofs, nodes) for the pressures of the owned cells of all
    /// bodies, both in the order of the element of nodes.
    template <typename Visit>
    void
    for_each_pressure_cell(const NodalSpace &space, const Visit &visit)
    {
      std::vector<types::global_dof_index> dofs, ordered_dofs;
      std::vector<NodalSpace::Index>       ordered_nodes;
      space.for_each_cell(
        [&](const Body &body, const auto &cell, const auto &nodes) {
          const auto         own    = body.pressure->cell(cell);
          const unsigned int degree = own->get_fe().degree;
          const auto         order  = cell_dof_indices(degree);
          dofs.resize(order.size());
          own->get_dof_indices(dofs);
          ordered_dofs.clear();
          ordered_nodes.clear();
          for (const unsigned int i : order)
            {
              ordered_dofs.push_back(dofs[i]);
              ordered_nodes.push_back(nodes[i]);
            }
          visit(body, degree, ordered_dofs, ordered_nodes);
        });
    }
  } // namespace

  void
  NodalSystem::set_pressure(const Coefficients &coefficient,
                            Vector             &pressure) const
  {
    p_in                      = 0.;
    const auto          nodes = pressures->nodes();
    std::vector<double> values;
    for_each_pressure_cell(
      nodes.space,
      [&](const Body        &body,
          const unsigned int degree,
          const auto        &dofs,
          const auto        &of_cell) {
        values.clear();
        for (const auto dof : dofs)
          values.push_back(coefficient(body.index, dof));
        transform_along_lines(modes_to_nodes(degree), values);
        for (unsigned int i = 0; i < values.size(); ++i)
          if (nodes.layout.in_local_range(of_cell[i]) &&
              !nodes.space.hanging_nodes().is_constrained(of_cell[i]))
            p_in.local_element(nodes.layout.global_to_local(of_cell[i])) =
              values[i];
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
    const auto          nodes = pressures->nodes();
    std::vector<double> values;
    for_each_pressure_cell(
      nodes.space,
      [&](const Body        &body,
          const unsigned int degree,
          const auto        &dofs,
          const auto        &of_cell) {
        values.clear();
        for (const auto node : of_cell)
          values.push_back(
            p_in.local_element(nodes.layout.global_to_local(node)));
        transform_along_lines(nodes_to_modes(degree), values);
        for (unsigned int i = 0; i < values.size(); ++i)
          set(body.index, dofs[i], values[i]);
      });
    pressures->release(p_in);
  }
} // namespace mortise
