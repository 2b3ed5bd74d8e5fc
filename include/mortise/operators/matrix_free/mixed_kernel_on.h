// The kernels behind MatrixFreeElasticity in mixed form, for any shape of
// cells, see kernel_on.h. Only sources of kernels include this.
//
// The pressures of a shape (HexahedralPressures, SimplexPressures), of one
// degree less than the displacement, have
// less,
//
//     n_nodes, room               V of either place that it needs
//     to_points(affine, at_nodes, at_points)
//     from_points(affine, at_points, at_nodes)   its transpose
//     squares(affine, at_points, at_nodes)       sum_q a_q N_k N_k
//
// where both places may be overwritten.
#pragma once

#include <mortise/operators/matrix_free/kernel_on.h>

namespace mortise
{
  template <typename Number>
  template <typename Shape, typename Pressures>
  class MatrixFreeElasticity<Number>::MixedKernelOn : public KernelOn<Shape>
  {
  public:
    using Base             = KernelOn<Shape>;
    using V                = typename Batch<Number>::Vector;
    static constexpr int M = Pressures::n_nodes;

    explicit MixedKernelOn(const CellBatches<Number> &cells)
      : Base(cells)
      , shape_of_pressures(cells)
      , room(2 * shape_of_pressures.room * Batch<Number>::size)
    {}

    void
    add_mixed_product(const CellBatches<Number> &cells,
                      const Fields              &src,
                      const Fields              &dst) override
    {
      const auto   law             = std::get<IsotropicLaw<Number>>(cells.law);
      const Number compressibility = cells.compressibility;
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          V *g = this->gradients(cells, batch, src.displacement),
            *p = pressures(cells, batch, src.pressure);
          this->at_points(cells, batch, [=](const auto &at) {
            V h[dim][dim], s[dim][dim];
            gradient_at(g + at.q, at.n, at.G, h);
            law.tangent(Undeformed(), h, s);
            const V w = at.root(), weighted = w * p[at.q];
            for (unsigned int c = 0; c < dim; ++c)
              s[c][c] -= weighted;
            set_stress(s, at.G, at.n, g + at.q);
            p[at.q] =
              -w * (h[0][0] + h[1][1] + h[2][2] + compressibility * weighted);
          });
          this->add_forces(cells, batch, dst.displacement);
          add_tested(cells, batch, dst.pressure);
        }
    }

    void
    add_pressure_force(const CellBatches<Number> &cells,
                       const Number              *p,
                       Number                    *dst) override
    {
      V *g = this->gradients();
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          const V *values = pressures(cells, batch, p);
          this->at_points(cells, batch, [=](const auto &at) {
            const V weighted = -at.root() * values[at.q];
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int a = 0; a < dim; ++a)
                g[(dim * c + a) * at.n + at.q] = weighted * at.G[a][c];
          });
          this->add_forces(cells, batch, dst);
        }
    }

    void
    add_pressure_norm(const CellBatches<Number> &cells,
                      const Number              *p,
                      Number                    *dst) override
    {
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          multiply_by_norm(cells, batch, pressures(cells, batch, p));
          add_tested(cells, batch, dst);
        }
    }

    void
    add_pressure_norm_diagonal(const CellBatches<Number> &cells,
                               Number                    *dst) override
    {
      V *at_nodes = this->at_nodes(), *values = at_points_of_pressures();
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          std::fill_n(values, shape_of_pressures.room, V{} + Number(1));
          multiply_by_norm(cells, batch, values);
          shape_of_pressures.squares(batch < cells.n_affine, values, at_nodes);
          scatter_add<M, 1>(at_nodes, cells.pressure_nodes_of(batch), dst);
        }
    }

  protected:
    V *
    at_nodes()
    {
      return reinterpret_cast<V *>(room.data());
    }

    V *
    at_points_of_pressures()
    {
      return at_nodes() + shape_of_pressures.room;
    }

    V *
    pressures(const CellBatches<Number> &cells,
              const unsigned int         batch,
              const Number              *p)
    {
      gather<M, 1>(p, cells.pressure_nodes_of(batch), at_nodes());
      shape_of_pressures.to_points(batch < cells.n_affine,
                                   at_nodes(),
                                   at_points_of_pressures());
      return at_points_of_pressures();
    }

    /// From where pressures() puts them.
    void
    add_tested(const CellBatches<Number> &cells,
               const unsigned int         batch,
               Number                    *dst)
    {
      shape_of_pressures.from_points(batch < cells.n_affine,
                                     at_points_of_pressures(),
                                     at_nodes());
      scatter_add<M, 1>(at_nodes(), cells.pressure_nodes_of(batch), dst);
    }

  private:
    void
    multiply_by_norm(const CellBatches<Number> &cells,
                     const unsigned int         batch,
                     V                         *p) const
    {
      const Number factor = cells.pressure_norm;
      this->at_points(cells, batch, [=](const auto &at) {
        const V w = at.root();
        p[at.q] *= factor * w * w;
      });
    }

    Pressures                     shape_of_pressures;
    dealii::AlignedVector<Number> room; ///< at nodes, then at points
  };
} // namespace mortise
