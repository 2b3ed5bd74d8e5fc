// The types of the program: the one place that names the linear algebra
// backend.
#pragma once

#include <deal.II/base/types.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace mortise
{
  /// Space dimension; the program is written for three.
  constexpr unsigned int dim = 3;

  /// Smallest and largest polynomial degree of an element.
  constexpr unsigned int min_degree = 1;
  constexpr unsigned int max_degree = 8;

  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// Triangulation of one hexahedral body, distributed by p4est.
  using HexTriangulation = dealii::parallel::distributed::Triangulation<dim>;
} // namespace mortise
