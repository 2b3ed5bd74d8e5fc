// Polynomials as fields of a body, in the coefficients of its elements.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/operators/scene_solution.h>
#include <mortise/output/lagrange_cells.h>

#include <cmath>
#include <functional>
#include <map>

namespace mortise::testing
{
  using namespace dealii;

  /// Component c: (b_c + a_c x)^p.
  struct Polynomial
  {
    unsigned int p;

    Tensor<1, dim>
    slope(const unsigned int c) const
    {
      return Point<dim>(0.4 - 0.2 * c, 0.2 + 0.2 * c, 0.3 - 0.4 * (c == 1));
    }

    double
    base(const unsigned int c, const Point<dim> &x) const
    {
      return 0.5 + 0.1 * c + slope(c) * x;
    }

    Tensor<1, dim>
    operator()(const Point<dim> &x) const
    {
      Tensor<1, dim> value;
      for (unsigned int c = 0; c < dim; ++c)
        value[c] = std::pow(base(c, x), p);
      return value;
    }

    Tensor<2, dim>
    gradient(const Point<dim> &x) const
    {
      Tensor<2, dim> result;
      for (unsigned int c = 0; c < dim; ++c)
        result[c] = p * std::pow(base(c, x), p - 1) * slope(c);
      return result;
    }
  };

  /// Coefficients of @p function, component by component of the elements;
  /// exact where they hold it.
  inline BodyVector
  interpolate(
    const Body                                                    &body,
    const DoFHandler<dim>                                         &handler,
    const IndexSet                                                &relevant,
    const std::function<double(unsigned int, const Point<dim> &)> &function)
  {
    BodyVector vector(handler.locally_owned_dofs(),
                      relevant,
                      body.triangulation().get_communicator());
    std::map<unsigned int,
             std::pair<std::vector<Point<dim>>, FullMatrix<double>>>
                                         rules;
    std::vector<types::global_dof_index> dofs;
    for (const auto &cell : handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto        &fe     = cell->get_fe();
          const auto        &scalar = fe.base_element(0);
          const unsigned int n = scalar.n_dofs_per_cell(), p = scalar.degree;
          auto &[points, inverse] = rules[cell->active_fe_index()];
          if (points.empty())
            {
              if (body.mesh.tetrahedra)
                for (const auto &node :
                     lagrange_nodes(LagrangeShape::tetrahedron, p))
                  points.emplace_back(double(node[0]) / p,
                                      double(node[1]) / p,
                                      double(node[2]) / p);
              else
                for (unsigned int i = 0; i < n; ++i)
                  points.emplace_back(double(i % (p + 1)) / p,
                                      double(i / (p + 1) % (p + 1)) / p,
                                      double(i / (p + 1) / (p + 1)) / p);
              inverse.reinit(n, n);
              for (unsigned int q = 0; q < n; ++q)
                for (unsigned int i = 0; i < n; ++i)
                  inverse(q, i) = scalar.shape_value(i, points[q]);
              inverse.gauss_jordan();
            }
          dofs.resize(fe.n_dofs_per_cell());
          cell->get_dof_indices(dofs);
          dealii::Vector<double> values(n), coefficients(n);
          for (unsigned int c = 0; c < fe.n_components(); ++c)
            {
              for (unsigned int q = 0; q < n; ++q)
                values(q) =
                  function(c,
                           body.mapping->transform_unit_to_real_cell(
                             typename Triangulation<dim>::cell_iterator(cell),
                             points[q]));
              inverse.vmult(coefficients, values);
              for (unsigned int i = 0; i < dofs.size(); ++i)
                if (fe.system_to_component_index(i).first == c &&
                    vector.in_local_range(dofs[i]))
                  vector(dofs[i]) =
                    coefficients(fe.system_to_component_index(i).second);
            }
        }
    vector.update_ghost_values();
    return vector;
  }

  inline BodyVector
  interpolate(const Body &body, const Polynomial &u)
  {
    return interpolate(body,
                       body.dof_handler,
                       body.relevant_dofs,
                       [&](const unsigned int c, const Point<dim> &x) {
                         return u(x)[c];
                       });
  }
} // namespace mortise::testing
