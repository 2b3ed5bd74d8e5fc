#include <deal.II/base/quadrature_lib.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/body/boundary_conditions.h>
#include <mortise/body/boundary_faces.h>
#include <mortise/body/face_topology.h>
#include <mortise/body/fe_legendre.h>
#include <mortise/body/legendre_basis.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Values of the 1D functions of one degree at Gauss points, and the
    /// inverse of the L2 mass matrices of the bubbles 2..q for every q.
    struct LineProjection
    {
      explicit LineProjection(const unsigned int degree)
        : degree(degree)
        , gauss(degree + 2)
        , value(gauss.size(), std::vector<double>(degree + 1))
        , inverse_mass(degree + 1)
      {
        for (unsigned int q = 0; q < gauss.size(); ++q)
          evaluate_lobatto(
            degree, gauss.point(q)[0], value[q].data(), nullptr, nullptr);
        for (unsigned int top = 2; top <= degree; ++top)
          {
            FullMatrix<double> mass(top - 1);
            for (unsigned int q = 0; q < gauss.size(); ++q)
              for (unsigned int i = 2; i <= top; ++i)
                for (unsigned int j = 2; j <= top; ++j)
                  mass(i - 2, j - 2) +=
                    gauss.weight(q) * value[q][i] * value[q][j];
            inverse_mass[top].reinit(top - 1, top - 1);
            inverse_mass[top].invert(mass);
          }
      }

      unsigned int                     degree;
      QGauss<1>                        gauss;
      std::vector<std::vector<double>> value;        ///< [point][function]
      std::vector<FullMatrix<double>>  inverse_mass; ///< [q], (q - 1) x (q - 1)
    };

    /// Interpolates one vector field on one face; coefficients in the tensor
    /// order of the face.
    class FaceInterpolation
    {
    public:
      FaceInterpolation(const LineProjection &line)
        : line(line)
        , n(line.degree + 1)
      {}

      using Field = std::function<Tensor<1, dim>(double xi, double eta)>;

      /// @p edge_degree[a][side], @p face_degree: highest modes that exist.
      std::vector<Tensor<1, dim>>
      operator()(const Field &field,
                 const unsigned int (&edge_degree)[2][2],
                 const unsigned int face_degree) const
      {
        std::vector<Tensor<1, dim>> c(n * n);
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
            c[i + n * j] = field(i, j);
        for (unsigned int a = 0; a < 2; ++a)
          for (unsigned int side = 0; side < 2; ++side)
            project_edge(field, a, side, edge_degree[a][side], c);
        project_interior(field, face_degree, c);
        return c;
      }

    private:
      void
      project_edge(const Field                 &field,
                   const unsigned int           a,
                   const unsigned int           side,
                   const unsigned int           top,
                   std::vector<Tensor<1, dim>> &c) const
      {
        const auto position = [&](const unsigned int k) {
          return a == 0 ? k + n * side : side + n * k;
        };
        std::vector<Tensor<1, dim>> moment(top + 1);
        for (unsigned int q = 0; q < line.gauss.size(); ++q)
          {
            const double         t = line.gauss.point(q)[0];
            const Tensor<1, dim> rest =
              (a == 0 ? field(t, side) : field(side, t)) -
              (1. - t) * c[position(0)] - t * c[position(1)];
            for (unsigned int k = 2; k <= top; ++k)
              moment[k] += line.gauss.weight(q) * line.value[q][k] * rest;
          }
        for (unsigned int k = 2; k <= top; ++k)
          for (unsigned int l = 2; l <= top; ++l)
            c[position(k)] += line.inverse_mass[top](k - 2, l - 2) * moment[l];
      }

      void
      project_interior(const Field                 &field,
                       const unsigned int           top,
                       std::vector<Tensor<1, dim>> &c) const
      {
        if (top < 2)
          return;
        std::vector<Tensor<1, dim>> moment(n * n);
        const unsigned int          n_points = line.gauss.size();
        for (unsigned int qy = 0; qy < n_points; ++qy)
          for (unsigned int qx = 0; qx < n_points; ++qx)
            {
              const auto    &vx = line.value[qx], &vy = line.value[qy];
              Tensor<1, dim> rest =
                field(line.gauss.point(qx)[0], line.gauss.point(qy)[0]);
              for (unsigned int j = 0; j < n; ++j)
                for (unsigned int i = 0; i < n; ++i)
                  if (i < 2 || j < 2)
                    rest -= vx[i] * vy[j] * c[i + n * j];
              rest *= line.gauss.weight(qx) * line.gauss.weight(qy);
              for (unsigned int j = 2; j <= top; ++j)
                for (unsigned int i = 2; i <= top; ++i)
                  moment[i + n * j] += vx[i] * vy[j] * rest;
            }
        // the inverse of the mass matrix is the product of those of its two
        // directions
        std::vector<Tensor<1, dim>> half(n * n);
        const auto                 &inverse = line.inverse_mass[top];
        for (unsigned int j = 2; j <= top; ++j)
          for (unsigned int i = 2; i <= top; ++i)
            for (unsigned int k = 2; k <= top; ++k)
              half[i + n * j] += inverse(i - 2, k - 2) * moment[k + n * j];
        for (unsigned int j = 2; j <= top; ++j)
          for (unsigned int i = 2; i <= top; ++i)
            for (unsigned int k = 2; k <= top; ++k)
              c[i + n * j] += inverse(j - 2, k - 2) * half[i + n * k];
      }

      const LineProjection &line;
      const unsigned int    n;
    };

    void
    constrain_face(const Body                &body,
                   const Body::CellIterator  &cell,
                   const unsigned int         f,
                   const DirichletCondition  &condition,
                   const LineProjection      &line,
                   AffineConstraints<double> &constraints)
    {
      const unsigned int p = body.degree(cell), n = p + 1;
      unsigned int       edge_degree[2][2];
      for (unsigned int a = 0; a < 2; ++a)
        for (unsigned int side = 0; side < 2; ++side)
          edge_degree[a][side] =
            body.degrees->line_degree(cell, face_topology::line(f, a, side));

      const auto field = [&](const double xi, const double eta) {
        return !condition.value ?
                 Tensor<1, dim>() :
                 condition.value(body.mapping->transform_unit_to_real_cell(
                   cell, face_topology::unit_point(f, xi, eta)));
      };
      const std::vector<Tensor<1, dim>> coefficients = FaceInterpolation(
        line)(field, edge_degree, body.degrees->quad_degree(cell, f));

      // where degrees meet, the dof that carries a mode may belong to a cell
      // off the boundary
      std::vector<types::global_dof_index> dofs;
      body.degrees->get_master_dofs(cell, dofs);
      const std::vector<unsigned int> on_face = face_dof_indices(p, f);
      for (unsigned int k = 0; k < n * n; ++k)
        for (unsigned int c = 0; c < dim; ++c)
          {
            const auto dof =
              dofs[cell->get_fe().component_to_system_index(c, on_face[k])];
            if (condition.fixed[c] && dof != numbers::invalid_dof_index &&
                !constraints.is_constrained(dof))
              {
                constraints.add_line(dof);
                constraints.set_inhomogeneity(dof, coefficients[k][c]);
              }
          }
    }
  } // namespace

  void
  add_dirichlet_constraints(const Body                            &body,
                            const std::vector<DirichletCondition> &conditions,
                            AffineConstraints<double>             &constraints)
  {
    if (conditions.empty())
      return;
    std::map<unsigned int, LineProjection> lines;
    for (const DirichletCondition &condition : conditions)
      for (const auto &[cell, f] : boundary_faces(body, condition.boundary))
        {
          const unsigned int p    = body.degree(cell);
          const auto         line = lines.try_emplace(p, p).first;
          constrain_face(body, cell, f, condition, line->second, constraints);
        }
    complete_constraints(body.dof_handler, constraints);
  }
} // namespace mortise
