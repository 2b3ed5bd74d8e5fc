// See solution_change.h.
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/output/cell_fields.h>
#include <mortise/output/solution_change.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Gauss rule of degree + @p more points per direction.
    CellFields::Rule
    rule(const unsigned int more)
    {
      return [more](const FiniteElement<dim> &element) {
        return gauss_quadrature<dim>(element, element.degree + more);
      };
    }

    /// Of degrees that have become one higher, with the same points as @p before_rise.
    const auto after_rise = rule(1), before_rise = rule(2);

    /// Call @p visit(cell, its index, fields on it) for owned cells of @p body
    /// that @p wanted.
    template <typename Wanted, typename Visit>
    void
    for_each_cell(const Body             &body,
                  const BodySolution     &solution,
                  const CellFields::Rule &rule,
                  const Wanted           &wanted,
                  const Visit            &visit)
    {
      CellFields fields(body, rule);
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && wanted(cell->active_cell_index()))
          {
            fields.reinit(cell, solution);
            visit(cell->active_cell_index(), fields);
          }
    }

    CellNumbers
    no_numbers(const Bodies &bodies)
    {
      CellNumbers result;
      for (const auto &body : bodies)
        result.emplace_back(body->triangulation().n_active_cells(), 0.);
      return result;
    }

    double
    pressure_at(const std::vector<double> &pressures, const unsigned int q)
    {
      return pressures.empty() ? 0. : pressures[q];
    }
  } // namespace

  CellNumbers
  energy_by_cell(const Bodies                    &bodies,
                 const std::vector<BodySolution> &solutions)
  {
    CellNumbers result = no_numbers(bodies);
    for (const auto &body : bodies)
      for_each_cell(
        *body,
        solutions[body->index],
        after_rise,
        [](const unsigned int) { return true; },
        [&](const unsigned int cell, const CellFields &fields) {
          for (unsigned int q = 0; q < fields.weights.size(); ++q)
            result[body->index][cell] +=
              fields.weights[q] *
              body->material.twice_energy(fields.gradients[q],
                                          pressure_at(fields.pressures, q));
        });
    return result;
  }

  SampledSolution::SampledSolution(const Bodies                    &bodies,
                                   const std::vector<BodySolution> &solutions,
                                   const std::vector<std::vector<bool>> &rises)
  {
    for (const auto &body : bodies)
      {
        auto &of_body =
          samples.emplace_back(body->triangulation().n_active_cells());
        for_each_cell(
          *body,
          solutions[body->index],
          before_rise,
          [&](const unsigned int cell) { return rises[body->index][cell]; },
          [&](const unsigned int cell, const CellFields &fields) {
            of_body[cell] = {fields.gradients, fields.pressures};
          });
      }
  }

  CellNumbers
  SampledSolution::change(const Bodies                    &bodies,
                          const std::vector<BodySolution> &solutions) const
  {
    CellNumbers result = no_numbers(bodies);
    for (const auto &body : bodies)
      {
        const auto &earlier = samples[body->index];
        for_each_cell(
          *body,
          solutions[body->index],
          after_rise,
          [&](const unsigned int cell) {
            return !earlier[cell].gradients.empty();
          },
          [&](const unsigned int cell, const CellFields &fields) {
            for (unsigned int q = 0; q < fields.weights.size(); ++q)
              result[body->index][cell] +=
                fields.weights[q] *
                body->material.twice_energy(
                  fields.gradients[q] - earlier[cell].gradients[q],
                  pressure_at(fields.pressures, q) -
                    pressure_at(earlier[cell].pressures, q));
          });
      }
    return result;
  }
} // namespace mortise
