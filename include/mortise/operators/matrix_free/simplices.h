// The shape of tetrahedra for kernels, see kernel_on.h: dense matrices of the
// reference cell between nodes and points, or sum factorisation where curved
// cells have many points. Affine cells have coefficients in an orthonormal
// basis in place of values at points.
#pragma once

#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/operators/matrix_free/collapsed_kernel.h>
#include <mortise/operators/matrix_free/dense_kernel.h>
#include <mortise/operators/matrix_free/kernel_on.h>
#include <mortise/operators/matrix_free/simplex_tables.h>

#include <algorithm>
#include <memory>

namespace mortise
{
  /// Values at points from those at nodes, and the transpose.
  template <typename Number, int n_components>
  class DenseMap
  {
  public:
    using V = typename Batch<Number>::Vector;

    DenseMap() = default;

    /// @p values: row by point.
    explicit DenseMap(const dealii::FullMatrix<double> &values)
      : up(values)
      , down(transposed(values))
    {}

    void
    evaluate(const V *at_nodes, V *at_points) const
    {
      up.template apply<n_components>(at_nodes, at_points);
    }

    void
    integrate(const V *at_points, V *at_nodes) const
    {
      down.template apply<n_components>(at_points, at_nodes);
    }

  private:
    DenseMatrix<Number> up, down;
  };

  template <typename Number, int degree>
  class Simplices
  {
  public:
    using V = typename Batch<Number>::Vector;
    static constexpr int n_nodes =
      (degree + 1) * (degree + 2) * (degree + 3) / 6;
    /// Number of coefficients of gradients on affine cells.
    static constexpr int n_coefficients =
      degree * (degree + 1) * (degree + 2) / 6;

    explicit Simplices(const CellBatches<Number> &cells)
      : n_curved(cells.n_points)
      , on_affine(gradient_coefficients(degree))
      , has_affine(cells.n_affine > 0)
    {
      if (cells.n_batches == cells.n_affine)
        return;
      if constexpr (degree < sum_factorised_from)
        on_curved =
          std::make_unique<Curved>(gradients_on_curved<Number>(degree));
      else
        on_curved = std::make_unique<Curved>();
      const dealii::Quadrature<dim> rule = simplex_rule<Number>(degree);
      for (unsigned int q = 0; q < rule.size(); ++q)
        scale.push_back(
          std::fabs(determinant(simplex_rule_jacobian(degree, rule.point(q)))) /
          rule.weight(q));
    }

    unsigned int
    max_points() const
    {
      return std::max<unsigned int>(n_coefficients, n_curved);
    }

    template <bool affine>
    int
    n_points(std::bool_constant<affine>) const
    {
      return affine ? n_coefficients : n_curved;
    }

    void
    evaluate(const bool affine, const V *u, V *g)
    {
      affine ? on_affine.evaluate(u, g) : on_curved->evaluate(u, g);
    }

    void
    integrate(const bool affine, const V *g, V *u)
    {
      affine ? on_affine.integrate(g, u) : on_curved->integrate(g, u);
    }

    template <bool affine>
    inline __attribute__((always_inline)) void
    get_metric(std::bool_constant<affine>,
               const V  *metric,
               const int q,
               V (&G)[dim][dim]) const
    {
      if (affine && q > 0)
        return;
      metric += affine ? 0 : q * dim * dim;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int e = 0; e < dim; ++e)
          G[a][e] = metric[dim * a + e];
      if (!affine)
        fetch(metric + n_curved * dim * dim, dim * dim);
    }

    /// det(G) is less than zero where vertices ascend the other way round.
    V
    root(const bool affine, const V (&G)[dim][dim], const int q) const
    {
      const V det = determinant_of(G);
      return (affine ? Number(1) : scale[q]) * (det < 0 ? -det : det);
    }

    class Squares
    {
    public:
      explicit Squares(const Simplices &shape)
      {
        if (shape.has_affine)
          on_affine =
            DenseMatrix<Number>(squares(gradient_coefficients(degree)));
        if (shape.on_curved)
          on_curved =
            DenseMatrix<Number>(squares(gradients_on_curved<Number>(degree)));
      }

      void
      apply(const bool affine, const V *a, V *u) const
      {
        (affine ? on_affine : on_curved).apply(a, u);
      }

    private:
      /// dN_k/dxi_i dN_k/dxi_j: row k, column ((i, j), point).
      static dealii::FullMatrix<double>
      squares(const dealii::FullMatrix<double> &gradients)
      {
        const unsigned int         n = gradients.m() / dim;
        dealii::FullMatrix<double> result(n_nodes, dim * (dim + 1) / 2 * n);
        unsigned int               column = 0;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            for (unsigned int q = 0; q < n; ++q, ++column)
              for (int k = 0; k < n_nodes; ++k)
                result(k, column) =
                  gradients(i * n + q, k) * gradients(j * n + q, k);
        return result;
      }

      DenseMatrix<Number> on_affine, on_curved;
    };

  private:
    using Curved = std::conditional_t<(degree < sum_factorised_from),
                                      DenseMap<Number, dim>,
                                      CollapsedKernel<Number, degree>>;

    const int               n_curved;
    DenseMap<Number, dim>   on_affine;
    const bool              has_affine;
    std::unique_ptr<Curved> on_curved; ///< where there are such cells
    /// By point of these, sqrt(w |J|) over the determinant of the metric.
    std::vector<Number> scale;
  };

  template <typename Number, int degree>
  class SimplexPressures
  {
  public:
    using V                      = typename Batch<Number>::Vector;
    static constexpr int n_nodes = Simplices<Number, degree>::n_coefficients;
    const unsigned int   room;

    explicit SimplexPressures(const CellBatches<Number> &cells)
      : room(std::max<unsigned int>(n_nodes, cells.n_points))
    {
      set(true, pressure_coefficients(degree));
      if (cells.n_batches > cells.n_affine)
        set(false,
            simplex_nodal_values(degree - 1,
                                 simplex_rule<Number>(degree).get_points()));
    }

    void
    to_points(const bool affine, const V *at_nodes, V *at_points) const
    {
      maps[affine].evaluate(at_nodes, at_points);
    }

    void
    from_points(const bool affine, const V *at_points, V *at_nodes) const
    {
      maps[affine].integrate(at_points, at_nodes);
    }

    void
    squares(const bool affine, const V *at_points, V *at_nodes) const
    {
      all_squares[affine].template apply<1>(at_points, at_nodes);
    }

  private:
    /// @p values: entry (point, node).
    void
    set(const bool affine, const dealii::FullMatrix<double> &values)
    {
      maps[affine] = DenseMap<Number, 1>(values);
      dealii::FullMatrix<double> squared(transposed(values));
      for (auto &entry : squared)
        entry.value() = entry.value() * entry.value();
      all_squares[affine] = DenseMatrix<Number>(squared);
    }

    DenseMap<Number, 1> maps[2]; ///< on curved cells, on affine ones
    DenseMatrix<Number> all_squares[2];
  };
} // namespace mortise
