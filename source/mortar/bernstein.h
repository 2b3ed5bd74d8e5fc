// Bernstein polynomials on edges and faces; only sources of this room include
// it.
#pragma once

#include <deal.II/base/point.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/body/elements/trace_basis.h>

#include <array>
#include <map>
#include <vector>

#include "combinations.h"

namespace mortise
{
  /// binomial(n, k) a^k b^(n - k)
  double
  binomial_term(unsigned int n, unsigned int k, double a, double b);

  /// Bernstein coefficients of a polynomial on an edge from those of the
  /// functions of evaluate_lobatto(), and back.
  struct LineTransform
  {
    dealii::FullMatrix<double> to_bernstein, to_modes;
  };

  /// Made once for each degree.
  const LineTransform &
  line_transform(unsigned int degree);

  /// The coefficients of a polynomial on an edge become those of a higher
  /// degree.
  void
  elevate(std::vector<Combination> &coefficients, unsigned int degree);

  /// Places of the Bernstein coefficients of a face: quadrilaterals (i, j, 0),
  /// i first, triangles by barycentric coordinates.
  class BernsteinLattice
  {
  public:
    using MultiIndex = std::array<unsigned int, 3>;

    BernsteinLattice(FaceShape                          shape,
                     const std::array<unsigned int, 2> &degree);

    /// Coefficient @p k of edge @p e from its first end on.
    unsigned int
    on_edge(const TraceBasis &basis, unsigned int e, unsigned int k) const;

    bool
    is_inside(const MultiIndex &multi_index) const;

    /// The mean of the ruled surfaces between opposite, on triangles adjacent,
    /// edges at @p multi_index, in coefficients of edges: exact where these are
    /// linear.
    Combination
    mean_of_ruled(const MultiIndex               &multi_index,
                  const std::vector<Combination> &all) const;

    /// Values at the nodes of a face of @p basis (node, coefficient).
    dealii::FullMatrix<double>
    at_nodes(const TraceBasis &basis) const;

    std::vector<MultiIndex> multi_indices;

  private:
    bool
    is_triangle() const
    {
      return shape == FaceShape::triangle;
    }

    /// @p barycentric: of vertices 0, 1, 2.
    unsigned int
    of_barycentric(const MultiIndex &barycentric) const;
    /// Of the function at @p multi_index.
    double
    value(const MultiIndex &multi_index, const dealii::Point<2> &x) const;

    const FaceShape                                     shape;
    const std::array<unsigned int, 2>                   degree;
    std::map<std::array<unsigned int, 2>, unsigned int> numbers;
  };
} // namespace mortise
