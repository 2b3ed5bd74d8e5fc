// Loads and other functionals of the fields, by node: members of BulkSystem.
#include <deal.II/base/mpi.h>

#include <mortise/operators/bulk_system.h>
#include <mortise/operators/cells/cell_order.h>
#include <mortise/operators/scene_load.h>

#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Adds what functionals have on cells to nodes.
    class FunctionalByNode
    {
    public:
      FunctionalByNode(const NodalSpace                  &space,
                       const Utilities::MPI::Partitioner &layout,
                       Vector                            &sum)
        : space(space)
        , layout(layout)
        , sum(sum)
      {}

      /// @p local: by dof of a displacement on @p cell of @p body.
      void
      add_displacement(const Body                   &body,
                       const Body::CellIterator     &cell,
                       const dealii::Vector<double> &local)
      {
        CellOrder &order = order_of(body, cell);
        space.get_nodes(body.index, cell, nodes);
        for (unsigned int c = 0; c < dim; ++c)
          {
            for (unsigned int i = 0; i < order.values.size(); ++i)
              order.values[i] = local(order.modes[c][i]);
            order.transform_functional_to_nodes();
            for (unsigned int i = 0; i < order.values.size(); ++i)
              sum.local_element(layout.global_to_local(
                dim * nodes[order.scalar[i]] + c)) += order.values[i];
          }
      }

      /// @p local: by dof of the pressure on @p cell, one of the displacement.
      void
      add_pressure(const Body                   &body,
                   const Body::CellIterator     &cell,
                   const dealii::Vector<double> &local)
      {
        CellOrder &order = order_of(body, body.pressure->cell(cell));
        space.get_nodes(body.index, cell, nodes);
        for (unsigned int i = 0; i < order.values.size(); ++i)
          order.values[i] = local(order.scalar[i]);
        order.transform_functional_to_nodes();
        for (unsigned int i = 0; i < order.values.size(); ++i)
          sum.local_element(layout.global_to_local(nodes[order.scalar[i]])) +=
            order.values[i];
      }

    private:
      CellOrder &
      order_of(const Body &body, const Body::CellIterator &cell)
      {
        return orders
          .try_emplace({body.index, cell->active_fe_index()}, cell->get_fe())
          .first->second;
      }

      const NodalSpace                  &space;
      const Utilities::MPI::Partitioner &layout;
      Vector                            &sum;
      std::vector<NodalSpace::Index>     nodes;
      std::map<std::pair<unsigned int, unsigned int>, CellOrder>
        orders; ///< by body and element
    };
  } // namespace

  Vector
  BulkSystem::external_forces(const std::vector<Loads> &loads) const
  {
    const MultigridLevel &level = all_levels.front();
    Vector                sum;
    stiffness->initialize(sum);
    FunctionalByNode by_node(*level.space, *level.layout, sum);
    for (const Body *body : level.space->bodies())
      for_each_loaded_cell(*body,
                           loads[body->index],
                           [&](const auto &cell, const auto &local) {
                             by_node.add_displacement(*body, cell, local);
                           });
    stiffness->gather(sum);
    return sum;
  }

  Vector
  BulkSystem::by_node(const Body            &body,
                      const CellFunctionals &functionals) const
  {
    const MultigridLevel &level = all_levels.front();
    Vector                sum;
    stiffness->initialize(sum);
    FunctionalByNode nodes(*level.space, *level.layout, sum);
    for (const CellFunctional &on_cell : functionals)
      nodes.add_displacement(body, on_cell.cell, on_cell.displacement);
    stiffness->gather(sum);
    return sum;
  }

  void
  BulkSystem::add_loads(const std::vector<Loads> &loads, SceneLoad &load) const
  {
    load.external = external_forces(loads);
    Vector sum    = load.external;
    stiffness->clear_constrained(sum);
    load.rhs.displacement += sum;
    if (pressures)
      add_expansion(loads, load.rhs.pressure);
  }

  void
  BulkSystem::add_expansion(const std::vector<Loads> &loads,
                            Vector                   &pressure_load) const
  {
    Vector sum;
    pressures->initialize(sum);
    const auto       nodes = pressures->nodes();
    FunctionalByNode by_node(nodes.space, nodes.layout, sum);
    for (const Body *body : all_levels.front().space->bodies())
      if (body->pressure && loads[body->index].thermal_strain)
        for_each_expanding_cell(*body,
                                loads[body->index].thermal_strain,
                                [&](const auto &cell, const auto &local) {
                                  by_node.add_pressure(*body, cell, local);
                                });
    pressures->gather(sum);
    pressure_load += sum;
  }

  void
  BulkSystem::assemble_functional(const Body            &body,
                                  const CellFunctionals &functionals,
                                  SystemVector          &rhs) const
  {
    rhs.displacement = by_node(body, functionals);
    stiffness->clear_constrained(rhs.displacement);
    if (!pressures)
      return;
    rhs.pressure                    = 0.;
    const auto       pressure_nodes = pressures->nodes();
    FunctionalByNode by_pressure_node(pressure_nodes.space,
                                      pressure_nodes.layout,
                                      rhs.pressure);
    for (const CellFunctional &on_cell : functionals)
      if (on_cell.pressure.size() > 0)
        by_pressure_node.add_pressure(body, on_cell.cell, on_cell.pressure);
    pressures->gather(rhs.pressure);
  }
} // namespace mortise
