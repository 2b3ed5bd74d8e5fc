// Products with tangents that are kept at points, for any shape of cells, see
// kernel_on.h. Only sources of kernels include this.
#pragma once

#include <mortise/operators/matrix_free/mixed_kernel_on.h>

#include <algorithm>
#include <cstring>

namespace mortise
{
  /// Products with tangents that are kept at points. @p Base: KernelOn or
  /// MixedKernelOn.
  template <typename Number>
  template <typename Base>
  class MatrixFreeElasticity<Number>::TangentKernelOn : public Base
  {
  public:
    using V = typename Batch<Number>::Vector;
    using Base::Base;

    void
    add_product(const CellBatches<Number> &cells,
                const Number              *src,
                Number                    *dst) override
    {
      this->multiply(*this, cells, src, dst);
    }

    void
    add_diagonal(const CellBatches<Number> &cells, Number *dst) override
    {
      this->sum_diagonal(*this, cells, dst);
    }

    /// As that of KernelOn, the law being the tangent at the point.
    template <typename Visit>
    void
    at_laws(const CellBatches<Number> &cells,
            const unsigned int         batch,
            const Visit               &visit) const
    {
      with_form(cells.nonlinear->form(), [&](const auto form) {
        using Stored         = StoredTangent<Number, form()>;
        constexpr unsigned n = n_stored<Stored>(form());
        const auto        *tangent =
          in_batches<Number>(cells.template tangent_of<form()>()) +
          std::size_t(batch) * cells.n_points * n;
        this->template at_points_of<false>(
          tangent_metric(cells, batch), [=](const auto &at) {
            fetch(tangent + (at.q + at.n) * n, n);
            visit(TangentAt<Number, form(), Stored>{tangent + at.q * n}, at);
          });
      });
    }

    std::vector<Moduli>
    average_moduli(const CellBatches<Number> &cells,
                   const bool                 initial_stress) override
    {
      std::vector<Moduli> result(cells.n_cells);
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          V sums[dim][dim][dim][dim] = {}, volume = {};
          with_form(cells.nonlinear->form(), [&](const auto form) {
            this->template at_points_of<false>(
              cells.metric_of(batch), [&](const auto &at) {
                const std::size_t number =
                  std::size_t(batch) * cells.n_points + at.q;
                const V weight = at.root() * at.root();
                V       inverse[dim][dim];
                get_inverse(cells, number, at.G, inverse);
                V numbers[n_tangent(form())];
                load_tangent<form()>(cells, number, numbers);
                if (!initial_stress)
                  std::fill(numbers + n_moduli(form()),
                            numbers + n_tangent(form()),
                            V{});
                add_moduli(TangentAt<Number, form()>{numbers},
                           inverse,
                           weight,
                           sums);
                volume += weight;
              });
          });
          for (unsigned int lane = 0; lane < cells.lanes(batch); ++lane)
            for (unsigned int i = 0; i < 81; ++i)
              (&result[batch * Batch<Number>::size + lane][0][0][0][0])[i] =
                (&sums[0][0][0][0])[i][lane] / volume[lane];
        }
      return result;
    }

  private:
    /// F^{-1} = G^{-1} G_x at point @p number, I at small strain.
    static void
    get_inverse(const CellBatches<Number> &cells,
                const std::size_t          number,
                const V (&G)[dim][dim],
                V (&inverse)[dim][dim])
    {
      if (cells.deformed_metric.empty())
        {
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int e = 0; e < dim; ++e)
              inverse[i][e] = V{} + Number(i == e ? 1 : 0);
          return;
        }
      const V *deformed =
        reinterpret_cast<const V *>(cells.deformed_metric.data()) +
        number * dim * dim;
      V of_metric[dim][dim];
      invert(G, determinant_of(G), of_metric);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int e = 0; e < dim; ++e)
          inverse[i][e] = of_metric[i][0] * deformed[e] +
                          of_metric[i][1] * deformed[dim + e] +
                          of_metric[i][2] * deformed[2 * dim + e];
    }

    /// A_iajb = dP_ia / d(Grad u)_jb.
    template <typename Tangent>
    static void
    add_moduli(const Tangent &tangent,
               const V (&inverse)[dim][dim],
               const V &weight,
               V (&sums)[dim][dim][dim][dim])
    {
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int b = 0; b < dim; ++b)
          {
            V h[dim][dim] = {}, s[dim][dim];
            for (unsigned int e = 0; e < dim; ++e)
              h[j][e] = inverse[b][e];
            tangent.tangent(Undeformed(), h, s);
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int a = 0; a < dim; ++a)
                sums[i][a][j][b] +=
                  weight * (s[i][0] * inverse[a][0] + s[i][1] * inverse[a][1] +
                            s[i][2] * inverse[a][2]);
          }
    }

  protected:
    /// The tangent at point @p number, to @p numbers.
    template <TangentForm form>
    static void
    load_tangent(const CellBatches<Number> &cells,
                 const std::size_t          number,
                 V                         *numbers)
    {
      using Stored = StoredTangent<Number, form>;
      const TangentAt<Number, form, Stored> kept{
        in_batches<Number>(cells.template tangent_of<form>()) +
        number * n_stored<Stored>(form)};
      for (unsigned int k = 0; k < n_tangent(form); ++k)
        numbers[k] = kept.number(k);
      if constexpr (in_two_parts<Stored>(form))
        for_isotropic_moduli(kept.number(n_tangent(form)),
                             kept.number(n_tangent(form) + 1),
                             [=](const unsigned int k, const V &modulus) {
                               numbers[k] += modulus;
                             });
    }

    static const Number *
    tangent_metric(const CellBatches<Number> &cells, const unsigned int batch)
    {
      const std::size_t size =
        std::size_t(cells.n_points) * dim * dim * Batch<Number>::size;
      return cells.deformed_metric.empty() ?
               cells.metric_of(batch) :
               cells.deformed_metric.data() + batch * size;
    }
  };
} // namespace mortise
