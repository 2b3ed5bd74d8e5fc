#include <deal.II/base/mpi.h>

#include <mortise/body/boundary_faces.h>
#include <mortise/body/cell_face.h>
#include <mortise/body/simplex_quadrature.h>
#include <mortise/output/cell_fields.h>
#include <mortise/output/errors.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Gauss rules with so many more points per direction than the degree.
    template <int n>
    auto
    rule(const unsigned int extra_points)
    {
      return [=](const FiniteElement<dim> &element) {
        return gauss_quadrature<n>(element, element.degree + extra_points);
      };
    }

    using TriaCell = Triangulation<dim>::cell_iterator;
  } // namespace

  namespace
  {
    /// Squares of norms and of errors in them.
    struct Squares
    {
      double l2 = 0., h1 = 0., energy = 0., pressure = 0., stress = 0.;
    };

    /// What one point adds to the energy, twice.
    double
    energy_density(const LinearElastic           &material,
                   const SymmetricTensor<2, dim> &strain,
                   const double                   pressure)
    {
      return material.stress(strain, 0.) * strain +
             (material.mixed ?
                material.compressibility() * pressure * pressure :
                0.);
    }

    void
    add_point(const Body          &body,
              const CellFields    &fields,
              const unsigned int   q,
              const ExactSolution &exact,
              Squares             &error,
              Squares             &norm)
    {
      const LinearElastic &material = body.material;
      const Point<dim>    &x        = fields.points[q];
      const double         weight   = fields.weights[q];
      const auto           u        = exact.displacement(x, body.index);
      const auto           gradient = exact.gradient(x, body.index);
      const auto           strain   = symmetrize(gradient);
      const auto strain_error       = symmetrize(fields.gradients[q]) - strain;
      error.l2 += weight * (fields.values[q] - u).norm_square();
      norm.l2 += weight * u.norm_square();
      error.h1 += weight * (fields.gradients[q] - gradient).norm_square();
      norm.h1 += weight * gradient.norm_square();
      double p = 0., p_error = 0.;
      if (material.mixed)
        {
          const auto stress = exact.stress(x, body.index);
          p                 = material.pressure(strain, stress);
          p_error           = fields.pressures[q] - p;
          const double mean = trace(stress) / dim,
                       mean_error =
                         trace(material.stress(strain_error, p_error)) / dim;
          error.pressure += weight * mean_error * mean_error;
          norm.pressure += weight * mean * mean;
          norm.stress += weight * (stress * stress);
        }
      error.energy += weight * energy_density(material, strain_error, p_error);
      norm.energy += weight * energy_density(material, strain, p);
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
        CellFields fields(*body, 3);
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
    const std::vector<unsigned int>                     &slave_bodies,
    const std::vector<std::vector<std::vector<double>>> &coefficients,
    const ExactSolution                                 &exact)
  {
    double error = 0., norm = 0., stress_norm = 0.;
    for (unsigned int n = 0; n < couplings.size(); ++n)
      {
        const Body                        &body = *bodies[slave_bodies[n]];
        ValuesByElement<FEFaceValues<dim>> by_element(
          body,
          rule<dim - 1>(3),
          update_values | update_normal_vectors | update_quadrature_points |
            update_JxW_values);
        const BodySurface &slave = couplings[n].interface->slave();
        for (unsigned int s = 0; s < slave.faces.size(); ++s)
          if (!couplings[n].local[s].partners.empty())
            {
              auto &values = by_element(slave.cells[s]);
              values.reinit(TriaCell(slave.cells[s]), slave.face_numbers[s]);
              const auto on_face =
                CellFace(slave.cells[s], slave.face_numbers[s]).indices;
              for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                {
                  // lambda acts on the master: it is minus the traction on the
                  // slave
                  const auto stress =
                    exact.stress(values.quadrature_point(q), body.index);
                  const Tensor<1, dim> traction =
                    stress * values.normal_vector(q);
                  Tensor<1, dim> difference = traction;
                  for (unsigned int c = 0; c < dim; ++c)
                    for (unsigned int k = 0; k < on_face.size(); ++k)
                      difference[c] +=
                        coefficients[n][s][c * on_face.size() + k] *
                        values.shape_value(on_face[k], q);
                  error += values.JxW(q) * difference.norm_square();
                  norm += values.JxW(q) * traction.norm_square();
                  stress_norm += values.JxW(q) * (stress * stress);
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

  std::optional<Tensor<1, dim>>
  point_value(const Body       &body,
              const BodyVector &displacement,
              const Point<dim> &point)
  {
    // the owner of the lowest rank that has the point answers
    const MPI_Comm     comm    = body.triangulation().get_communicator();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    const unsigned int me      = Utilities::MPI::this_mpi_process(comm);
    Tensor<1, dim>     result;
    bool               found = false;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      {
        if (found || !cell->is_locally_owned() ||
            (cell->center() - point).norm() > 2. * cell->diameter())
          continue;
        Point<dim> unit;
        try
          {
            unit = body.mapping->transform_real_to_unit_cell(cell, point);
          }
        catch (const Mapping<dim>::ExcTransformationFailed &)
          {
            continue;
          }
        if (!cell->reference_cell().contains_point(unit, 1e-8))
          continue;
        const FiniteElement<dim> &element = cell->get_fe().base_element(0);
        const auto coefficients = cell_coefficients(cell, displacement);
        for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            result[c] += coefficients[c][i] * element.shape_value(i, unit);
        found = true;
      }
    const unsigned int answers =
      Utilities::MPI::min(found ? me : n_ranks, comm);
    if (answers == n_ranks)
      return {};
    return Utilities::MPI::broadcast(comm, result, answers);
  }

  Tensor<1, dim>
  resultant(const Body              &body,
            const BodySolution      &solution,
            const types::boundary_id boundary)
  {
    Tensor<1, dim>                     force;
    ValuesByElement<FEFaceValues<dim>> by_element(body,
                                                  rule<dim - 1>(2),
                                                  update_gradients |
                                                    update_normal_vectors |
                                                    update_JxW_values),
      pressure_by_element(body, rule<dim - 1>(3), update_values);
    for (const auto &[cell, f] : boundary_faces(body, boundary))
      if (cell->is_locally_owned())
        {
          auto &values = by_element(cell);
          values.reinit(TriaCell(cell), f);
          const auto coefficients =
            cell_coefficients(cell, solution.displacement);
          std::vector<double> pressures(values.n_quadrature_points);
          if (body.pressure)
            {
              const auto own             = body.pressure->cell(cell);
              auto      &pressure_values = pressure_by_element(own);
              pressure_values.reinit(TriaCell(own), f);
              pressures = pressures_at(own, pressure_values, solution.pressure);
            }
          for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
            force += values.JxW(q) *
                     (body.material.stress(symmetrize(
                                             gradient(values, coefficients, q)),
                                           pressures[q]) *
                      values.normal_vector(q));
        }
    return Utilities::MPI::sum(force, body.triangulation().get_communicator());
  }
} // namespace mortise
