// The hierarchical functions of one direction at the points of a rule.
#pragma once

#include <deal.II/base/quadrature.h>

#include <mortise/base/tensor_product.h>
#include <mortise/body/elements/legendre_basis.h>

#include <vector>

namespace mortise
{
  /// Columns in the order of evaluate_lobatto().
  inline LineTable
  lobatto_table(const unsigned int degree, const dealii::Quadrature<1> &points)
  {
    const unsigned int  n = degree + 1;
    LineTable           table{dealii::FullMatrix<double>(points.size(), n),
                    dealii::FullMatrix<double>(points.size(), n)};
    std::vector<double> values(n), slopes(n);
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        evaluate_lobatto(degree,
                         points.point(q)[0],
                         values.data(),
                         slopes.data());
        for (unsigned int k = 0; k < n; ++k)
          {
            table.values(q, k) = values[k];
            table.slopes(q, k) = slopes[k];
          }
      }
    return table;
  }
} // namespace mortise
