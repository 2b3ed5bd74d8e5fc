// Tangents at points as they are set and read one by one, and their means over
// cells. Only sources of kernels include this.
#pragma once

#include <mortise/operators/matrix_free/tangent_kernel_on.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mortise
{
  /// Of kernels that linearise laws, in double precision; those of
  /// preconditioners take their tangents from them, see take_tangent().
  template <typename Number>
  template <typename Base>
  class MatrixFreeElasticity<Number>::KeptTangentOn
    : public TangentKernelOn<Base>
  {
  public:
    using V = typename Batch<Number>::Vector;
    using TangentKernelOn<Base>::TangentKernelOn;

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

  protected:
    /// The tangent at point @p number, to @p numbers.
    template <TangentForm form>
    static void
    load_tangent(const CellBatches<Number> &cells,
                 const std::size_t          number,
                 V                         *numbers)
    {
      constexpr unsigned int n = n_tangent(form);
      const auto            *from =
        in_batches<Number>(cells.template tangent_of<form>()) + number * n;
      for (unsigned int k = 0; k < n; ++k)
        numbers[k] = __builtin_convertvector(from[k], V);
    }

    /// And back.
    static void
    store_tangent(const V             *numbers,
                  CellBatches<Number> &cells,
                  const std::size_t    number)
    {
      with_form(cells.nonlinear->form(), [&](const auto form) {
        using Stored             = StoredTangent<Number, form()>;
        constexpr unsigned int n = n_tangent(form());
        auto                  *to =
          in_batches<Number>(cells.template tangent_of<form()>()) + number * n;
        for (unsigned int k = 0; k < n; ++k)
          to[k] =
            __builtin_convertvector(numbers[k],
                                    typename BatchAs<Number, Stored>::Vector);
      });
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
  };
} // namespace mortise
