#include <deal.II/base/utilities.h>

#include <boost/serialization/vector.hpp>

#include <mortise/adapt/cell_states.h>
#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/legendre_elements.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/cells/cell_fields.h>

#include <array>
#include <cmath>
#include <memory>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Set @p vector on @p cell to the functions of a lower @p degree, by component from @p coefficients on.
    void
    embed(const Body::CellIterator  &cell,
          const unsigned int         degree,
          const std::vector<double> *coefficients,
          BodyVector                &vector)
    {
      constexpr unsigned int               none = -1;
      const auto                          &fe   = cell->get_fe();
      std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      const auto modes =
        nested_modes(cell->reference_cell(), degree, fe.degree);
      std::vector<unsigned int> lower(dofs.size() / fe.n_components(), none);
      for (unsigned int i = 0; i < modes.size(); ++i)
        lower[modes[i]] = i;
      for (unsigned int k = 0; k < dofs.size(); ++k)
        {
          const auto [c, mode] = fe.system_to_component_index(k);
          if (lower[mode] != none && vector.in_local_range(dofs[k]))
            vector(dofs[k]) = coefficients[c][lower[mode]];
        }
    }

    /// Of a cell of @p degree, in any unit: within a quarter what products with
    /// the matrix-free operator take (doc/measurements/bulk.md).
    unsigned int
    work(const unsigned int degree)
    {
      return std::pow(degree + 1, 3);
    }
  } // namespace

  void
  set_coefficients(const Bodies                    &bodies,
                   const std::vector<BodySolution> &solutions,
                   CellStates                      &states,
                   const OfState                    coefficients)
  {
    states.resize(bodies.size());
    for (const auto &body : bodies)
      states[body->index].resize(body->triangulation().n_active_cells());
    for_each_cell(bodies,
                  states,
                  [&](const Body &body, const auto &cell, CellState &state) {
                    state.degree = body.degree(cell);
                    state.*coefficients =
                      cell_coefficients(body, cell, solutions[body.index]);
                  });
  }

  std::vector<BodySolution>
  embedded(const Bodies     &bodies,
           const CellStates &states,
           const OfState     coefficients)
  {
    std::vector<BodySolution> result = zero_solutions(bodies);
    for_each_cell(bodies,
                  states,
                  [&](const Body      &body,
                      const auto      &cell,
                      const CellState &state) {
                    BodySolution &solution = result[body.index];
                    embed(cell,
                          state.degree,
                          (state.*coefficients).data(),
                          solution.displacement);
                    if (body.pressure)
                      embed(body.pressure->cell(cell),
                            state.degree - 1,
                            (state.*coefficients).data() + dim,
                            solution.pressure);
                  });
    for (const auto &body : bodies)
      {
        result[body->index].displacement.update_ghost_values();
        if (body->pressure)
          result[body->index].pressure.update_ghost_values();
      }
    return result;
  }

  namespace
  {
    Quadrature<dim>
    energy_rule(const FiniteElement<dim> &element)
    {
      return gauss_quadrature<dim>(element, element.degree + 1);
    }

    using Fields = std::vector<std::unique_ptr<CellFields>>;

    /// Integrals over owned cells of what @p density(material, fields, q) is of @p n fields; @p set(body, cell, fields)
    /// gives them their coefficients, the first one always, or leaves out the
    /// cell, which is false.
    template <typename Set, typename Density>
    NumbersByCell
    integrals_by_cell(const Bodies      &bodies,
                      const unsigned int n,
                      const Set         &set,
                      const Density     &density)
    {
      NumbersByCell result;
      for (const auto &body : bodies)
        {
          auto &of_body =
            result.emplace_back(body->triangulation().n_active_cells(), 0.);
          Fields fields;
          for (unsigned int k = 0; k < n; ++k)
            fields.push_back(std::make_unique<CellFields>(*body, energy_rule));
          for (const auto &cell : body->dof_handler.active_cell_iterators())
            if (cell->is_locally_owned() && set(*body, cell, fields))
              for (unsigned int q = 0; q < fields[0]->weights.size(); ++q)
                of_body[cell->active_cell_index()] +=
                  fields[0]->weights[q] * density(body->material, fields, q);
        }
      return result;
    }

    double
    pressure_at(const CellFields &fields, const unsigned int q)
    {
      return fields.pressures.empty() ? 0. : fields.pressures[q];
    }

    /// Of the changes fields[0] of fields[1], which are evaluated at finite
    /// strain alone.
    double
    energy_of_change(const Material    &material,
                     const Fields      &fields,
                     const unsigned int q)
    {
      return material.twice_energy_of_change(material.has_finite_strain() ?
                                               fields[1]->gradients[q] :
                                               Tensor<2, dim>(),
                                             fields[0]->gradients[q],
                                             pressure_at(*fields[0], q));
    }
  } // namespace

  NumbersByCell
  energy_by_cell(const Bodies                    &bodies,
                 const std::vector<BodySolution> &solutions)
  {
    const auto set = [&](const Body &body, const auto &cell, auto &fields) {
      fields[0]->reinit(cell, solutions[body.index]);
      return true;
    };
    return integrals_by_cell(
      bodies,
      1,
      set,
      [](const Material &material, const Fields &fields, const unsigned int q) {
        return material.twice_energy(fields[0]->gradients[q],
                                     pressure_at(*fields[0], q));
      });
  }

  NumbersByCell
  energy_of_changes(const Bodies                    &bodies,
                    const std::vector<BodySolution> &solutions,
                    const std::vector<BodySolution> &changes)
  {
    const auto set = [&](const Body &body, const auto &cell, auto &fields) {
      fields[0]->reinit(cell, changes[body.index]);
      if (body.material.has_finite_strain())
        fields[1]->reinit(cell, solutions[body.index]);
      return true;
    };
    return integrals_by_cell(bodies, 2, set, energy_of_change);
  }

  NumbersByCell
  energy_of_new_modes(const Bodies &bodies, const CellStates &states)
  {
    const auto set = [&](const Body &body, const auto &cell, auto &fields) {
      const CellState &state = states[body.index][cell->active_cell_index()];
      if (!state.history.is_refined || state.history.is_split)
        return false;
      CellCoefficients modes = state.coefficients;
      for (unsigned int c = 0; c < modes.size(); ++c)
        if (const unsigned int degree =
              c < dim ? state.degree : state.degree - 1;
            degree > 1)
          for (const unsigned int i :
               nested_modes(cell->reference_cell(), degree - 1, degree))
            modes[c][i] = 0.;
      fields[0]->reinit(cell, modes);
      if (body.material.has_finite_strain())
        fields[1]->reinit(cell, state.coefficients);
      return true;
    };
    return integrals_by_cell(bodies, 2, set, energy_of_change);
  }

  NumbersByCell
  products_by_cell(const Bodies                    &bodies,
                   const std::vector<BodySolution> &solutions,
                   const std::vector<BodySolution> &a,
                   const std::vector<BodySolution> &b)
  {
    const auto set = [&](const Body &body, const auto &cell, auto &fields) {
      fields[0]->reinit(cell, a[body.index]);
      fields[1]->reinit(cell, b[body.index]);
      if (body.material.nonlinear())
        fields[2]->reinit(cell, solutions[body.index]);
      return true;
    };
    return integrals_by_cell(
      bodies,
      3,
      set,
      [](const Material &material, const Fields &fields, const unsigned int q) {
        // the tangent of a linear law is the same anywhere
        const CellFields &at = material.nonlinear() ? *fields[2] : *fields[0];
        return at.tangent_product(q, *fields[0], *fields[1]);
      });
  }

  namespace
  {
    /// Initial state of child @p child of a cell with @p state.
    CellState
    state_of_child(const CellState &state, const unsigned int child)
    {
      CellState result          = state;
      result.history.is_refined = true;
      result.history.is_split   = true;
      result.history.n_rises    = 0;
      result.history.fall       = 1.;
      result.history.error /= GeometryInfo<dim>::max_children_per_cell;
      for (const OfState part : {&CellState::coefficients, &CellState::dual})
        for (unsigned int c = 0; c < (result.*part).size(); ++c)
          (result.*part)[c] =
            embed_in_child(c < dim ? state.degree : state.degree - 1,
                           child,
                           (state.*part)[c]);
      return result;
    }
  } // namespace

  void
  lower(const ReferenceCell &cell, const unsigned int degree, CellState &state)
  {
    for (const OfState part : {&CellState::coefficients, &CellState::dual})
      for (unsigned int c = 0; c < (state.*part).size(); ++c)
        {
          const unsigned int  less = c < dim ? 0 : 1; // of the pressure
          std::vector<double> lower;
          for (const unsigned int mode :
               nested_modes(cell, degree - less, state.degree - less))
            lower.push_back((state.*part)[c][mode]);
          (state.*part)[c] = std::move(lower);
        }
    state.degree = state.history.degree = degree;
  }

  namespace
  {
    /// What @p of_child brings to @p coefficients of its parent, a hexahedron of @p degree.
    void
    add_child(const CellCoefficients &of_child,
              const unsigned int      degree_of_child,
              const unsigned int      child,
              const unsigned int      degree,
              CellCoefficients       &coefficients)
    {
      coefficients.resize(of_child.size());
      for (unsigned int c = 0; c < of_child.size(); ++c)
        {
          const unsigned int  less  = c < dim ? 0 : 1;
          const auto          modes = nested_modes(ReferenceCells::Hexahedron,
                                          degree_of_child - less,
                                          degree - less);
          std::vector<double> raised(
            Utilities::fixed_power<dim>(degree + 1 - less));
          for (unsigned int i = 0; i < modes.size(); ++i)
            raised[modes[i]] = of_child[c][i];
          const auto part = merge_from_child(degree - less, child, raised);
          coefficients[c].resize(part.size(), 0.);
          for (unsigned int i = 0; i < part.size(); ++i)
            coefficients[c][i] += part[i];
        }
    }

    /// Of a cell whose children have @p states, with the largest degree of them.
    CellState
    state_of_parent(const std::vector<CellState> &states)
    {
      CellState result;
      result.history       = states.front().history;
      CellHistory &history = result.history;
      history.change = history.error = history.violation = 0.;
      history.n_rises                                    = 0;
      history.fall                                       = 1.;
      for (const CellState &state : states)
        {
          const CellHistory &own = state.history;
          result.degree          = std::max(result.degree, state.degree);
          history.change += own.change;
          history.error += own.error;
          history.violation += own.violation;
          history.by_residual = std::max(history.by_residual, own.by_residual);
          history.ratio       = std::max(history.ratio, own.ratio);
          history.is_new |= own.is_new;
          history.at_free_boundary |= own.at_free_boundary;
        }
      history.degree = result.degree;
      for (const OfState part : {&CellState::coefficients, &CellState::dual})
        for (unsigned int c = 0; c < states.size(); ++c)
          add_child(
            states[c].*part, states[c].degree, c, result.degree, result.*part);
      return result;
    }
  } // namespace

  void
  change_cells(Body                    &body,
               const std::vector<bool> &split,
               const std::vector<bool> &merge,
               std::vector<CellState>  &states)
  {
    auto &triangulation =
      dynamic_cast<HexTriangulation &>(*body.mesh.triangulation);
    body.pressure.reset();
    // a handler follows the cells of its mesh, from deal.II 9.6 on without
    // dofs, too, which then fails
    static const Triangulation<dim> no_cells;
    body.dof_handler.reinit(no_cells);
    for (const auto &cell : triangulation.active_cell_iterators())
      if (const unsigned int k = cell->active_cell_index();
          cell->is_locally_owned())
        {
          if (split[k])
            cell->set_refine_flag();
          else if (merge[k])
            cell->set_coarsen_flag();
        }
    triangulation.prepare_coarsening_and_refinement();

    using Cell   = HexTriangulation::cell_iterator;
    using Status = HexTriangulation::CellStatus;
    // of a cell, or of those that become one
    const auto states_of = [&](const Cell &cell, const Status status) {
      if (status != HexTriangulation::CELL_COARSEN)
        return std::vector<CellState>{states[cell->active_cell_index()]};
      std::vector<CellState> result;
      for (unsigned int c = 0; c < cell->n_children(); ++c)
        result.push_back(states[cell->child(c)->active_cell_index()]);
      return result;
    };
    const auto balance = triangulation.signals.weight.connect(
      [&](const Cell &cell, const Status status) {
        const Cell one =
          status == HexTriangulation::CELL_COARSEN ? cell->child(0) : cell;
        return work(states[one->active_cell_index()].history.degree);
      });
    const unsigned int handle = triangulation.register_data_attach(
      [&](const Cell &cell, const Status status) {
        return Utilities::pack(states_of(cell, status), false);
      },
      true);
    triangulation.execute_coarsening_and_refinement();
    balance.disconnect();
    if (body.mesh.geometry != nullptr)
      body.mesh.geometry->place_vertices(triangulation);

    states.clear();
    states.resize(triangulation.n_active_cells());
    triangulation.notify_ready_to_unpack(
      handle, [&](const Cell &cell, const Status status, const auto &data) {
        const auto before =
          Utilities::unpack<std::vector<CellState>>(data.begin(),
                                                    data.end(),
                                                    false);
        if (status == HexTriangulation::CELL_REFINE)
          for (unsigned int c = 0; c < cell->n_children(); ++c)
            states[cell->child(c)->active_cell_index()] =
              state_of_child(before.front(), c);
        else
          states[cell->active_cell_index()] =
            status == HexTriangulation::CELL_COARSEN ? state_of_parent(before) :
                                                       before.front();
      });
    body.dof_handler.reinit(triangulation);
  }
} // namespace mortise
