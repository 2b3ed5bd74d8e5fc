#include <deal.II/base/numbers.h>

#include <mortise/adapt/neighbour_face.h>
#include <mortise/adapt/residuals.h>
#include <mortise/adapt/stress_polynomials.h>
#include <mortise/body/elements/cell_face.h>
#include <mortise/material/nonlinear_law.h>
#include <mortise/operators/cells/face_values.h>

#include <map>
#include <memory>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    template <typename StressTensor>
    Tensor<1, dim>
    traction(const double                    *factors,
             const std::vector<StressTensor> &stresses,
             const Tensor<1, dim>            &normal)
    {
      StressTensor sum;
      for (unsigned int k = 0; k < stresses.size(); ++k)
        sum += factors[k] * stresses[k];
      return sum * normal;
    }

    /// The stress of point @p q that the equations of undeformed bodies hold.
    void
    get_stress(const CellFields &fields, const unsigned int q, Stress &stress)
    {
      stress = fields.stress(q);
    }
    void
    get_stress(const CellFields  &fields,
               const unsigned int q,
               Tensor<2, dim>    &nominal)
    {
      nominal = fields.respond(q).nominal;
    }

    /// The residuals of one body, whose @p StressTensor is Stress, or the nominal stress at finite strain.
    template <typename StressTensor>
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
        , stresses(equations.size())
      {
        set_stresses();
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
      using Key = std::array<unsigned int, 3>;

      void
      set_stresses();
      bool
      has_plastic_front(const Body::CellIterator &cell) const;
      void
      set_cofactors(const Body::CellIterator &cell, const CellFields &fields);
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

      StressPolynomials &
      polynomials(const Body::CellIterator &cell);
      std::vector<StressTensor>
      on_face(const Body::CellIterator &cell, const unsigned int f)
      {
        return polynomials(cell).on_face(f,
                                         stresses[cell->active_cell_index()]);
      }
      /// The same of cof F; empty where no pressure follows the deformation.
      std::vector<Tensor<2, dim>>
      cofactors_on_face(const Body::CellIterator &cell, const unsigned int f)
      {
        const auto found = cofactors.find(cell->active_cell_index());
        return found == cofactors.end() ?
                 std::vector<Tensor<2, dim>>() :
                 polynomials(cell).on_face(f, found->second);
      }
      FaceGeometry &
      face_geometry(const Body::CellIterator &cell,
                    unsigned int              f,
                    unsigned int              n);
      /// StressPolynomials::factors_on_face() at the points of face_rule(), made once for each @p key.
      template <typename Points>
      const std::vector<double> &
      factors(const Body::CellIterator        &cell,
              unsigned int                     f,
              const std::vector<unsigned int> &key,
              const Points                    &points);
      const std::vector<double> &
      own_factors(const Body::CellIterator &cell,
                  const unsigned int        f,
                  const unsigned int        n)
      {
        return factors(cell, f, {n}, [&] {
          return face_rule(cell->get_fe(), f, n).get_points();
        });
      }

      /// h / p.
      double
      length(const Body::CellIterator &cell) const
      {
        return cell->diameter() / (body.mesh.tetrahedra ? 1. : std::sqrt(3.)) /
               body.degree(cell);
      }
      /// @p factors of the point and @p cofactors of the face, see cofactors_on_face().
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
      /// Of owned and ghost cells.
      std::vector<std::vector<StressTensor>> stresses;
      std::map<unsigned int, std::vector<Tensor<2, dim>>>
        cofactors; ///< by cell
      std::set<std::pair<unsigned int, unsigned int>>
        have_partners; ///< cell, face
      std::map<unsigned int, std::unique_ptr<StressPolynomials>> by_element;
      std::map<Key, std::unique_ptr<FaceGeometry>>               geometries;
      std::map<Key, std::unique_ptr<FaceValues>>                 functions;
      std::map<std::pair<Key, std::vector<unsigned int>>, std::vector<double>>
        all_factors;
    };

    template <typename StressTensor>
    StressPolynomials &
    BodyResiduals<StressTensor>::polynomials(const Body::CellIterator &cell)
    {
      auto &result = by_element[cell->active_fe_index()];
      if (!result)
        result = std::make_unique<StressPolynomials>(body, cell->get_fe());
      return *result;
    }

    template <typename StressTensor>
    FaceGeometry &
    BodyResiduals<StressTensor>::face_geometry(const Body::CellIterator &cell,
                                               const unsigned int        f,
                                               const unsigned int        n)
    {
      auto &result = geometries[{{cell->active_fe_index(), f, n}}];
      if (!result)
        result =
          std::make_unique<FaceGeometry>(body,
                                         f,
                                         face_rule(cell->get_fe(), f, n));
      result->reinit(cell);
      return *result;
    }

    template <typename StressTensor>
    template <typename Points>
    const std::vector<double> &
    BodyResiduals<StressTensor>::factors(const Body::CellIterator        &cell,
                                         const unsigned int               f,
                                         const std::vector<unsigned int> &key,
                                         const Points &points)
    {
      auto &result = all_factors[{{{cell->active_fe_index(), f, 0}}, key}];
      if (result.empty())
        for (const Point<dim> &x : points())
          for (const double factor : polynomials(cell).factors_on_face(f, x))
            result.push_back(factor);
      return result;
    }

    template <typename StressTensor>
    void
    BodyResiduals<StressTensor>::set_stresses()
    {
      CellFields fields(body, [&](const FiniteElement<dim> &element) {
        return StressPolynomials::nodes(body, element);
      });
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          {
            fields.reinit(cell, solution);
            auto &of_cell = stresses[cell->active_cell_index()];
            of_cell.resize(fields.points.size());
            for (unsigned int q = 0; q < of_cell.size(); ++q)
              get_stress(fields, q, of_cell[q]);
            if (!cell->is_locally_owned())
              continue;
            if (!data.loads.follower_pressures.empty() && cell->at_boundary())
              set_cofactors(cell, fields);
            if (body.pressure)
              add_dilatation(cell, fields);
            if (has_plastic_front(cell))
              at_plastic_front.push_back(cell->active_cell_index());
          }
    }

    template <typename StressTensor>
    bool
    BodyResiduals<StressTensor>::has_plastic_front(
      const Body::CellIterator &cell) const
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

    template <typename StressTensor>
    void
    BodyResiduals<StressTensor>::set_cofactors(const Body::CellIterator &cell,
                                               const CellFields         &fields)
    {
      auto &of_cell = cofactors[cell->active_cell_index()];
      for (const Tensor<2, dim> &gradient : fields.gradients)
        {
          const Tensor<2, dim> F =
            gradient + Tensor<2, dim>(unit_symmetric_tensor<dim>());
          of_cell.push_back(determinant(F) * transpose(invert(F)));
        }
    }

    template <typename StressTensor>
    void
    BodyResiduals<StressTensor>::add_dilatation(const Body::CellIterator &cell,
                                                const CellFields &fields)
    {
      double sum = 0.;
      for (unsigned int q = 0; q < fields.points.size(); ++q)
        sum += fields.weights[q] * std::pow(fields.missing_dilatation(q), 2);
      equations[cell->active_cell_index()] += body.material.modulus() * sum;
    }

    template <typename StressTensor>
    void
    BodyResiduals<StressTensor>::add_inside(const Body::CellIterator &cell)
    {
      StressPolynomials    &of = polynomials(cell);
      const Quadrature<dim> rule =
        StressPolynomials::rule(body, cell->get_fe());
      auto forces = of.divergence(cell, stresses[cell->active_cell_index()]);
      if (data.loads.body_force)
        {
          const auto &points = of.geometry.points(cell);
          for (unsigned int q = 0; q < points.size(); ++q)
            forces[q] += data.loads.body_force(points[q]);
        }
      const auto &jacobians = of.geometry.jacobians(cell);
      double      sum       = 0.;
      for (unsigned int q = 0; q < forces.size(); ++q)
        sum +=
          rule.weight(q) * determinant(jacobians[q]) * forces[q].norm_square();
      // of a function without mean, by its gradient
      equations[cell->active_cell_index()] +=
        std::pow(length(cell) / numbers::PI, 2) * sum / body.material.modulus();
    }

    template <typename StressTensor>
    Tensor<1, dim>
    BodyResiduals<StressTensor>::given_traction(
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
          result -=
            condition.pressure(x) * traction(factors, cofactors, normal);
      return result;
    }

    template <typename StressTensor>
    std::array<bool, dim>
    BodyResiduals<StressTensor>::free_components(const Body::CellIterator &cell,
                                                 const unsigned int f) const
    {
      std::array<bool, dim> result{{true, true, true}};
      for (const DirichletCondition &condition : data.dirichlet)
        if (condition.boundary == cell->face(f)->boundary_id())
          for (unsigned int c = 0; c < dim; ++c)
            result[c] = result[c] && !condition.fixed[c];
      return result;
    }

    template <typename StressTensor>
    void
    BodyResiduals<StressTensor>::add_interface(const TractionsOnFace &face)
    {
      const auto        &cell = face.cell;
      const unsigned int f    = face.number;
      have_partners.insert({cell->active_cell_index(), f});
      const auto     stress    = on_face(cell, f);
      const auto     cofactors = cofactors_on_face(cell, f);
      const auto     is_free   = free_components(cell, f);
      const CellFace coordinates(cell, f);
      double         sum = 0.;
      for (const TractionAtPoint &point : face.points)
        {
          const auto factors = polynomials(cell).factors_on_face(
            f, coordinates.unit_point(point.xi[0], point.xi[1]));
          const auto missing =
            given_traction(
              cell, f, point.x, point.normal, factors.data(), cofactors) +
            point.traction - traction(factors.data(), stress, point.normal);
          for (unsigned int c = 0; c < dim; ++c)
            if (is_free[c] && point.is_known[c])
              sum += point.weight * missing[c] * missing[c];
        }
      equations[cell->active_cell_index()] +=
        length(cell) * sum / body.material.modulus();
    }

    template <typename StressTensor>
    void
    BodyResiduals<StressTensor>::add_boundary(const Body::CellIterator &cell,
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
      const FaceGeometry &face      = face_geometry(cell, f, n);
      const auto         &factors   = own_factors(cell, f, n);
      const auto          stress    = on_face(cell, f);
      const auto          cofactors = cofactors_on_face(cell, f);
      double              sum       = 0.;
      for (unsigned int q = 0; q < face.points.size(); ++q)
        {
          const double        *at = &factors[q * stress.size()];
          const Tensor<1, dim> missing =
            given_traction(
              cell, f, face.points[q], face.normals[q], at, cofactors) -
            traction(at, stress, face.normals[q]);
          for (unsigned int c = 0; c < dim; ++c)
            sum += counts[c] ? face.weights[q] * missing[c] * missing[c] : 0.;
        }
      equations[cell->active_cell_index()] +=
        length(cell) * sum / body.material.modulus();
    }

    template <typename StressTensor>
    void
    BodyResiduals<StressTensor>::add_condition(
      const Body::CellIterator    &cell,
      const unsigned int           f,
      const DirichletCondition    &condition,
      const std::array<bool, dim> &counts)
    {
      auto &face = functions[{{cell->active_fe_index(), f, 0}}];
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

    template <typename StressTensor>
    void
    BodyResiduals<StressTensor>::add_between(const Body::CellIterator &cell,
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
      const FaceGeometry &face           = face_geometry(cell, f, n);
      const auto         &factors        = own_factors(cell, f, n);
      const NeighbourFace beyond         = neighbour_face(cell, f, neighbour);
      const auto         &factors_beyond = this->factors(
        neighbour,
        beyond.number,
        {n,
                 cell->active_fe_index(),
                 f,
                 beyond.corners[0],
                 beyond.corners[1],
                 beyond.corners[2],
         beyond.child ? *beyond.child + 1 : 0},
        [&] { return points_in_neighbour(cell->get_fe(), f, n, beyond); });
      const auto stress        = on_face(cell, f),
                 stress_beyond = on_face(neighbour, beyond.number);
      double sum               = 0.;
      for (unsigned int q = 0; q < face.points.size(); ++q)
        sum += face.weights[q] *
               (traction(&factors[q * stress.size()], stress, face.normals[q]) -
                traction(&factors_beyond[q * stress_beyond.size()],
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
    Residuals  result;
    const auto add = [&](auto of) {
      for (const unsigned int cell : of.at_plastic_front)
        result.at_plastic_front.emplace_back(result.equations.size(), cell);
      result.equations.push_back(std::move(of.equations));
      result.conditions.push_back(std::move(of.conditions));
    };
    for (const auto &body : bodies)
      {
        const auto &solution = solutions[body->index];
        const auto &of_body  = data[body->index];
        if (body->material.has_finite_strain())
          add(BodyResiduals<Tensor<2, dim>>(*body, solution, of_body));
        else
          add(BodyResiduals<Stress>(*body, solution, of_body));
      }
    return result;
  }
} // namespace mortise
