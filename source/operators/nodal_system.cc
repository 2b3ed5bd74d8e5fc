#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>
#include <mortise/base/tensor_product.h>
#include <mortise/body/fe_legendre.h>
#include <mortise/operators/nodal_system.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// One component on one cell, in the order of cell_dof_indices(), times a
    /// matrix along each direction.
    void
    transform(const FullMatrix<double> &matrix, std::vector<double> &values)
    {
      const unsigned int n = matrix.n();
      values =
        apply_product(matrix, matrix, matrix, {{{n, n, n}}, std::move(values)})
          .values;
    }

    /// What the cells of one body need to go from one basis to the other.
    struct CellOrder
    {
      explicit CellOrder(const Body &body)
        : scalar(cell_dof_indices(body.max_degree()))
        , values(scalar.size())
      {
        const auto &system = body.fe[body.fe.size() - 1];
        for (unsigned int c = 0; c < dim; ++c)
          for (const unsigned int i : scalar)
            modes[c].push_back(system.component_to_system_index(c, i));
      }

      std::vector<unsigned int>                  scalar;
      std::array<std::vector<unsigned int>, dim> modes;
      std::vector<double>                        values;
    };

    /// Calls @p visit(body, order, dofs, nodes) for the owned cells of all
    /// bodies.
    template <typename Visit>
    void
    for_each_ordered_cell(const NodalSpace &space, const Visit &visit)
    {
      std::vector<CellOrder> orders; // by body
      for (const Body *body : space.bodies())
        orders.emplace_back(*body);
      std::vector<types::global_dof_index> dofs;
      space.for_each_cell(
        [&](const Body &body, const auto &cell, const auto &nodes) {
          dofs.resize(cell->get_fe().n_dofs_per_cell());
          cell->get_dof_indices(dofs);
          visit(body, orders[body.index], dofs, nodes);
        });
    }
  } // namespace

  NodalSystem::NodalSystem(NodalSpaces    spaces,
                           const Scene   &scene,
                           const MPI_Comm comm)
  {
    for (unsigned int number = 0; number < spaces.size(); ++number)
      {
        all_levels.push_back(make_nodal_level(std::move(spaces[number]),
                                              number,
                                              scene.numbering,
                                              scene.constraints,
                                              scene.couplings,
                                              comm));
        if (number > 0) // the finest level respects the constraint itself
          all_levels.back().penalty =
            make_nodal_penalty(all_levels.back(), number, scene.couplings);
      }
    stiffness =
      std::make_unique<LevelOperator<double>>(all_levels.front(), false);
    stiffness->initialize(in);
    stiffness->initialize(out);
    stiffness->diagonal(stiffness_diagonal);
  }

  void
  NodalSystem::apply_stiffness(Vector &dst, const Vector &src) const
  {
    std::copy_n(src.begin(), in.locally_owned_size(), in.begin());
    stiffness->clear_held(in);
    stiffness->vmult(out, in);
    std::copy_n(out.begin(), out.locally_owned_size(), dst.begin());
  }

  void
  NodalSystem::assemble_load(const std::vector<Loads> &loads,
                             const Scene              &scene,
                             Vector                   &load) const
  {
    const NodalLevel   &level = all_levels.front();
    LevelVector<double> sum;
    stiffness->initialize(sum);
    std::vector<NodalSpace::Index> nodes;
    for (const Body *body : level.space->bodies())
      {
        CellOrder                order(*body);
        const FullMatrix<double> to_nodes =
          transposed(nodes_to_modes(body->max_degree()));
        for_each_loaded_cell(
          *body, loads[body->index], [&](const auto &cell, const auto &local) {
            level.space->get_nodes(body->index, cell, nodes);
            for (unsigned int c = 0; c < dim; ++c)
              {
                for (unsigned int i = 0; i < order.values.size(); ++i)
                  order.values[i] = local(order.modes[c][i]);
                transform(to_nodes, order.values);
                for (unsigned int i = 0; i < order.values.size(); ++i)
                  sum.local_element(level.layout->global_to_local(
                    dim * nodes[order.scalar[i]] + c)) += order.values[i];
              }
          });
      }
    stiffness->gather(sum);
    subtract_prescribed(scene, sum);
    stiffness->clear_held(sum);
    load.reinit(level.layout->locally_owned_range(),
                level.layout->get_mpi_communicator());
    std::copy_n(sum.begin(), sum.locally_owned_size(), load.begin());
  }

  void
  NodalSystem::subtract_prescribed(const Scene         &scene,
                                   LevelVector<double> &load) const
  {
    const NodalLevel &level = all_levels.front();
    bool              any   = false;
    for (const auto &line : scene.constraints.get_lines())
      any = any || line.inhomogeneity != 0.;
    if (Utilities::MPI::max(any ? 1 : 0,
                            level.layout->get_mpi_communicator()) == 0)
      return;
    // The function with these coefficients and zero for all others. What it is
    // at a node follows from the entity that has the node, so all cells agree.
    in = 0.;
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
                order.values[i] = scene.constraints.get_inhomogeneity(
                  scene.numbering(body.index, dofs[order.modes[c][i]]));
                present = present || order.values[i] != 0.;
              }
            if (!present)
              continue;
            transform(modes_to_nodes(body.max_degree()), order.values);
            for (unsigned int i = 0; i < order.values.size(); ++i)
              if (const auto index = dim * nodes[order.scalar[i]] + c;
                  level.layout->in_local_range(index))
                in.local_element(level.layout->global_to_local(index)) =
                  order.values[i];
          }
      });
    stiffness->vmult_free(out, in);
    load -= out;
  }

  void
  NodalSystem::drop_held_columns(SparseMatrix &coupling) const
  {
    const NodalLevel  &level = all_levels.front();
    const unsigned int n     = level.space->hanging_nodes().n_constraints();
    if (Utilities::MPI::max(n, level.layout->get_mpi_communicator()) == 0)
      return;
    auto &matrix = const_cast<Epetra_CrsMatrix &>(coupling.trilinos_matrix());
    Epetra_Vector kept(matrix.DomainMap());
    kept.PutScalar(1.);
    for (const unsigned int place : level.held)
      kept[place] = 0.;
    matrix.RightScale(kept);
  }

  void
  NodalSystem::for_each_coefficient(
    const Vector                            &displacement,
    const std::function<void(unsigned int                    body,
                             dealii::types::global_dof_index dof,
                             double                          value)> &set) const
  {
    const NodalLevel &level = all_levels.front();
    std::copy_n(displacement.begin(), in.locally_owned_size(), in.begin());
    stiffness->complete(in);
    for_each_ordered_cell(
      *level.space,
      [&](const Body &body,
          CellOrder  &order,
          const auto &dofs,
          const auto &nodes) {
        for (unsigned int c = 0; c < dim; ++c)
          {
            for (unsigned int i = 0; i < order.values.size(); ++i)
              order.values[i] = in.local_element(level.layout->global_to_local(
                dim * nodes[order.scalar[i]] + c));
            transform(nodes_to_modes(body.max_degree()), order.values);
            for (unsigned int i = 0; i < order.values.size(); ++i)
              set(body.index, dofs[order.modes[c][i]], order.values[i]);
          }
      });
    stiffness->release(in);
  }
} // namespace mortise
