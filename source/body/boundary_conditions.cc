#include <deal.II/base/quadrature_lib.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/body/boundary_conditions.h>
#include <mortise/body/elements/cell_face.h>
#include <mortise/body/elements/simplex_quadrature.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The inverse of the mass matrix of the functions that @p values holds by
    /// point, of those in @p used.
    FullMatrix<double>
    inverse_mass(const std::vector<std::vector<double>> &values,
                 const std::vector<double>              &weights,
                 const std::vector<unsigned int>        &used)
    {
      FullMatrix<double> mass(used.size());
      for (unsigned int q = 0; q < weights.size(); ++q)
        for (unsigned int i = 0; i < used.size(); ++i)
          for (unsigned int j = 0; j < used.size(); ++j)
            mass(i, j) += weights[q] * values[q][used[i]] * values[q][used[j]];
      if (!used.empty())
        mass.gauss_jordan();
      return mass;
    }

    /// Interpolates vector fields on faces of one shape and degree by
    /// projections: what all of them share.
    class FaceInterpolation
    {
    public:
      using Field = std::function<Tensor<1, dim>(double xi_1, double xi_2)>;

      explicit FaceInterpolation(const TraceBasis &basis);

      /// Coefficients in the order of the basis. @p edge_degree, @p face_degree: highest modes
      /// that exist.
      std::vector<Tensor<1, dim>>
      operator()(const Field                       &field,
                 const std::array<unsigned int, 4> &edge_degree,
                 unsigned int                       face_degree) const;

    private:
      void
      project_edge(const Field                 &field,
                   unsigned int                 e,
                   unsigned int                 top,
                   std::vector<Tensor<1, dim>> &c) const;
      void
      project_interior(const Field                 &field,
                       unsigned int                 top,
                       std::vector<Tensor<1, dim>> &c) const;

      const TraceBasis                &basis;
      QGauss<1>                        line_rule;
      std::vector<std::vector<double>> line_values;  ///< [point][function]
      std::vector<FullMatrix<double>>  line_inverse; ///< [degree]
      Quadrature<2>                    face_rule;
      std::vector<std::vector<double>> face_values; ///< [point][function]
      /// By degree: functions inside and the inverse of their mass matrix.
      std::vector<std::vector<unsigned int>> inside;
      std::vector<FullMatrix<double>>        face_inverse;
    };

    FaceInterpolation::FaceInterpolation(const TraceBasis &basis)
      : basis(basis)
      , line_rule(basis.degree + 2)
      , face_rule(basis.shape == FaceShape::triangle ?
                    simplex_quadrature<2>(2 * basis.degree + 2) :
                    Quadrature<2>(QGauss<2>(basis.degree + 2)))
      , inside(basis.degree + 1)
    {
      for (const Point<1> &point : line_rule.get_points())
        {
          line_values.emplace_back(basis.degree + 1);
          evaluate_lobatto(basis.degree, point[0], line_values.back().data());
        }
      for (const Point<2> &point : face_rule.get_points())
        {
          face_values.emplace_back(basis.size());
          basis.evaluate(point[0], point[1], face_values.back().data());
        }
      std::vector<unsigned int> bubbles;
      for (unsigned int top = 0; top <= basis.degree; ++top)
        {
          for (unsigned int k = 0; k < basis.size(); ++k)
            if (basis.functions[k].dimension == 2 &&
                basis.functions[k].degree <= top)
              inside[top].push_back(k);
          if (top >= 2)
            bubbles.push_back(top);
          line_inverse.push_back(
            inverse_mass(line_values, line_rule.get_weights(), bubbles));
          face_inverse.push_back(
            inverse_mass(face_values, face_rule.get_weights(), inside[top]));
        }
    }

    std::vector<Tensor<1, dim>>
    FaceInterpolation::operator()(
      const Field                       &field,
      const std::array<unsigned int, 4> &edge_degree,
      const unsigned int                 face_degree) const
    {
      std::vector<Tensor<1, dim>> c(basis.size());
      for (unsigned int e = 0; e < basis.n_edges(); ++e)
        for (unsigned int end = 0; end < 2; ++end)
          {
            const auto [xi_1, xi_2] = basis.edge_point(e, end);
            c[basis.vertex_function(basis.edge_vertices(e)[end])] =
              field(xi_1, xi_2);
          }
      for (unsigned int e = 0; e < basis.n_edges(); ++e)
        project_edge(field, e, edge_degree[e], c);
      project_interior(field, face_degree, c);
      return c;
    }

    void
    FaceInterpolation::project_edge(const Field                 &field,
                                    const unsigned int           e,
                                    const unsigned int           top,
                                    std::vector<Tensor<1, dim>> &c) const
    {
      const auto                  ends = basis.edge_vertices(e);
      std::vector<Tensor<1, dim>> moment(top + 1);
      for (unsigned int q = 0; q < line_rule.size(); ++q)
        {
          const double t          = line_rule.point(q)[0];
          const auto [xi_1, xi_2] = basis.edge_point(e, t);
          const Tensor<1, dim> rest =
            field(xi_1, xi_2) - (1. - t) * c[basis.vertex_function(ends[0])] -
            t * c[basis.vertex_function(ends[1])];
          for (unsigned int k = 2; k <= top; ++k)
            moment[k] += line_rule.weight(q) * line_values[q][k] * rest;
        }
      for (unsigned int k = 0; k < basis.size(); ++k)
        {
          const TraceBasis::Function &f = basis.functions[k];
          if (f.dimension == 1 && f.entity == e && f.degree <= top)
            for (unsigned int l = 2; l <= top; ++l)
              c[k] += line_inverse[top](f.degree - 2, l - 2) * moment[l];
        }
    }

    void
    FaceInterpolation::project_interior(const Field                 &field,
                                        const unsigned int           top,
                                        std::vector<Tensor<1, dim>> &c) const
    {
      const std::vector<unsigned int> &used = inside[top];
      if (used.empty())
        return;
      std::vector<Tensor<1, dim>> moment(used.size());
      for (unsigned int q = 0; q < face_rule.size(); ++q)
        {
          Tensor<1, dim> rest =
            field(face_rule.point(q)[0], face_rule.point(q)[1]);
          for (unsigned int k = 0; k < basis.size(); ++k)
            if (basis.functions[k].dimension < 2)
              rest -= face_values[q][k] * c[k];
          for (unsigned int i = 0; i < used.size(); ++i)
            moment[i] += face_rule.weight(q) * face_values[q][used[i]] * rest;
        }
      for (unsigned int i = 0; i < used.size(); ++i)
        for (unsigned int j = 0; j < used.size(); ++j)
          c[used[i]] += face_inverse[top](i, j) * moment[j];
    }

    bool
    is_on(const Point<dim> &x, const Segment &segment, const double tolerance)
    {
      const Tensor<1, dim> along  = segment[1] - segment[0];
      const double         square = along.norm_square();
      const double part = square > 0. ? (x - segment[0]) * along / square : 0.;
      return x.distance(segment[0] +
                        std::min(1., std::max(0., part)) * along) <= tolerance;
    }

    /// Does @p condition prescribe the coefficient of @p function of the trace on @p face?
    bool
    prescribes(const DirichletCondition   &condition,
               const Body::CellIterator   &cell,
               const CellFace             &face,
               const TraceBasis::Function &function)
    {
      const auto at = [&](const unsigned int v) {
        return prescribes_vertex(condition, cell, face.vertices[v]);
      };
      if (function.dimension == 0)
        return at(function.entity);
      if (function.dimension == 2)
        return !condition.segment;
      const auto ends = face.basis->edge_vertices(function.entity);
      return at(ends[0]) && at(ends[1]);
    }

    void
    constrain_face(const Body                &body,
                   const BoundaryFace        &at,
                   const DirichletCondition  &condition,
                   const FaceInterpolation   &interpolation,
                   AffineConstraints<double> &constraints)
    {
      const auto &[cell, f] = at;
      const CellFace              face(cell, f);
      std::array<unsigned int, 4> edge_degree{};
      for (unsigned int e = 0; e < face.basis->n_edges(); ++e)
        edge_degree[e] = body.degrees->line_degree(cell, face.lines[e]);

      const auto field = [&](const double xi_1, const double xi_2) {
        return !condition.value ?
                 Tensor<1, dim>() :
                 condition.value(body.mapping->transform_unit_to_real_cell(
                   cell, face.unit_point(xi_1, xi_2)));
      };
      const std::vector<Tensor<1, dim>> coefficients =
        interpolation(field, edge_degree, body.degrees->quad_degree(cell, f));

      // where degrees meet, the dof that carries a mode may belong to a cell
      // off the boundary
      std::vector<types::global_dof_index> dofs;
      body.degrees->get_master_dofs(cell, dofs);
      for (unsigned int k = 0; k < face.indices.size(); ++k)
        for (unsigned int c = 0;
             c < dim &&
             prescribes(condition, cell, face, face.basis->functions[k]);
             ++c)
          {
            const auto dof =
              dofs[cell->get_fe().component_to_system_index(c,
                                                            face.indices[k])];
            if (condition.fixed[c] && dof != numbers::invalid_dof_index &&
                !constraints.is_constrained(dof))
              {
                constraints.add_line(dof);
                constraints.set_inhomogeneity(dof, coefficients[k][c]);
              }
          }
    }
  } // namespace

  bool
  prescribes_vertex(const DirichletCondition &condition,
                    const Body::CellIterator &cell,
                    const unsigned int        v)
  {
    constexpr double tolerance = 1e-6;
    return !condition.segment || is_on(cell->vertex(v),
                                       *condition.segment,
                                       tolerance * cell->diameter());
  }

  std::vector<BoundaryFace>
  faces_of(const Body &body, const DirichletCondition &condition)
  {
    if (!condition.segment)
      return boundary_faces(body, condition.boundary);
    std::vector<BoundaryFace> result =
      boundary_faces(body, body.triangulation().get_boundary_ids());
    const auto is_off = [&](const BoundaryFace &face) {
      const auto vertices = CellFace(face.cell, face.number).vertices;
      return std::none_of(vertices.begin(),
                          vertices.begin() +
                            face.cell->face(face.number)->n_vertices(),
                          [&](const unsigned int v) {
                            return prescribes_vertex(condition, face.cell, v);
                          });
    };
    result.erase(std::remove_if(result.begin(), result.end(), is_off),
                 result.end());
    return result;
  }

  void
  add_dirichlet_constraints(const Body                            &body,
                            const std::vector<DirichletCondition> &conditions,
                            AffineConstraints<double>             &constraints)
  {
    if (conditions.empty())
      return;
    std::map<const TraceBasis *, FaceInterpolation> interpolations;
    for (const DirichletCondition &condition : conditions)
      for (const BoundaryFace &face : faces_of(body, condition))
        {
          const TraceBasis &basis =
            trace_basis(body.mesh.tetrahedra ? FaceShape::triangle :
                                               FaceShape::quadrilateral,
                        body.degree(face.cell));
          const auto interpolation =
            interpolations.try_emplace(&basis, basis).first;
          constrain_face(
            body, face, condition, interpolation->second, constraints);
        }
    complete_constraints(body.dof_handler, constraints);
  }
} // namespace mortise
