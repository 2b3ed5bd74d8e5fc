#include <deal.II/base/mpi.h>

#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/cells/cell_fields.h>
#include <mortise/operators/cells/face_values.h>
#include <mortise/output/errors.h>

#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// What belongs to one face of the cells of one element.
    template <typename T>
    using ByFace =
      std::map<std::pair<unsigned int, unsigned int>, std::unique_ptr<T>>;

    /// Squares of norms and of errors in them.
    struct Squares
    {
      double l2 = 0., h1 = 0., energy = 0., pressure = 0., stress = 0.;
    };

    void
    add_point(const Body          &body,
              const CellFields    &fields,
              const unsigned int   q,
              const ExactSolution &exact,
              Squares             &error,
              Squares             &norm)
    {
      const Material      &material       = body.material;
      const Point<dim>    &x              = fields.points[q];
      const double         weight         = fields.weights[q];
      const auto           u              = exact.displacement(x, body.index);
      const auto           gradient       = exact.gradient(x, body.index);
      const Tensor<2, dim> gradient_error = fields.gradients[q] - gradient;
      error.l2 += weight * (fields.values[q] - u).norm_square();
      norm.l2 += weight * u.norm_square();
      error.h1 += weight * gradient_error.norm_square();
      norm.h1 += weight * gradient.norm_square();
      double p = 0., p_error = 0.;
      if (material.mixed())
        {
          const auto stress = exact.stress(x, body.index);
          p       = material.pressure(fields.elastic(gradient, q), stress);
          p_error = fields.pressures[q] - p;
          const double mean       = trace(stress) / dim,
                       mean_error = trace(fields.stress(q) - stress) / dim;
          error.pressure += weight * mean_error * mean_error;
          norm.pressure += weight * mean * mean;
          norm.stress += weight * (stress * stress);
        }
      error.energy +=
        weight *
        material.twice_energy_of_change(gradient, gradient_error, p_error);
      norm.energy += weight * material.twice_energy(gradient, p);
    }
  } // namespace

  SolutionErrors
  solution_errors(const Bodies                    &bodies,
                  const std::vector<BodySolution> &solutions,
                  const ExactSolution             &exact)
  {
    Squares error, norm;
    for (const auto &body : bodies)
      {
        CellFields fields(*body, [](const FiniteElement<dim> &element) {
          return gauss_quadrature<dim>(element, element.degree + 3);
        });
        for (const auto &cell : body->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              fields.reinit(cell, solutions[body->index]);
              for (unsigned int q = 0; q < fields.points.size(); ++q)
                add_point(*body, fields, q, exact, error, norm);
            }
      }
    const MPI_Comm comm = bodies.front()->triangulation().get_communicator();
    for (Squares *all : {&error, &norm})
      for (double *square :
           {&all->l2, &all->h1, &all->energy, &all->pressure, &all->stress})
        *square = Utilities::MPI::sum(*square, comm);
    if (norm.pressure < 1e-20 * norm.stress)
      norm.pressure = norm.stress;
    // an exact solution that is zero has absolute errors
    const auto relative = [](const double error_square,
                             const double norm_square) {
      return std::sqrt(norm_square > 0. ? error_square / norm_square :
                                          error_square);
    };
    return {relative(error.l2, norm.l2),
            relative(error.h1, norm.h1),
            relative(error.energy, norm.energy),
            relative(error.pressure, norm.pressure)};
  }

  double
  multiplier_error(
    const Bodies                                        &bodies,
    const std::vector<Coupling>                         &couplings,
    const std::vector<TiedBodies>                       &tied,
    const std::vector<std::vector<std::vector<double>>> &coefficients,
    const ExactSolution                                 &exact)
  {
    double error = 0., norm = 0., stress_norm = 0.;
    for (unsigned int n = 0; n < couplings.size(); ++n)
      {
        const Body        &body = *bodies[tied[n].slave];
        ByFace<FaceValues> by_face;
        const BodySurface &slave = couplings[n].interface->slave();
        for (unsigned int s = 0; s < slave.faces.size(); ++s)
          if (!couplings[n].local[s].partners.empty())
            {
              const auto        &cell = slave.cells[s];
              const unsigned int f    = slave.face_numbers[s];
              auto              &face = by_face[{cell->active_fe_index(), f}];
              if (!face)
                face = std::make_unique<FaceValues>(body,
                                                    cell,
                                                    f,
                                                    body.degree(cell) + 3);
              face->reinit(cell);
              const unsigned int n_functions = face->indices().size();
              for (unsigned int q = 0; q < face->points.size(); ++q)
                {
                  // lambda acts on the master: it is minus the traction on the
                  // slave
                  const auto stress =
                    exact.nominal_stress(face->points[q], tied[n].bearing);
                  const Tensor<1, dim> traction   = stress * face->normals[q];
                  Tensor<1, dim>       difference = traction;
                  const auto &rows = couplings[n].multipliers->rows()[s];
                  for (unsigned int c = 0; c < dim; ++c)
                    if (rows.reproduce_constants[c])
                      for (unsigned int k = 0; k < n_functions; ++k)
                        difference[c] +=
                          coefficients[n][s][c * n_functions + k] *
                          face->value(k, q);
                    else // nothing moves there: any traction is right
                      difference[c] = 0.;
                  error += face->weights[q] * difference.norm_square();
                  norm += face->weights[q] * traction.norm_square();
                  stress_norm += face->weights[q] * stress.norm_square();
                }
            }
      }
    const MPI_Comm comm = bodies.front()->triangulation().get_communicator();
    error               = Utilities::MPI::sum(error, comm);
    norm                = Utilities::MPI::sum(norm, comm);
    stress_norm         = Utilities::MPI::sum(stress_norm, comm);
    // where the interface bears nothing but rounding, the stress beside it is
    // the measure
    if (norm < 1e-20 * stress_norm)
      norm = stress_norm;
    return std::sqrt(norm > 0. ? error / norm : error);
  }
} // namespace mortise
