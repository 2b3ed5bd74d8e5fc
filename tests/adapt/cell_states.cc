// Proves that solutions keep every digit when cells are cut and degrees rise:
// energy, moments and the conditions of hanging nodes, on hexahedra and, for
// degrees, tetrahedra, with and without a pressure, also where all that is
// undone; that histories follow their cells; which cells are cut with others;
// and that no rank is left without cells.
#include <deal.II/base/mpi.h>

#include <mortise/adapt/cell_changes.h>
#include <mortise/adapt/cell_states.h>
#include <mortise/adapt/refinement.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/cells/cell_fields.h>

#include <algorithm>
#include <cmath>

#include "../verdict.h"

using namespace mortise;
using namespace dealii;

namespace
{
  std::unique_ptr<Body>
  make_body(const std::string &cells, const bool mixed)
  {
    auto body =
      std::make_unique<Body>("body",
                             0,
                             LinearElastic{1., mixed ? 0.5 : 0.3, mixed});
    MeshParameters mesh;
    mesh.source       = "box";
    mesh.cells        = cells;
    mesh.extent       = {0., 0., 0., 1., 2., 1.};
    mesh.subdivisions = {2, 2, 1};
    if (cells == "hexahedra")
      mesh.refine_near = "0, 0, 0, 0.2, 1";
    body->create_mesh(mesh, MPI_COMM_WORLD, "");
    body->create_space(mixed ? 3 : 2, {{0, 4}}, "");
    return body;
  }

