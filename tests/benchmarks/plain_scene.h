// The thick sphere of prm/thick_sphere_conforming.prm for a plain program:
// mesh, space, Lame's solution.
#pragma once

#include <deal.II/base/symmetric_tensor.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <deal.II/grid/manifold.h>

#include <deal.II/lac/affine_constraints.h>

#include <cmath>
#include <map>

namespace plain
{
  using namespace dealii;

  constexpr double inner = 1., outer = 2., pressure = 1.;
  constexpr double young = 10., poisson = 0.3;
  constexpr double lame_lambda =
    young * poisson / ((1. + poisson) * (1. - 2. * poisson));
  constexpr double lame_mu = young / (2. * (1. + poisson));

  /// Averages radii and directions, as Mortise's sphere: the two programs are
  /// to have the same mapped cells.
  class Sphere : public Manifold<3>
  {
  public:
    std::unique_ptr<Manifold<3>>
    clone() const override
    {
      return std::make_unique<Sphere>();
    }

    Point<3>
    get_new_point(const ArrayView<const Point<3>> &points,
                  const ArrayView<const double>   &weights) const override
    {
      double       radius = 0.;
      Tensor<1, 3> direction;
      for (unsigned int i = 0; i < points.size(); ++i)
        {
          radius += weights[i] * points[i].norm();
          direction += weights[i] / points[i].norm() * points[i];
        }
      return Point<3>(radius / direction.norm() * direction);
    }
  };

  /// Lame's solution, u = (a + b / r^3) x.
  struct Exact
  {
    static constexpr double cubes =
      outer * outer * outer - inner * inner * inner;
    static constexpr double a =
      pressure * inner * inner * inner * (1. - 2. * poisson) / (young * cubes);
    static constexpr double b = pressure * inner * inner * inner * outer *
                                outer * outer * (1. + poisson) /
                                (2. * young * cubes);

    static Tensor<1, 3>
    displacement(const Point<3> &x)
    {
      return (a + b / std::pow(x.norm(), 3)) * x;
    }

    static SymmetricTensor<2, 3>
    strain(const Point<3> &x)
    {
      const double r = x.norm();
      return (a + b / std::pow(r, 3)) * unit_symmetric_tensor<3>() -
             3. * b / std::pow(r, 5) *
               symmetrize(outer_product(Tensor<1, 3>(x), Tensor<1, 3>(x)));
    }
  };

  /// A space of one degree with its constraints.
  struct Space
  {
    Space(const Triangulation<3> &triangulation, const unsigned int degree)
      : fe(FE_Q<3>(degree), 3)
      , dof_handler(triangulation)
    {
      dof_handler.distribute_dofs(fe);
      DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
      constraints.reinit(relevant);
      for (unsigned int c = 0; c < 3; ++c)
        {
          ComponentMask normal(3, false);
          normal.set(c, true);
          DoFTools::make_zero_boundary_constraints(dof_handler,
                                                   2 + c,
                                                   constraints,
                                                   normal);
        }
      constraints.close();
    }

    const FESystem<3>         fe;
    DoFHandler<3>             dof_handler;
    IndexSet                  relevant;
    AffineConstraints<double> constraints;
  };

  /// An octant of the surface of the cube [0, n]^3, projected, m layers.
  /// Boundaries: 0 inside, 1 outside, 2 + c the plane where x_c = 0.
  inline void
  make_mesh(parallel::distributed::Triangulation<3> &triangulation,
            const unsigned int                       n,
            const unsigned int                       m)
  {
    using Lattice = std::array<unsigned int, 3>;
    std::vector<Point<3>>           directions, vertices;
    std::map<Lattice, unsigned int> index;
    for (unsigned int k = 0; k <= n; ++k)
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
          if (const Lattice p = {{i, j, k}}; i == n || j == n || k == n)
            {
              Point<3> x;
              for (unsigned int d = 0; d < 3; ++d)
                x[d] = p[d] == n ? 1. : std::tan(0.25 * numbers::PI * p[d] / n);
              index[p] = directions.size();
              directions.push_back(x / x.norm());
            }
    for (unsigned int layer = 0; layer <= m; ++layer)
      for (const Point<3> &x : directions)
        vertices.push_back(x * (inner + (outer - inner) * layer / m));

    std::vector<CellData<3>> cells;
    for (unsigned int axis = 0; axis < 3; ++axis)
      for (unsigned int k = 0; k < m; ++k)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < n; ++i)
            {
              cells.emplace_back();
              for (unsigned int v = 0; v < 8; ++v)
                {
                  Lattice p;
                  p[axis]           = n;
                  p[(axis + 1) % 3] = i + v % 2;
                  p[(axis + 2) % 3] = j + v / 2 % 2;
                  cells.back().vertices[v] =
                    index.at(p) + directions.size() * (k + v / 4);
                }
            }
    triangulation.create_triangulation(vertices, cells, SubCellData());
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          {
            const auto all = [&](const auto &holds) {
              for (unsigned int v = 0; v < 4; ++v)
                if (!holds(face->vertex(v)))
                  return false;
              return true;
            };
            types::boundary_id id = 1;
            for (unsigned int c = 0; c < 3; ++c)
              if (all([c](const auto &x) { return std::abs(x[c]) < 1e-10; }))
                id = 2 + c;
            if (all([](const auto &x) { return x.norm() < inner + 1e-10; }))
              id = 0;
            face->set_boundary_id(id);
          }
    triangulation.set_all_manifold_ids(0);
    triangulation.set_manifold(0, Sphere());
  }
} // namespace plain
