#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/spaces/thickness_coarsening.h>
#include <mortise/operators/block_system.h>
#include <mortise/operators/bulk_system.h>
#include <mortise/operators/cells/cell_order.h>
#include <mortise/operators/follower_pressures.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Let @p add add to @p dst what it makes of @p p with ghost entries.
    template <typename Add>
    void
    apply_to_pressures(const NodalPressure &pressures,
                       Vector              &dst,
                       const Vector        &p,
                       const Add           &add)
    {
      pressures.complete(p);
      dst = 0.;
      add();
      pressures.release(p);
      pressures.gather(dst);
    }

    /// By element of the body.
    std::vector<CellOrder>
    cell_orders(const Body &body)
    {
      std::vector<CellOrder> orders;
      for (unsigned int i = 0; i < body.fe.size(); ++i)
        orders.emplace_back(body.fe[i]);
      return orders;
    }

    /// Calls @p visit(body, order, dofs, nodes) for the owned cells of all
    /// bodies.
    template <typename Visit>
    void
    for_each_ordered_cell(const NodalSpace &space, const Visit &visit)
    {
      std::vector<std::vector<CellOrder>> orders; // by body
      for (const Body *body : space.bodies())
        orders.push_back(cell_orders(*body));
      std::vector<types::global_dof_index> dofs;
      space.for_each_cell(
        [&](const Body &body, const auto &cell, const auto &nodes) {
          dofs.resize(cell->get_fe().n_dofs_per_cell());
          cell->get_dof_indices(dofs);
          visit(body, orders[body.index][cell->active_fe_index()], dofs, nodes);
        });
    }
  } // namespace

  BulkSystem::BulkSystem(const NodalSpaces                &spaces,
                         std::shared_ptr<const NodalSpace> pressure_space,
                         const Scene                      &scene,
                         const MPI_Comm                    comm)
    : preconditioned(scene.preconditioned)
    , nonlinear(scene.nonlinear)
  {
    std::unique_ptr<PressureNodes> nodes;
    if (pressure_space)
      {
        pressures =
          std::make_unique<NodalPressure>(std::move(pressure_space), comm);
        nodes = std::make_unique<PressureNodes>(pressures->nodes());
      }
    for (const auto &space : spaces)
      all_levels.push_back(
        make_multigrid_level(space, scene.numbering, scene.constraints, comm));
    stiffness = std::make_unique<LevelOperator<double>>(all_levels.front(),
                                                        false,
                                                        nodes.get());
    if (is_nonlinear())
      linearise_undeformed();
    stiffness->diagonal(stiffness_diagonal);
    if (!pressures)
      return;
    pressures->initialize(norm_diagonal);
    dirichlet_cell_pressures =
      DirichletCellPressures(all_levels.front(), stiffness->elasticity());
    stiffness->elasticity().add_pressure_norm_diagonal(norm_diagonal.begin());
    dirichlet_cell_pressures.add_diagonal(norm_diagonal.begin());
    pressures->gather_diagonal(norm_diagonal);
  }

  BulkSystem::~BulkSystem() = default;

  void
  BulkSystem::couple(const std::vector<Coupling> &couplings)
  {
    if (!preconditioned || couplings.empty())
      return;
    update_penalties(couplings);
    independent = find_independent_displacements(all_levels.front(),
                                                 node_diagonal(),
                                                 couplings);
  }

  void
  BulkSystem::update_penalties(const std::vector<Coupling> &couplings)
  {
    if (!preconditioned)
      return;
    // the finest level respects the constraint itself; the matrix of vertices
    // is made of the last, unless it sees what multipliers see
    const bool alone =
      all_levels.size() == 1 &&
      !coarsens_across_thickness(all_levels.front().space->bodies());
    for (unsigned int number = 0; number < all_levels.size(); ++number)
      if (number > 0 || alone)
        all_levels[number].penalties =
          make_jump_penalties(all_levels[number], number, couplings);
  }

  void
  BulkSystem::apply_free(Vector       &dst_u,
                         Vector       &dst_p,
                         const Vector &u,
                         const Vector &p) const
  {
    if (!pressures)
      {
        stiffness->vmult_free(dst_u, u);
        add_following_forces_free(dst_u, u);
        return;
      }
    stiffness->complete(u);
    pressures->complete(p);
    dst_u = 0.;
    dst_p = 0.;
    // the first are only read
    stiffness->elasticity().add_mixed_product({const_cast<double *>(u.begin()),
                                               const_cast<double *>(p.begin())},
                                              {dst_u.begin(), dst_p.begin()});
    stiffness->release(u);
    pressures->release(p);
    stiffness->gather(dst_u);
    pressures->gather(dst_p);
    add_following_forces_free(dst_u, u);
  }

  void
  BulkSystem::add_pressure_force(Vector &dst, const Vector &p) const
  {
    pressures->complete(p);
    stiffness->elasticity().add_pressure_force(p.begin(), dst.begin());
    pressures->release(p);
    stiffness->gather(dst);
    stiffness->clear_constrained(dst);
  }

  void
  BulkSystem::apply_pressure_norm(Vector &dst, const Vector &p) const
  {
    apply_to_pressures(*pressures, dst, p, [&] {
      stiffness->elasticity().add_pressure_norm(p.begin(), dst.begin());
      dirichlet_cell_pressures.add_product(p.begin(), dst.begin());
    });
  }

  void
  BulkSystem::apply_pressure_mass(Vector &dst, const Vector &p) const
  {
    apply_to_pressures(*pressures, dst, p, [&] {
      stiffness->elasticity().add_pressure_norm(p.begin(), dst.begin());
    });
  }

  void
  BulkSystem::set_constant_pressure(const Body &given, Vector &p) const
  {
    const auto pressure_nodes = pressures->nodes();
    pressure_nodes.space.for_each_cell(
      [&](const Body &body, const auto &, const auto &nodes) {
        if (body.index == given.index)
          for (const auto node : nodes)
            if (pressure_nodes.layout.in_local_range(node) &&
                !pressure_nodes.space.hanging_nodes().is_constrained(node))
              p.local_element(pressure_nodes.layout.global_to_local(node)) = 1.;
      });
  }

  Vector
  BulkSystem::values_at_nodes(const Coefficients &coefficient) const
  {
    const MultigridLevel &level = all_levels.front();
    Vector                values(level.layout);
    // The value at a node depends on the entity of the node alone, so that all
    // cells agree.
    for_each_ordered_cell(
      *level.space,
      [&](const Body &body,
          CellOrder  &order,
          const auto &dofs,
          const auto &nodes) {
        for (unsigned int c = 0; c < dim; ++c)
          {
            bool present = false;
            for (unsigned int i = 0; i < order.values.size(); ++i)
              {
                order.values[i] =
                  coefficient(body.index, dofs[order.modes[c][i]]);
                present = present || order.values[i] != 0.;
              }
            if (!present)
              continue;
            order.transform_to_nodes();
            for (unsigned int i = 0; i < order.values.size(); ++i)
              if (const auto index = dim * nodes[order.scalar[i]] + c;
                  level.layout->in_local_range(index))
                values.local_element(level.layout->global_to_local(index)) =
                  order.values[i];
          }
      });
    return values;
  }

  void
  BulkSystem::apply_to_constrained(const Vector &u,
                                   SystemVector &rhs,
                                   Vector       *forces) const
  {
    const Vector values(u), zero(rhs.pressure);
    apply_free(rhs.displacement, rhs.pressure, values, zero);
    if (forces != nullptr)
      *forces = rhs.displacement;
    stiffness->clear_constrained(rhs.displacement);
  }

  void
  BulkSystem::for_each_coefficient(
    const Vector                            &displacement,
    const std::function<void(unsigned int                    body,
                             dealii::types::global_dof_index dof,
                             double                          value)> &set) const
  {
    const MultigridLevel &level = all_levels.front();
    stiffness->complete(displacement);
    for_each_ordered_cell(
      *level.space,
      [&](const Body &body,
          CellOrder  &order,
          const auto &dofs,
          const auto &nodes) {
        for (unsigned int c = 0; c < dim; ++c)
          {
            for (unsigned int i = 0; i < order.values.size(); ++i)
              order.values[i] =
                displacement.local_element(level.layout->global_to_local(
                  dim * nodes[order.scalar[i]] + c));
            order.transform_to_modes();
            for (unsigned int i = 0; i < order.values.size(); ++i)
              set(body.index, dofs[order.modes[c][i]], order.values[i]);
          }
      });
    stiffness->release(displacement);
  }
} // namespace mortise