  /// Any numbers that do not depend on the ranks, made conforming.
  void
  fill(const DoFHandler<dim>           &dof_handler,
       const AffineConstraints<double> &conformity,
       BodyVector                      &vector)
  {
    for (const auto dof : dof_handler.locally_owned_dofs())
      vector(dof) = 0.;
    std::vector<types::global_dof_index> dofs;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          dofs.resize(cell->get_fe().n_dofs_per_cell());
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (vector.in_local_range(dofs[i]))
              vector(dofs[i]) = std::sin(17. * i + 31. * cell->center()[0] +
                                         7. * cell->center()[1]);
        }
    AffineConstraints<double> closed;
    closed.copy_from(conformity);
    closed.close();
    vector.update_ghost_values();
    closed.distribute(vector);
    vector.update_ghost_values();
  }

  std::vector<BodySolution>
  any_solution(const Bodies &bodies)
  {
    const Body &body   = *bodies.front();
    auto        result = zero_solutions(bodies);
    fill(body.dof_handler, body.conformity, result[0].displacement);
    if (body.pressure)
      fill(body.pressure->dof_handler,
           body.pressure->conformity,
           result[0].pressure);
    return result;
  }

  double
  violation(const AffineConstraints<double> &conformity,
            const BodyVector                &vector)
  {
    AffineConstraints<double> closed;
    closed.copy_from(conformity);
    closed.close();
    BodyVector distributed = vector;
    closed.distribute(distributed);
    distributed -= vector;
    return distributed.linfty_norm();
  }

  /// Energy, and integrals of displacement and pressure with a weight.
  std::vector<double>
  integrals(const Bodies &bodies, const std::vector<BodySolution> &solutions)
  {
    const Body         &body = *bodies.front();
    std::vector<double> result(3, 0.);
    const auto          energies = energy_by_cell(bodies, solutions);
    for (const double energy : energies.front())
      result[0] += energy;
    CellFields fields(body, [](const FiniteElement<dim> &element) {
      return gauss_quadrature<dim>(element, element.degree + 3);
    });
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          fields.reinit(cell, solutions.front());
          for (unsigned int q = 0; q < fields.weights.size(); ++q)
            {
              const auto  &x = fields.points[q];
              const double w = fields.weights[q] * x[0] * (1. + x[1] * x[2]);
              result[1] += w * (fields.values[q] * Tensor<1, dim>(x));
              if (body.pressure)
                result[2] += w * fields.pressures[q];
            }
        }
    for (double &value : result)
      value = Utilities::MPI::sum(value, MPI_COMM_WORLD);
    return result;
  }

  void
  check(const std::string &cells, const bool mixed)
  {
    const std::string what = cells + (mixed ? ", mixed" : "");
    Bodies            bodies;
    bodies.push_back(make_body(cells, mixed));
    Body      &body     = *bodies.front();
    const auto solution = any_solution(bodies);
    const auto before   = integrals(bodies, solution);
    CellStates states;
    set_coefficients(bodies, solution, states);
    std::vector<bool> split;
    double            error = 0.;
    for (const auto &cell : body.triangulation().active_cell_iterators())
      {
        split.push_back(cell->is_locally_owned() && cell->center()[0] < 0.5 &&
                        cell->center()[1] < 0.5 && cell->center()[2] < 0.6);
        if (cell->is_locally_owned())
          {
            CellHistory &history = states[0][cell->active_cell_index()].history;
            history.degree       = states[0][cell->active_cell_index()].degree +
                             (cell->center()[1] > 0.3 ? 1 : 0);
            history.error = cell->measure();
            error += history.error;
          }
      }
    if (cells == "hexahedra")
      {
        const auto  n = body.triangulation().n_global_active_cells();
        Refinements chosen(1);
        for (const bool cut : split)
          chosen[0].push_back(cut ? Refinement::split : Refinement::keep);
        chosen         = with_closure(bodies, chosen);
        const auto cut = Utilities::MPI::sum(std::count(chosen[0].begin(),
                                                        chosen[0].end(),
                                                        Refinement::split),
                                             MPI_COMM_WORLD);
        change_cells(body, split, std::vector<bool>(split.size()), states[0]);
        verdict(what + ": cells that are cut with others",
                std::fabs(double(body.triangulation().n_global_active_cells()) -
                          n - 7. * cut),
                0.);
        verdict(what + ": cells without new ones",
                double(n) - body.triangulation().n_global_active_cells() + 1.,
                0.);
      }
    std::vector<unsigned int> degrees;
    double                    carried = 0.;
    for (const CellState &state : states[0])
      {
        degrees.push_back(state.history.degree);
        carried += state.history.error;
      }
    verdict(what + ": ranks without cells",
            Utilities::MPI::max(carried > 0. ? 0. : 1., MPI_COMM_WORLD),
            0.);
    verdict(what + ": history",
            std::fabs(Utilities::MPI::sum(carried - error, MPI_COMM_WORLD)),
            1e-14);
    body.create_space(degrees);
    const auto after = embedded(bodies, states);
    verdict(what + ": hanging nodes and mixed degrees",
            violation(body.conformity, after[0].displacement),
            1e-13);
    if (mixed)
      verdict(what + ": of the pressure",
              violation(body.pressure->conformity, after[0].pressure),
              1e-13);
    const auto then = integrals(bodies, after);
    for (unsigned int i = 0; i < (mixed ? 3 : 2); ++i)
      verdict(what + ": integral " + std::to_string(i),
              std::fabs(then[i] / before[i] - 1.),
              1e-11);
  }

  /// Give all cells the degrees of their histories.
  void
  use_degrees(Body &body, const std::vector<CellState> &states)
  {
    std::vector<unsigned int> degrees;
    for (const CellState &state : states)
      degrees.push_back(state.history.degree);
    body.create_space(degrees);
  }

  /// Cells are cut and rise, then fall and become one again.
  void
  check_undone(const bool mixed)
  {
    const std::string what = mixed ? "undone, mixed" : "undone";
    Bodies            bodies;
    bodies.push_back(make_body("hexahedra", mixed));
    Body      &body     = *bodies.front();
    const auto solution = any_solution(bodies);
    const auto before   = integrals(bodies, solution);
    const auto n_cells  = body.triangulation().n_global_active_cells();
    CellStates states;
    set_coefficients(bodies, solution, states);
    for (CellState &state : states[0])
      {
        state.history.degree = state.degree + 1;
        state.history.error  = 1.;
      }
    const std::vector<bool> none(states[0].size(), false),
      all(states[0].size(), true);
    change_cells(body, all, none, states[0]);
    use_degrees(body, states[0]);
    set_coefficients(bodies, embedded(bodies, states), states);
    verdict(what + ": cells that were cut",
            std::fabs(double(body.triangulation().n_global_active_cells()) -
                      8. * n_cells),
            0.);
    for_each_cell(bodies,
                  states,
                  [](const Body &, const auto &cell, CellState &state) {
                    lower(cell->reference_cell(), state.degree - 1, state);
                  });
    // of the first cell the mesh has cut one, too
    const auto beside_first = [](const auto &cell) {
      return cell->center()[0] > 0.5 || cell->center()[1] > 1.;
    };
    for (int level = 2; level > 0; --level)
      {
        std::vector<bool> merge;
        for (const auto &cell : body.triangulation().active_cell_iterators())
          merge.push_back(cell->level() == level && cell->is_locally_owned() &&
                          (level == 2 || beside_first(cell->parent())));
        change_cells(body,
                     std::vector<bool>(merge.size(), false),
                     merge,
                     states[0]);
      }
    use_degrees(body, states[0]);
    verdict(what + ": cells",
            std::fabs(double(body.triangulation().n_global_active_cells()) -
                      n_cells),
            0.);
    double errors = 0.;
    for_each_cell(bodies,
                  states,
                  [&](const Body &, const auto &, const CellState &state) {
                    errors += state.history.error;
                  });
    verdict(what + ": history",
            std::fabs(Utilities::MPI::sum(errors, MPI_COMM_WORLD) - n_cells),
            1e-12);
    const auto after = integrals(bodies, embedded(bodies, states));
    for (unsigned int i = 0; i < (mixed ? 3 : 2); ++i)
      verdict(what + ": integral " + std::to_string(i),
              std::fabs(after[i] / before[i] - 1.),
              1e-11);
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  MPI_Comm_rank(MPI_COMM_WORLD, &argc);
  if (argc != 0)
    std::cout.setstate(std::ios::failbit);
  for (const bool mixed : {false, true})
    for (const std::string cells : {"hexahedra", "tetrahedra"})
      check(cells, mixed);
  for (const bool mixed : {false, true})
    check_undone(mixed);
}
