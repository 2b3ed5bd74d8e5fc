// The kernels behind MatrixFreeElasticity, for any shape of cells: what is done
// with the values at the points. Only sources of kernels include this.
//
// A shape of one degree (Hexahedra, Simplices) has
//
//     n_nodes, max_points()       of a cell
//     evaluate(affine, u, g)      gradients with respect to xi at all points,
//     as
//                                 g[3 c + a][point], from values u[c][node],
//                                 which may be overwritten
//     integrate(affine, g, u)     its transpose
//     n_points(affine)            affine: std::true_type or std::false_type
//     get_metric(affine, metric, q, G)   sqrt(w |J|) dxi_a/dx_e as G[a][e] at
//                                 point q > 0 after that at q - 1
//     root(affine, G, q)          sqrt(w |J|)
//     Squares                     made of it, with apply(affine, a, u): u[c][k]
//                                 = sum_q a[c][(i, j)][q] dN_k/dxi_i
//                                 dN_k/dxi_j, i <= j; a may be overwritten
#pragma once

#include <mortise/operators/matrix_free/matrix_free_kernel.h>
#include <mortise/operators/matrix_free/node_access.h>
#include <mortise/operators/matrix_free/point_kernel.h>

#include <algorithm>

namespace mortise
{
  template <typename Number>
  template <typename Shape>
  class MatrixFreeElasticity<Number>::KernelOn
    : public MatrixFreeElasticity<Number>::Kernel
  {
  public:
    using V                = typename Batch<Number>::Vector;
    static constexpr int N = Shape::n_nodes;

    explicit KernelOn(const CellBatches<Number> &cells)
      : shape(cells)
      , scratch(dim * (N + dim * shape.max_points()) * Batch<Number>::size)
    {}

    void
    add_product(const CellBatches<Number> &cells,
                const Number              *src,
                Number                    *dst) override
    {
      multiply(*this, cells, src, dst);
    }

    void
    add_diagonal(const CellBatches<Number> &cells, Number *dst) override
    {
      sum_diagonal(*this, cells, dst);
    }

    /// visit(law, point).
    template <typename Visit>
    void
    at_laws(const CellBatches<Number> &cells,
            const unsigned int         batch,
            const Visit               &visit) const
    {
      std::visit(
        [&](const auto law) {
          at_points(cells, batch, [=](const auto &at) { visit(law, at); });
        },
        cells.law);
    }

  protected:
    /// The product with the tangents of self.at_laws().
    template <typename Self>
    void
    multiply(const Self                &self,
             const CellBatches<Number> &cells,
             const Number              *src,
             Number                    *dst)
    {
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          V *g = gradients(cells, batch, src);
          self.at_laws(cells, batch, [=](const auto &law, const auto &at) {
            V h[dim][dim], s[dim][dim];
            gradient_at(g + at.q, at.n, at.G, h);
            law.tangent(Undeformed(), h, s);
            set_stress(s, at.G, at.n, g + at.q);
          });
          add_forces(cells, batch, dst);
        }
    }

    template <typename Self>
    void
    sum_diagonal(const Self                &self,
                 const CellBatches<Number> &cells,
                 Number                    *dst)
    {
      constexpr unsigned int        n_pairs = 6; // of axes
      const typename Shape::Squares squares(shape);
      dealii::AlignedVector<Number> room(
        std::size_t(dim * n_pairs) * shape.max_points() * Batch<Number>::size);
      V *a        = reinterpret_cast<V *>(room.data()),
        *diagonal = reinterpret_cast<V *>(scratch.data());
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          self.at_laws(cells, batch, [=](const auto &law, const auto &at) {
            diagonal_coefficients(law, at.G, at.n, a + at.q);
          });
          squares.apply(batch < cells.n_affine, a, diagonal);
          scatter_add<N>(diagonal, cells.nodes_of(batch), dst);
        }
    }

    /// Where gradients are, or what is tested with those of v.
    V *
    gradients()
    {
      return reinterpret_cast<V *>(scratch.data()) + dim * N;
    }

    V *
    gradients(const CellBatches<Number> &cells,
              const unsigned int         batch,
              const Number              *src)
    {
      V *u = reinterpret_cast<V *>(scratch.data());
      gather<N>(src, cells.nodes_of(batch), u);
      shape.evaluate(batch < cells.n_affine, u, gradients());
      return gradients();
    }

    /// From where gradients are.
    void
    add_forces(const CellBatches<Number> &cells,
               const unsigned int         batch,
               Number                    *dst)
    {
      V *u = reinterpret_cast<V *>(scratch.data());
      shape.integrate(batch < cells.n_affine, gradients(), u);
      scatter_add<N>(u, cells.nodes_of(batch), dst);
    }

    /// One of n points, as that of a batch.
    template <bool affine>
    struct Point
    {
      const Shape &shape;
      decltype(std::declval<Shape>().n_points(std::bool_constant<affine>())) n;
      int                                                                    q;
      V G[dim][dim]; ///< metric

      /// sqrt(w |J|)
      V
      root() const
      {
        return shape.root(affine, G, q);
      }
    };

    /// visit(point), by value, so that what it holds stays in registers.
    /// @p given: the metric of a batch.
    template <bool affine, typename Visit>
    __attribute__((noinline)) void
    at_points_of(const Number *given, const Visit visit) const
    {
      const std::bool_constant<affine> is_affine;
      const V      *metric = reinterpret_cast<const V *>(given);
      Point<affine> at{shape, shape.n_points(is_affine), 0, {}};
      for (; at.q < at.n; ++at.q)
        {
          shape.get_metric(is_affine, metric, at.q, at.G);
          visit(at);
        }
    }

    template <typename Visit>
    void
    at_points(const CellBatches<Number> &cells,
              const unsigned int         batch,
              const Visit               &visit) const
    {
      if (batch < cells.n_affine)
        at_points_of<true>(cells.metric_of(batch), visit);
      else
        at_points_of<false>(cells.metric_of(batch), visit);
    }

    Shape                         shape;
    dealii::AlignedVector<Number> scratch; ///< values at nodes, gradients
  };
} // namespace mortise
