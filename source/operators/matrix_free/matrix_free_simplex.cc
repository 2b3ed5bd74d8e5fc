// The kernels behind MatrixFreeElasticity on tetrahedra: dense matrices of the
// reference cell between nodes and points, or sum factorisation where curved
// cells have many points.
#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/matrix_free/collapsed_kernel.h>
#include <mortise/operators/matrix_free/dense_kernel.h>
#include <mortise/operators/matrix_free/matrix_free_kernel.h>
#include <mortise/operators/matrix_free/node_access.h>
#include <mortise/operators/matrix_free/point_kernel.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// What @p make returns, made once for each degree.
    template <typename Make>
    const FullMatrix<double> &
    made_once(const unsigned int degree, const Make &make)
    {
      static std::mutex                                 mutex;
      static std::map<unsigned int, FullMatrix<double>> made;
      const std::lock_guard<std::mutex>                 lock(mutex);
      const auto found = made.find(degree);
      return found != made.end() ? found->second :
                                   made.emplace(degree, make()).first->second;
    }

    /// Gradients of the nodal functions, row (axis, coefficient), as
    /// coefficients in an orthonormal basis of the polynomials of degree - 1 on
    /// the reference cell, whose sums of products are integrals: fewer than the
    /// points of a rule.
    const FullMatrix<double> &
    gradient_coefficients(const unsigned int degree)
    {
      return made_once(degree, [&] {
        // f . M g = (L^T f) . (L^T g) for values f, g at nodes, M = L L^T
        const std::vector<Point<dim>> nodes =
          degree == 1 ? std::vector<Point<dim>>(1) : simplex_nodes(degree - 1);
        const Quadrature<dim> rule = simplex_quadrature<dim>(2 * degree - 2);
        const unsigned int    n    = nodes.size();
        FullMatrix<double>    values(rule.size(), n), mass(n), factor(n),
          result(dim * n, simplex_nodes(degree).size());
        if (degree == 1)
          values = FullMatrix<double>(IdentityMatrix(1));
        else
          values = simplex_nodal_values(degree - 1, rule.get_points());
        for (unsigned int q = 0; q < rule.size(); ++q)
          for (unsigned int i = 0; i < n; ++i)
            values(q, i) *= std::sqrt(rule.weight(q));
        values.Tmmult(mass, values);
        factor.cholesky(mass);
        const FullMatrix<double> gradients =
          simplex_nodal_gradients(degree, nodes);
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = i; j < n; ++j)
              for (unsigned int k = 0; k < result.n(); ++k)
                result(d * n + i, k) += factor(j, i) * gradients(d * n + j, k);
        return result;
      });
    }
  } // namespace

  Quadrature<dim>
  simplex_rule(const unsigned int degree)
  {
    return degree < sum_factorised_from ? simplex_quadrature<dim>(2 * degree) :
                                          collapsed_quadrature<dim>(2 * degree);
  }

  Tensor<2, dim>
  simplex_rule_jacobian(const unsigned int degree, const Point<dim> &x)
  {
    Tensor<2, dim> result;
    if (degree < sum_factorised_from)
      {
        for (unsigned int a = 0; a < dim; ++a)
          result[a][a] = 1.;
        return result;
      }
    const double y_1 = x[1] / (1. - x[2]), y_0 = x[0] / (1. - x[1] - x[2]);
    result[0][0] = (1. - y_1) * (1. - x[2]);
    result[1][0] = -y_0 * (1. - x[2]);
    result[1][1] = 1. - x[2];
    result[2][0] = -y_0 * (1. - y_1);
    result[2][1] = -y_1;
    result[2][2] = 1.;
    return result;
  }

  namespace
  {
    /// Derivatives of the nodal functions along the axes of simplex_rule(): row
    /// (axis, point).
    const FullMatrix<double> &
    gradients_on_curved(const unsigned int degree)
    {
      return made_once(degree, [&] {
        const auto               points = simplex_rule(degree).get_points();
        const unsigned int       n      = points.size();
        const FullMatrix<double> along_axes =
          simplex_nodal_gradients(degree, points);
        FullMatrix<double> result(dim * n, along_axes.n());
        for (unsigned int q = 0; q < n; ++q)
          {
            const Tensor<2, dim> J = simplex_rule_jacobian(degree, points[q]);
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int b = 0; b < dim; ++b)
                for (unsigned int k = 0; k < along_axes.n(); ++k)
                  result(a * n + q, k) += J[a][b] * along_axes(b * n + q, k);
          }
        return result;
      });
    }

    template <typename Number>
    class DenseGradients
    {
    public:
      using V = typename Batch<Number>::Vector;

      /// @p gradients: row (axis, point).
      explicit DenseGradients(const FullMatrix<double> &gradients)
        : to_points(gradients)
        , from_points(transposed(gradients))
      {}

      void
      evaluate(const V *u, V *g) const
      {
        to_points.apply(u, g);
      }

      void
      integrate(const V *g, V *u) const
      {
        from_points.apply(g, u);
      }

    private:
      DenseMatrix<Number> to_points, from_points;
    };
  } // namespace

  template <typename Number>
  template <int degree>
  class MatrixFreeElasticity<Number>::SimplexKernel
    : public MatrixFreeElasticity<Number>::Kernel
  {
  public:
    using V                = typename Batch<Number>::Vector;
    static constexpr int N = (degree + 1) * (degree + 2) * (degree + 3) / 6;
    /// What an affine cell has in place of points.
    static constexpr int M  = degree * (degree + 1) * (degree + 2) / 6;
    static constexpr int n9 = dim * dim;

    explicit SimplexKernel(const CellBatches<Number> &cells)
      : affine(gradient_coefficients(degree))
      , scratch((dim * N + n9 * std::max<unsigned int>(M, cells.n_points)) *
                Batch<Number>::size)
    {
      if (cells.n_batches > cells.n_affine)
        {
          if constexpr (degree < sum_factorised_from)
            curved = std::make_unique<Curved>(gradients_on_curved(degree));
          else
            curved = std::make_unique<Curved>();
        }
    }

    void
    add_product(const CellBatches<Number> &cells,
                const Number              *src,
                Number                    *dst) override
    {
      V *u = reinterpret_cast<V *>(scratch.data()), *g = u + dim * N;
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          const unsigned int *nodes =
            &cells.nodes[std::size_t(batch) * N * Batch<Number>::size];
          const V *metric = reinterpret_cast<const V *>(cells.metric_of(batch));
          gather<N>(src, nodes, u);
          if (batch < cells.n_affine)
            {
              affine.evaluate(u, g);
              std::visit(
                [=](const auto &law) {
                  on_all_points<true>(law, metric, M, g);
                },
                cells.law);
              affine.integrate(g, u);
            }
          else
            {
              curved->evaluate(u, g);
              std::visit(
                [=, n = cells.n_points](const auto &law) {
                  on_all_points<false>(law, metric, n, g);
                },
                cells.law);
              curved->integrate(g, u);
            }
          scatter_add<N>(u, nodes, dst);
        }
    }

    void
    add_diagonal(const CellBatches<Number> &cells, Number *dst) override
    {
      V                    *diagonal = reinterpret_cast<V *>(scratch.data());
      AlignedVector<Number> room(std::size_t(dim * n_pairs) *
                                 std::max<unsigned int>(M, cells.n_points) *
                                 Batch<Number>::size);
      V                    *a = reinterpret_cast<V *>(room.data());
      DenseMatrix<Number>   on_affine, on_curved;
      if (cells.n_affine > 0)
        on_affine = DenseMatrix<Number>(pairs(gradient_coefficients(degree)));
      if (curved)
        on_curved = DenseMatrix<Number>(pairs(gradients_on_curved(degree)));
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          const bool is_affine = batch < cells.n_affine;
          coefficients(cells, batch, is_affine ? M : cells.n_points, a);
          (is_affine ? on_affine : on_curved).apply(a, diagonal);
          scatter_add<N>(
            diagonal,
            &cells.nodes[std::size_t(batch) * N * Batch<Number>::size],
            dst);
        }
    }

  private:
    using Curved = std::conditional_t<(degree < sum_factorised_from),
                                      DenseGradients<Number>,
                                      CollapsedKernel<Number, degree>>;

    static constexpr unsigned int n_pairs = 6; ///< of axes

    /// Gradients of u to what is tested with gradients of v, @p g as
    /// [c][a][point].
    template <bool is_affine, typename Law>
    static void
    on_all_points(const Law law, const V *metric, const int n_points, V *g)
    {
      V G[dim][dim], h[dim][dim], s[dim][dim];
      for (int q = 0; q < n_points; ++q)
        {
          if (q == 0 || !is_affine)
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int e = 0; e < dim; ++e)
                G[a][e] = metric[q * n9 + dim * a + e];
          if (!is_affine)
            fetch_metric(metric + (q + n_points) * n9);
          gradient_at(g + q, n_points, G, h);
          law.tangent(Undeformed(), h, s);
          set_stress(s, G, n_points, g + q);
        }
    }

    /// diagonal_coefficient() as [c][(i, j)][point].
    static void
    coefficients(const CellBatches<Number> &cells,
                 const unsigned int         batch,
                 const unsigned int         n_points,
                 V                         *result)
    {
      const V   *metric = reinterpret_cast<const V *>(cells.metric_of(batch));
      const bool is_affine = batch < cells.n_affine;
      std::visit(
        [&](const auto &law) {
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = i; j < dim; ++j, result += n_points)
                for (unsigned int q = 0; q < n_points; ++q)
                  result[q] = diagonal_coefficient(
                    law, c, i, j, is_affine ? metric : metric + q * n9);
        },
        cells.law);
    }

    /// dN_k/dxi_i dN_k/dxi_j: row k, column ((i, j), point).
    static FullMatrix<double>
    pairs(const FullMatrix<double> &gradients)
    {
      const unsigned int n = gradients.m() / dim;
      FullMatrix<double> result(N, n_pairs * n);
      unsigned int       column = 0;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          for (unsigned int q = 0; q < n; ++q, ++column)
            for (int k = 0; k < N; ++k)
              result(k, column) =
                gradients(i * n + q, k) * gradients(j * n + q, k);
      return result;
    }

    DenseGradients<Number>  affine;
    std::unique_ptr<Curved> curved; ///< where there are such cells
    AlignedVector<Number>   scratch;
  };

  template <typename Number>
  std::unique_ptr<typename MatrixFreeElasticity<Number>::Kernel>
  MatrixFreeElasticity<Number>::make_simplex_kernel(
    const CellBatches<Number> &cells)
  {
    switch (cells.degree)
      {
        case 1:
          return std::make_unique<SimplexKernel<1>>(cells);
        case 2:
          return std::make_unique<SimplexKernel<2>>(cells);
        case 3:
          return std::make_unique<SimplexKernel<3>>(cells);
        case 4:
          return std::make_unique<SimplexKernel<4>>(cells);
        case 5:
          return std::make_unique<SimplexKernel<5>>(cells);
        case 6:
          return std::make_unique<SimplexKernel<6>>(cells);
        case 7:
          return std::make_unique<SimplexKernel<7>>(cells);
        default:
          AssertThrow(cells.degree == 8, ExcInternalError());
          return std::make_unique<SimplexKernel<8>>(cells);
      }
  }

  template std::unique_ptr<MatrixFreeElasticity<float>::Kernel>
  MatrixFreeElasticity<float>::make_simplex_kernel(const CellBatches<float> &);
  template std::unique_ptr<MatrixFreeElasticity<double>::Kernel>
  MatrixFreeElasticity<double>::make_simplex_kernel(
    const CellBatches<double> &);
} // namespace mortise
