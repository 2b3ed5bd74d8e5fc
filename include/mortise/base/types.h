// The types of the program: the one place that names the linear algebra
// backend.
#pragma once

#include <deal.II/base/types.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>

namespace mortise
{
  /// Space dimension; the program is written for three.
  constexpr unsigned int dim = 3;

  /// Smallest and largest polynomial degree of an element.
  constexpr unsigned int min_degree = 1;
  constexpr unsigned int max_degree = 8;

  using SparseMatrix = dealii::TrilinosWrappers::SparseMatrix;
  using Vector       = dealii::TrilinosWrappers::MPI::Vector;

  /// Triangulation of one hexahedral body, distributed by p4est.
  using HexTriangulation = dealii::parallel::distributed::Triangulation<dim>;
} // namespace mortise
