// Integrals over the Lagrange cells of surfaces that a VTU file holds, by what
// VTK says of them alone.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/tensor.h>

#include <cmath>
#include <limits>

#include "vtk_nodes.h"
#include "vtu_content.h"

namespace mortise::testing
{
  using VtuContent = VtuPieces<dealii::Point<3>>;

  /// Volume or area of a cell by its corners: parallelepipeds and simplices.
  inline double
  size_of(const VtuContent &file, const unsigned int cell)
  {
    const auto edge = [&](const unsigned int v) {
      return file.points[file.cells[cell].at(v)] -
             file.points[file.cells[cell][0]];
    };
    switch (file.types[cell])
      {
        case 5:
        case 69:
          return dealii::cross_product_3d(edge(1), edge(2)).norm() / 2.;
        case 9:
        case 70:
          return dealii::cross_product_3d(edge(1), edge(3)).norm();
        case 10:
        case 71:
          return std::fabs(dealii::cross_product_3d(edge(1), edge(2)) *
                           edge(3)) /
                 6.;
        case 12:
        case 72:
          return dealii::cross_product_3d(edge(1), edge(3)) * edge(4);
        default:
          return std::numeric_limits<double>::quiet_NaN();
      }
  }

  /// prod_k (n t - k) / (k + 1) over k < m: one at t = m / n, zero at smaller k
  /// / n; and its slope.
  inline std::array<double, 2>
  rising_product(const unsigned int n, const unsigned int m, const double t)
  {
    std::array<double, 2> result = {{1., 0.}};
    for (unsigned int k = 0; k < m; ++k)
      {
        const double factor = (n * t - k) / (k + 1.), slope = n / (k + 1.);
        result[1] = result[1] * factor + result[0] * slope;
        result[0] *= factor;
      }
    return result;
  }

  /// Value and slopes at @p xi of the function of a node of a triangle (or of a square) of degree @p n.
  inline std::array<double, 3>
  lagrange_function(const bool                         triangle,
                    const unsigned int                 n,
                    const std::array<unsigned int, 3> &node,
                    const dealii::Point<2>            &xi)
  {
    if (triangle)
      {
        const auto a = rising_product(n, node[0], xi[0]),
                   b = rising_product(n, node[1], xi[1]),
                   c = rising_product(n,
                                      n - node[0] - node[1],
                                      1. - xi[0] - xi[1]);
        return {{a[0] * b[0] * c[0],
                 a[1] * b[0] * c[0] - a[0] * b[0] * c[1],
                 a[0] * b[1] * c[0] - a[0] * b[0] * c[1]}};
      }
    std::array<std::array<double, 2>, 2> line;
    for (unsigned int d = 0; d < 2; ++d)
      {
        const auto up   = rising_product(n, node[d], xi[d]),
                   down = rising_product(n, n - node[d], 1. - xi[d]);
        line[d] = {{up[0] * down[0], up[1] * down[0] - up[0] * down[1]}};
      }
    return {{line[0][0] * line[1][0],
             line[0][1] * line[1][0],
             line[0][0] * line[1][1]}};
  }

  /// Calls @p visit(cell, values of its nodes' functions, position, area) at points of all cells.
  template <typename Visit>
  void
  for_each_surface_point(const VtuContent &file, const Visit &visit)
  {
    constexpr unsigned int  n_gauss = 20;
    const dealii::QGauss<2> gauss(n_gauss);
    for (unsigned int cell = 0; cell < file.cells.size(); ++cell)
      {
        const auto        &points   = file.cells[cell];
        const unsigned int type     = file.types[cell];
        const bool         triangle = type == 5 || type == 69;
        unsigned int       n        = 1;
        while ((triangle ? (n + 1) * (n + 2) / 2 : (n + 1) * (n + 1)) <
               points.size())
          ++n;
        const auto nodes =
          n > 1    ? vtk_nodes(type, n) :
          triangle ? std::vector<std::array<unsigned int, 3>>{{{0, 0, 0}},
                                                              {{1, 0, 0}},
                                                              {{0, 1, 0}}} :
                     std::vector<std::array<unsigned int, 3>>{{{0, 0, 0}},
                                                              {{1, 0, 0}},
                                                              {{1, 1, 0}},
                                                              {{0, 1, 0}}};
        for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            dealii::Point<2> xi     = gauss.point(q);
            double           weight = gauss.weight(q);
            if (triangle)
              {
                weight *= 1. - xi[1];
                xi[0] *= 1. - xi[1];
              }
            std::vector<double>                 values;
            dealii::Point<3>                    x;
            std::array<dealii::Tensor<1, 3>, 2> slope;
            for (unsigned int i = 0; i < nodes.size(); ++i)
              {
                const auto f = lagrange_function(triangle, n, nodes[i], xi);
                values.push_back(f[0]);
                x += f[0] * file.points[points[i]];
                for (unsigned int d = 0; d < 2; ++d)
                  slope[d] += f[d + 1] * file.points[points[i]];
              }
            visit(cell,
                  values,
                  x,
                  weight * dealii::cross_product_3d(slope[0], slope[1]).norm());
          }
      }
  }

  struct SurfaceIntegrals
  {
    double               area = 0.; ///< of all cells
    dealii::Tensor<1, 3> force, moment;
    unsigned int         n_without = 0; ///< cells where it is no number
  };

  /// Of a vector field; cells where it is no number count as zero.
  inline SurfaceIntegrals
  surface_integrals(const VtuContent &file, const std::string &name)
  {
    SurfaceIntegrals result;
    const auto      &field     = file.data.at(name);
    const auto       is_number = [&](const unsigned int cell) {
      return !std::isnan(field[file.cells[cell][0]][0]);
    };
    for (unsigned int cell = 0; cell < file.cells.size(); ++cell)
      result.n_without += is_number(cell) ? 0 : 1;
    for_each_surface_point(
      file,
      [&](const unsigned int         cell,
          const std::vector<double> &values,
          const dealii::Point<3>    &x,
          const double               area) {
        result.area += area;
        dealii::Tensor<1, 3> t;
        for (unsigned int i = 0; i < values.size() && is_number(cell); ++i)
          for (unsigned int c = 0; c < 3; ++c)
            t[c] += values[i] * field[file.cells[cell][i]][c];
        result.force += area * t;
        result.moment += area * dealii::cross_product_3d(x, t);
      });
    return result;
  }
} // namespace mortise::testing
