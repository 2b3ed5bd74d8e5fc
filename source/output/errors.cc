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

  DisplacementErrors
  displacement_errors(const Bodies                  &bodies,
                      const std::vector<BodyVector> &displacements,
                      const ExactSolution           &exact)
  {
    std::array<double, 4>
      sums{}; // squares: L2 error, L2 norm, energy error, energy norm
    for (const auto &body : bodies)
      {
        CellFields fields(*body, 3);
        for (const auto &cell : body->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              fields.reinit(cell, displacements[body->index]);
              for (unsigned int q = 0; q < fields.points.size(); ++q)
                {
                  const Point<dim>    &x = fields.points[q];
                  const Tensor<1, dim> u = exact.displacement(x, body->index);
                  const auto           strain =
                    symmetrize(exact.gradient(x, body->index));
                  const auto strain_error =
                    symmetrize(fields.gradients[q]) - strain;
                  const double weight = fields.weights[q];
                  sums[0] += weight * (fields.values[q] - u).norm_square();
                  sums[1] += weight * u.norm_square();
                  sums[2] += weight * (body->material.stress(strain_error) *
                                       strain_error);
                  sums[3] += weight * (body->material.stress(strain) * strain);
                }
            }
      }
    const MPI_Comm comm = bodies.front()->triangulation().get_communicator();
    for (double &sum : sums)
      sum = Utilities::MPI::sum(sum, comm);
    // an exact solution that is zero has absolute errors
    const auto relative = [](const double error, const double norm) {
      return std::sqrt(norm > 0. ? error / norm : error);
    };
    return {relative(sums[0], sums[1]), relative(sums[2], sums[3])};
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
            const BodyVector        &displacement,
            const types::boundary_id boundary)
  {
    Tensor<1, dim>                     force;
    ValuesByElement<FEFaceValues<dim>> by_element(body,
                                                  rule<dim - 1>(2),
                                                  update_gradients |
                                                    update_normal_vectors |
                                                    update_JxW_values);
    for (const auto &[cell, f] : boundary_faces(body, boundary))
      if (cell->is_locally_owned())
        {
          auto &values = by_element(cell);
          values.reinit(TriaCell(cell), f);
          const auto coefficients = cell_coefficients(cell, displacement);
          for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
            force += values.JxW(q) * (body.material.stress(symmetrize(
                                        gradient(values, coefficients, q))) *
                                      values.normal_vector(q));
        }
    return Utilities::MPI::sum(force, body.triangulation().get_communicator());
  }
} // namespace mortise
