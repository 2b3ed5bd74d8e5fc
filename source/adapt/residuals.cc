#include <deal.II/base/numbers.h>

#include <mortise/adapt/neighbour_face.h>
#include <mortise/adapt/residuals.h>
#include <mortise/adapt/stress_on_faces.h>
#include <mortise/body/elements/cell_face.h>
#include <mortise/material/nonlinear_law.h>
#include <mortise/operators/cells/cell_fields.h>

#include <map>
#include <memory>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The residuals of one body.
    class BodyResiduals
    {
    public:
      BodyResiduals(const Body         &body,
                    const BodySolution &solution,
                    const BodyData     &data)
        : equations(body.triangulation().n_active_cells(), 0.)
        , conditions(equations)
        , body(body)
        , solution(solution)
        , data(data)
        , on_faces(body,
                   solution,
                   !data.loads.follower_pressures.empty(),
                   [this](const auto &cell, const CellFields &fields) {
                     if (this->body.pressure)
                       add_dilatation(cell, fields);
                     if (has_plastic_front(cell))
                       at_plastic_front.push_back(cell->active_cell_index());
                   })
      {
        for (const auto &cell : body.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            add_inside(cell);
        for (const TractionsOnFaces *interface : data.interfaces)
          for (const TractionsOnFace &face : *interface)
            add_interface(face);
        for (const auto &cell : body.dof_handler.active_cell_iterators())
          if (!cell->is_artificial())
            for (const unsigned int f : cell->face_indices())
              {
                if (!cell->face(f)->at_boundary())
                  add_between(cell, f);
                else if (cell->is_locally_owned())
                  add_boundary(cell, f);
              }
      }

      std::vector<double>       equations, conditions;
      std::vector<unsigned int> at_plastic_front;

    private:
      bool
      has_plastic_front(const Body::CellIterator &cell) const;
      void
      add_dilatation(const Body::CellIterator &cell, const CellFields &fields);
      void
      add_inside(const Body::CellIterator &cell);
      void
      add_interface(const TractionsOnFace &face);
      void
      add_between(const Body::CellIterator &cell, unsigned int f);
      void
      add_boundary(const Body::CellIterator &cell, unsigned int f);
      void
      add_condition(const Body::CellIterator    &cell,
                    unsigned int                 f,
                    const DirichletCondition    &condition,
                    const std::array<bool, dim> &counts);

      /// h / p.
      double
      length(const Body::CellIterator &cell) const
      {
        return cell->diameter() / (body.mesh.tetrahedra ? 1. : std::sqrt(3.)) /
               body.degree(cell);
      }
      /// @p factors of the point and @p cofactors of the face, see
      /// StressOnFaces.
      Tensor<1, dim>
      given_traction(const Body::CellIterator          &cell,
                     unsigned int                       f,
                     const Point<dim>                  &x,
                     const Tensor<1, dim>              &normal,
                     const double                      *factors,
                     const std::vector<Tensor<2, dim>> &cofactors) const;
      /// Components that are not prescribed on face @p f.
      std::array<bool, dim>
      free_components(const Body::CellIterator &cell, unsigned int f) const;

      const Body         &body;
      const BodySolution &solution;
      const BodyData     &data;
      StressOnFaces       on_faces;
      std::set<std::pair<unsigned int, unsigned int>>
        have_partners; ///< cell, face
      std::map<std::pair<unsigned int, unsigned int>,
               std::unique_ptr<FaceValues>>
        functions; ///< by element and face
    };

    bool
    BodyResiduals::has_plastic_front(const Body::CellIterator &cell) const
    {
      if (solution.history.empty() ||
          !body.material.nonlinear()->plastic_strain())
        return false;
      const auto         &history = solution.history[cell->active_cell_index()];
      const NonlinearLaw &law     = *body.material.nonlinear();
      unsigned int        n_points = 0, n_yielded = 0;
      for (unsigned int k = *law.plastic_strain(); k < history.size();
           k += law.n_history(), ++n_points)
        n_yielded += history[k] > 0.;
      return n_yielded > 0 && n_yielded < n_points;
    }

    void
    BodyResiduals::add_dilatation(const Body::CellIterator &cell,
                                  const CellFields         &fields)
    {
      double sum = 0.;
      for (unsigned int q = 0; q < fields.points.size(); ++q)
        sum += fields.weights[q] * std::pow(fields.missing_dilatation(q), 2);
      equations[cell->active_cell_index()] += body.material.modulus() * sum;
    }

    void
    BodyResiduals::add_inside(const Body::CellIterator &cell)
    {
      CellGeometry         &geometry = on_faces.polynomials(cell).geometry;
      const Quadrature<dim> rule =
        StressPolynomials::rule(body, cell->get_fe());
      auto forces = on_faces.divergence(cell);
      if (data.loads.body_force)
        {
          const auto &points = geometry.points(cell);
          for (unsigned int q = 0; q < points.size(); ++q)
            forces[q] += data.loads.body_force(points[q]);
        }
      const auto &jacobians = geometry.jacobians(cell);
      double      sum       = 0.;
      for (unsigned int q = 0; q < forces.size(); ++q)
        sum +=
          rule.weight(q) * determinant(jacobians[q]) * forces[q].norm_square();
      // of a function without mean, by its gradient
      equations[cell->active_cell_index()] +=
        std::pow(length(cell) / numbers::PI, 2) * sum / body.material.modulus();
    }

    Tensor<1, dim>
    BodyResiduals::given_traction(
      const Body::CellIterator          &cell,
      const unsigned int                 f,
      const Point<dim>                  &x,
      const Tensor<1, dim>              &normal,
      const double                      *factors,
      const std::vector<Tensor<2, dim>> &cofactors) const
    {
      Tensor<1, dim> result;
      for (const TractionCondition &condition : data.loads.tractions)
        if (condition.boundary == cell->face(f)->boundary_id())
          result += condition.traction(x, normal);
      for (const PressureCondition &condition : data.loads.follower_pressures)
        if (condition.boundary == cell->face(f)->boundary_id())
          result -= condition.pressure(x) *
                    StressOnFaces::traction(factors, cofactors, normal);
      return result;
    }

    std::array<bool, dim>
    BodyResiduals::free_components(const Body::CellIterator &cell,
                                   const unsigned int        f) const
    {
      std::array<bool, dim> result{{true, true, true}};
      for (const DirichletCondition &condition : data.dirichlet)
        if (condition.boundary == cell->face(f)->boundary_id())
          for (unsigned int c = 0; c < dim; ++c)
            result[c] = result[c] && !condition.fixed[c];
      return result;
    }

    void
    BodyResiduals::add_interface(const TractionsOnFace &face)
    {
      const auto        &cell = face.cell;
      const unsigned int f    = face.number;
      have_partners.insert({cell->active_cell_index(), f});
      const auto     stress    = on_faces.stress(cell, f);
      const auto     cofactors = on_faces.cofactors(cell, f);
      const auto     is_free   = free_components(cell, f);
      const CellFace coordinates(cell, f);
      double         sum = 0.;
      for (const TractionAtPoint &point : face.points)
        {
          const auto factors = on_faces.polynomials(cell).factors_on_face(
            f, coordinates.unit_point(point.xi[0], point.xi[1]));
          const auto missing =
            given_traction(
              cell, f, point.x, point.normal, factors.data(), cofactors) +
            point.traction -
            StressOnFaces::traction(factors.data(), stress, point.normal);
          for (unsigned int c = 0; c < dim; ++c)
            if (is_free[c] && point.is_known[c])
              sum += point.weight * missing[c] * missing[c];
        }
      equations[cell->active_cell_index()] +=
        length(cell) * sum / body.material.modulus();
    }

    void
    BodyResiduals::add_boundary(const Body::CellIterator &cell,
                                const unsigned int        f)
    {
      std::array<bool, dim> counts{{true, true, true}};
      for (const DirichletCondition &condition : data.dirichlet)
        if (condition.boundary == cell->face(f)->boundary_id())
          {
            if (condition.value)
              add_condition(cell, f, condition, counts);
            for (unsigned int c = 0; c < dim; ++c)
              counts[c] = counts[c] && !condition.fixed[c];
          }
      if (have_partners.count({cell->active_cell_index(), f}) > 0 ||
          !(counts[0] || counts[1] || counts[2]))
        return;
      const unsigned int  n         = body.degree(cell) + 2;
      const FaceGeometry &face      = on_faces.geometry(cell, f, n);
      const auto         &factors   = on_faces.factors(cell, f, n);
      const auto          stress    = on_faces.stress(cell, f);
      const auto          cofactors = on_faces.cofactors(cell, f);
      double              sum       = 0.;
      for (unsigned int q = 0; q < face.points.size(); ++q)
        {
          const double        *at = &factors[q * stress.size()];
          const Tensor<1, dim> missing =
            given_traction(
              cell, f, face.points[q], face.normals[q], at, cofactors) -
            StressOnFaces::traction(at, stress, face.normals[q]);
          for (unsigned int c = 0; c < dim; ++c)
            sum += counts[c] ? face.weights[q] * missing[c] * missing[c] : 0.;
        }
      equations[cell->active_cell_index()] +=
        length(cell) * sum / body.material.modulus();
    }

    void
    BodyResiduals::add_condition(const Body::CellIterator    &cell,
                                 const unsigned int           f,
                                 const DirichletCondition    &condition,
                                 const std::array<bool, dim> &counts)
    {
      auto &face = functions[{cell->active_fe_index(), f}];
      if (!face)
        face =
          std::make_unique<FaceValues>(body, cell, f, body.degree(cell) + 2);
      face->reinit(cell);
      const auto u   = cell_coefficients(body, cell, solution);
      double     sum = 0.;
      for (unsigned int q = 0; q < face->points.size(); ++q)
        {
          Tensor<1, dim> missing = condition.value(face->points[q]);
          for (unsigned int c = 0; c < dim; ++c)
            if (condition.fixed[c] && counts[c])
              {
                for (unsigned int k = 0; k < face->indices().size(); ++k)
                  missing[c] -= u[c][face->indices()[k]] * face->value(k, q);
                sum += face->weights[q] * missing[c] * missing[c];
              }
        }
      conditions[cell->active_cell_index()] +=
        0.5 * numbers::PI / length(cell) * body.material.modulus() * sum;
    }

    void
    BodyResiduals::add_between(const Body::CellIterator &cell,
                               const unsigned int        f)
    {
      if (cell->neighbor(f)->has_children()) // which look from their side
        return;
      const Body::CellIterator neighbour = cell->neighbor(f);
      if (neighbour->is_artificial() ||
          (!cell->is_locally_owned() && !neighbour->is_locally_owned()) ||
          (neighbour->level() == cell->level() &&
           neighbour->active_cell_index() < cell->active_cell_index()))
        return;
      const unsigned int n =
        std::max(body.degree(cell), body.degree(neighbour)) + 1;
      const NeighbourFace beyond  = neighbour_face(cell, f, neighbour);
      const FaceGeometry &face    = on_faces.geometry(cell, f, n);
      const auto         &factors = on_faces.factors(cell, f, n),
                 &factors_beyond =
                   on_faces.factors_beyond(cell, f, n, neighbour, beyond);
      const auto stress        = on_faces.stress(cell, f),
                 stress_beyond = on_faces.stress(neighbour, beyond.number);
      double sum               = 0.;
      for (unsigned int q = 0; q < face.points.size(); ++q)
        sum +=
          face.weights[q] *
          (StressOnFaces::traction(&factors[q * stress.size()],
                                   stress,
                                   face.normals[q]) -
           StressOnFaces::traction(&factors_beyond[q * stress_beyond.size()],
                                   stress_beyond,
                                   face.normals[q]))
            .norm_square();
      for (const auto &side : {cell, neighbour})
        if (side->is_locally_owned())
          equations[side->active_cell_index()] +=
            0.5 * length(cell) * sum / body.material.modulus();
    }
  } // namespace

  Residuals
  residuals(const Bodies                    &bodies,
            const std::vector<BodySolution> &solutions,
            const std::vector<BodyData>     &data)
  {
    Residuals result;
    for (const auto &body : bodies)
      {
        BodyResiduals of(*body, solutions[body->index], data[body->index]);
        for (const unsigned int cell : of.at_plastic_front)
          result.at_plastic_front.emplace_back(result.equations.size(), cell);
        result.equations.push_back(std::move(of.equations));
        result.conditions.push_back(std::move(of.conditions));
      }
    return result;
  }
} // namespace mortise
