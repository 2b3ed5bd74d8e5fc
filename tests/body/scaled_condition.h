// The measure of conditioning that the tests of elements share.
#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <cmath>

/// Largest over smallest eigenvalue above the kernel (the first @p n_kernel are left out) after
/// scaling the diagonal to one.
inline double
scaled_condition(const dealii::FullMatrix<double> &matrix,
                 const unsigned int                n_kernel)
{
  const unsigned int               n = matrix.m();
  dealii::LAPACKFullMatrix<double> scaled(n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      scaled(i, j) = matrix(i, j) / std::sqrt(matrix(i, i) * matrix(j, j));
  dealii::FullMatrix<double> vectors;
  dealii::Vector<double>     eigenvalues;
  scaled.compute_eigenvalues_symmetric(-1e300, 1e300, 0., eigenvalues, vectors);
  return eigenvalues(n - 1) / std::abs(eigenvalues(n_kernel));
}
