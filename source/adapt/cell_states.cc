#include <mortise/adapt/cell_states.h>
#include <mortise/body/elements/legendre_elements.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/cells/cell_fields.h>

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
} // namespace mortise
