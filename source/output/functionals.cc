#include <deal.II/base/mpi.h>

#include <mortise/body/boundary_faces.h>
#include <mortise/operators/cells/cell_fields.h>
#include <mortise/operators/cells/face_values.h>
#include <mortise/output/functionals.h>

#include <limits>
#include <map>
#include <memory>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    struct PointInCell
    {
      Body::CellIterator cell;
      Point<dim>         unit;
    };

    /// Where @p point is, if it is in a cell of this rank.
    std::optional<PointInCell>
    find_point(const Body &body, const Point<dim> &point)
    {
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        {
          if (!cell->is_locally_owned() ||
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
          // far from the origin a point of a face may be rounded out of it
          const double rounding = std::numeric_limits<double>::epsilon() *
                                  point.norm() /
                                  cell->minimum_vertex_distance();
          if (cell->reference_cell().contains_point(unit, 1e-8 + 4. * rounding))
            return PointInCell{cell, unit};
        }
      return {};
    }

    /// The rank that answers for a point, the lowest that has it; the number
    /// of ranks if none has. Collective.
    unsigned int
    rank_with(const bool found, const MPI_Comm comm)
    {
      return Utilities::MPI::min(found ?
                                   Utilities::MPI::this_mpi_process(comm) :
                                   Utilities::MPI::n_mpi_processes(comm),
                                 comm);
    }
  } // namespace

  bool
  contains(const Body &body, const Point<dim> &point)
  {
    const MPI_Comm comm = body.triangulation().get_communicator();
    return rank_with(find_point(body, point).has_value(), comm) <
           Utilities::MPI::n_mpi_processes(comm);
  }

  std::optional<Tensor<1, dim>>
  point_value(const Body       &body,
              const BodyVector &displacement,
              const Point<dim> &point)
  {
    const MPI_Comm     comm  = body.triangulation().get_communicator();
    const auto         found = find_point(body, point);
    const unsigned int rank  = rank_with(found.has_value(), comm);
    if (rank == Utilities::MPI::n_mpi_processes(comm))
      return {};
    Tensor<1, dim> result;
    if (found)
      {
        const auto &element      = found->cell->get_fe().base_element(0);
        const auto  coefficients = cell_coefficients(found->cell, displacement);
        for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            result[c] +=
              coefficients[c][i] * element.shape_value(i, found->unit);
      }
    return Utilities::MPI::broadcast(comm, result, rank);
  }

  CellFunctionals
  point_functional(const Body        &body,
                   const Point<dim>  &point,
                   const unsigned int c)
  {
    const MPI_Comm comm  = body.triangulation().get_communicator();
    const auto     found = find_point(body, point);
    if (rank_with(found.has_value(), comm) !=
        Utilities::MPI::this_mpi_process(comm))
      return {};
    const auto            &fe = found->cell->get_fe();
    dealii::Vector<double> values(fe.n_dofs_per_cell()), none;
    for (unsigned int k = 0; k < values.size(); ++k)
      if (const auto [component, i] = fe.system_to_component_index(k);
          component == c)
        values[k] = fe.base_element(0).shape_value(i, found->unit);
    if (body.pressure)
      none.reinit(body.pressure->cell(found->cell)->get_fe().n_dofs_per_cell());
    return {{found->cell, values, none}};
  }

  namespace
  {
    /// What the fields of a cell are on one of its faces.
    struct FieldsOnFace
    {
      FieldsOnFace(const Body            &body,
                   const Quadrature<dim> &rule,
                   const unsigned int     f)
        : rule(rule)
        , fields(body, [rule](const auto &) { return rule; })
        , geometry(body, f, rule)
      {}

      const Quadrature<dim> rule;
      CellFields            fields;
      FaceGeometry          geometry;
    };

    struct FunctionsOnFace
    {
      FunctionsOnFace(const Body            &body,
                      const Quadrature<dim> &rule,
                      const unsigned int     f)
        : rule(rule)
        , functions(
            body,
            [rule](const auto &) { return rule; },
            update_gradients)
        , weights(body, [rule](const auto &) { return rule; })
        , at(body, [rule](const auto &) { return rule; })
        , geometry(body, f, rule)
      {}

      const Quadrature<dim>          rule;
      ValuesByElement<FEValues<dim>> functions;
      CellFields                     weights, at;
      FaceGeometry                   geometry;
    };

    /// Calls @p visit(cell, face) for the faces on @p boundary of owned cells, with the rule of
    /// stresses and a Face that stands on them.
    template <typename Face, typename Visit>
    void
    for_each_face(const Body              &body,
                  const types::boundary_id boundary,
                  const Visit             &visit)
    {
      std::map<std::pair<unsigned int, unsigned int>, std::unique_ptr<Face>>
        by_face;
      for (const auto &[cell, f] : boundary_faces(body, boundary))
        if (cell->is_locally_owned())
          {
            auto &face = by_face[{cell->active_fe_index(), f}];
            if (!face)
              face = std::make_unique<Face>(
                body, face_rule(cell->get_fe(), f, body.degree(cell) + 2), f);
            face->geometry.reinit(cell);
            visit(cell, *face);
          }
    }
  } // namespace

  CellFunctionals
  stress_functionals(const Body              &body,
                     const BodySolution      &solution,
                     const types::boundary_id boundary)
  {
    CellFunctionals result;
    const auto      add_face = [&](const Body::CellIterator &cell,
                              FieldsOnFace             &face) {
      const auto            &fe = cell->get_fe();
      dealii::Vector<double> forces(fe.n_dofs_per_cell());
      face.fields.reinit(cell, solution);
      for (unsigned int q = 0; q < face.geometry.points.size(); ++q)
        {
          const Tensor<1, dim> force =
            face.geometry.weights[q] *
            (face.fields.respond(q).nominal * face.geometry.normals[q]);
          for (unsigned int k = 0; k < forces.size(); ++k)
            {
              const auto [c, i] = fe.system_to_component_index(k);
              forces[k] +=
                force[c] *
                fe.base_element(0).shape_value(i, face.rule.point(q));
            }
        }
      result.push_back({cell, forces, {}});
    };
    for_each_face<FieldsOnFace>(body, boundary, add_face);
    return result;
  }

  Tensor<1, dim>
  resultant(const Body              &body,
            const ExactSolution     &exact,
            const types::boundary_id boundary)
  {
    Tensor<1, dim> force;
    for_each_face<FieldsOnFace>(
      body, boundary, [&](const auto &, const FieldsOnFace &face) {
        for (unsigned int q = 0; q < face.geometry.points.size(); ++q)
          force += face.geometry.weights[q] *
                   (exact.nominal_stress(face.geometry.points[q], body.index) *
                    face.geometry.normals[q]);
      });
    return Utilities::MPI::sum(force, body.triangulation().get_communicator());
  }

  CellFunctionals
  stress_functional(const Body              &body,
                    const BodySolution      &solution,
                    const BodySolution      &weights,
                    const types::boundary_id boundary,
                    const unsigned int       c)
  {
    CellFunctionals result;
    const auto      add_face = [&](const Body::CellIterator &cell,
                              FunctionsOnFace          &face) {
      const auto            &fe = cell->get_fe();
      dealii::Vector<double> u(fe.n_dofs_per_cell()), p;
      FEValues<dim>         &functions = face.functions(cell);
      functions.reinit(Triangulation<dim>::cell_iterator(cell));
      face.weights.reinit(cell, weights);
      face.at.reinit(cell, solution);
      std::vector<double> by_pressure;
      for (unsigned int q = 0; q < face.geometry.points.size(); ++q)
        {
          // e . P(h) n = h : P(e n^T), since moduli are symmetric
          Tensor<2, dim> unit;
          unit[c] = face.geometry.weights[q] * face.weights.values[q][c] *
                    face.geometry.normals[q];
          const Tensor<2, dim> stress = face.at.nominal_change(q, unit, 0.);
          if (body.pressure)
            by_pressure.push_back(
              scalar_product(unit,
                             face.at.nominal_change(q, Tensor<2, dim>(), 1.)));
          for (unsigned int k = 0; k < u.size(); ++k)
            {
              const auto [component, i] = fe.system_to_component_index(k);
              u[k] += stress[component] * functions.shape_grad(i, q);
            }
        }
      if (body.pressure)
        {
          const auto own = body.pressure->cell(cell);
          p.reinit(own->get_fe().n_dofs_per_cell());
          for (unsigned int i = 0; i < p.size(); ++i)
            for (unsigned int q = 0; q < by_pressure.size(); ++q)
              p[i] += by_pressure[q] *
                      own->get_fe().shape_value(i, face.rule.point(q));
        }
      result.push_back({cell, u, p});
    };
    for_each_face<FunctionsOnFace>(body, boundary, add_face);
    return result;
  }
} // namespace mortise
