// Anderson's acceleration of a fixed-point iteration. Source: Walker, Ni
// (2011).
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace mortise
{
  /// The weights w, of sum one, by which the results of the last iterations
  /// make the next argument: those with the least |sum_i w_i f_i|, f_i the
  /// differences of result and argument. @p products: f_i . f_j, the newest
  /// last.
  std::vector<double>
  anderson_weights(const dealii::FullMatrix<double> &products);
} // namespace mortise
