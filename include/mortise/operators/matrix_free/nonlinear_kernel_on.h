// The kernels behind MatrixFreeElasticity for laws that are not linear, for any
// shape of cells, see kernel_on.h. Only sources of kernels include this.
#pragma once

#include <mortise/material/kinematics.h>
#include <mortise/operators/matrix_free/mixed_kernel_on.h>

namespace mortise
{
  /// @p visit(form) with the form as a constant.
  template <typename Visit>
  void
  with_form(const TangentForm form, const Visit &visit)
  {
    switch (form)
      {
        case TangentForm::isotropic_finite:
          return visit(std::integral_constant<TangentForm,
                                              TangentForm::isotropic_finite>());
        case TangentForm::rank_one:
          return visit(
            std::integral_constant<TangentForm, TangentForm::rank_one>());
        case TangentForm::full:
          return visit(
            std::integral_constant<TangentForm, TangentForm::full>());
        case TangentForm::full_finite:
          return visit(
            std::integral_constant<TangentForm, TangentForm::full_finite>());
      }
  }

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
      const unsigned int n = cells.n_numbers();
      const V *tangent     = reinterpret_cast<const V *>(cells.tangent.data()) +
                         std::size_t(batch) * cells.n_points * n;
      with_form(cells.nonlinear->form(), [&](const auto form) {
        this->template at_points_of<false>(
          tangent_metric(cells, batch), [=](const auto &at) {
            fetch(tangent + (at.q + at.n) * n, n);
            visit(TangentAt<Number, form()>{tangent + at.q * n}, at);
          });
      });
    }

    std::vector<Moduli>
    average_moduli(const CellBatches<Number> &cells,
                   const bool                 initial_stress) override
    {
      std::vector<Moduli> result(cells.n_cells);
      const unsigned int  n = cells.n_numbers();
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
                std::memcpy(numbers,
                            reinterpret_cast<const V *>(cells.tangent.data()) +
                              number * n,
                            sizeof numbers);
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
      const V det = determinant_of(G);
      for (unsigned int i = 0; i < dim; ++i)
        {
          // row i of G^{-1}, the transposed cofactor
          V row[dim];
          for (unsigned int a = 0; a < dim; ++a)
            {
              const unsigned int b = (a + 1) % dim, c = (a + 2) % dim,
                                 j = (i + 1) % dim, k = (i + 2) % dim;
              row[a] = (G[b][j] * G[c][k] - G[b][k] * G[c][j]) / det;
            }
          for (unsigned int e = 0; e < dim; ++e)
            inverse[i][e] = row[0] * deformed[e] + row[1] * deformed[dim + e] +
                            row[2] * deformed[2 * dim + e];
        }
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

  /// Forces and linearisation as well. @p mixed: has Base pressures?
  template <typename Number>
  template <typename Base, bool mixed>
  class MatrixFreeElasticity<Number>::NonlinearKernelOn
    : public TangentKernelOn<Base>
  {
  public:
    using V = typename Batch<Number>::Vector;
    using TangentKernelOn<Base>::TangentKernelOn;

    LeastJacobian
    add_residual(const CellBatches<Number> &cells,
                 const Fields              &src,
                 const StateOfPoints       &state,
                 double                    *after,
                 const Fields              &dst) override
    {
      const NonlinearLaw &law       = *cells.nonlinear;
      const unsigned int  n_history = law.n_history();
      const bool          finite    = is_finite(law.form());
      LeastJacobian       least;
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          V *g = this->gradients(cells, batch, src.displacement), *p = nullptr;
          if constexpr (mixed)
            p = this->pressures(cells, batch, src.pressure);
          V smallest = V{} + 1.;
          at_states(cells, batch, state, [&](const auto &at, const Point &is) {
            V s[dim][dim];
            law.stress(is.h,
                       is.before,
                       n_history == 0 ?
                         nullptr :
                         reinterpret_cast<V *>(after) + is.number * n_history,
                       s);
            const V dilatation = finite ? mortise::dilatation(is.h) :
                                          is.h[0][0] + is.h[1][1] + is.h[2][2];
            if constexpr (mixed)
              {
                V of_pressure, slope;
                law.dilatation_of_pressure(p[at.q], of_pressure, slope);
                for (unsigned int c = 0; c < dim; ++c)
                  s[c][c] -= p[at.q];
                p[at.q] =
                  -is.root * is.root * is.volume *
                  ((finite ? log1p(dilatation) : dilatation) - of_pressure);
              }
            if (finite)
              {
                const V J = 1. + dilatation;
                smallest  = J < smallest ? J : smallest;
                make_nominal(is.h, J, s);
              }
            // P = J_th tau_e F_e^{-T} / (1 + thermal strain)
            const V factor = is.root * is.volume / is.stretch;
            for (auto &row : s)
              for (V &entry : row)
                entry *= factor;
            set_stress(s, at.G, at.n, g + at.q);
          });
          least.add(smallest, batch, cells.lanes(batch));
          this->add_forces(cells, batch, dst.displacement);
          if constexpr (mixed)
            this->add_tested(cells, batch, dst.pressure);
        }
      return least;
    }

    void
    linearise(CellBatches<Number> &cells,
              const Fields        &src,
              const StateOfPoints &state) override
    {
      const NonlinearLaw &law     = *cells.nonlinear;
      const bool          finite  = is_finite(law.form());
      const unsigned int  n       = cells.n_numbers();
      V                  *tangent = reinterpret_cast<V *>(cells.tangent.data()),
        *deformed = reinterpret_cast<V *>(cells.deformed_metric.data());
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          this->gradients(cells, batch, src.displacement);
          const V *p = nullptr;
          if constexpr (mixed)
            p = this->pressures(cells, batch, src.pressure);
          at_states(cells, batch, state, [&](const auto &at, const Point &is) {
            V *numbers = tangent + is.number * n;
            law.tangent(is.h, is.before, numbers);
            if (finite)
              {
                V tau[dim][dim], inverse[dim][dim];
                law.stress(is.h, is.before, nullptr, tau);
                if constexpr (mixed)
                  add_pressure(law.form(), p[at.q], numbers, tau);
                set_initial_stress(tau, numbers + n_moduli(law.form()));
                for (unsigned int k = 0; k < n_tangent(law.form()); ++k)
                  numbers[k] *= is.volume;
                invert_gradient(is.h, 1. + dilatation(is.h), inverse);
                V *G = deformed + is.number * dim * dim;
                for (unsigned int a = 0; a < dim; ++a)
                  for (unsigned int e = 0; e < dim; ++e)
                    G[dim * a + e] =
                      (at.G[a][0] * inverse[0][e] + at.G[a][1] * inverse[1][e] +
                       at.G[a][2] * inverse[2][e]) /
                      is.stretch;
              }
            if constexpr (mixed)
              {
                V unused;
                numbers[n - 2] = is.root * is.volume;
                law.dilatation_of_pressure(p[at.q], unused, numbers[n - 1]);
                numbers[n - 1] /= is.volume;
              }
          });
        }
    }

    void
    add_mixed_product(const CellBatches<Number> &cells,
                      const Fields              &src,
                      const Fields              &dst) override
    {
      if constexpr (!mixed)
        this->add_product(cells, src.displacement, dst.displacement);
      else
        for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
          {
            V *g = this->gradients(cells, batch, src.displacement),
              *p = this->pressures(cells, batch, src.pressure);
            const unsigned int n = cells.n_numbers();
            this->at_laws(cells, batch, [=](const auto &law, const auto &at) {
              V h[dim][dim], s[dim][dim];
              gradient_at(g + at.q, at.n, at.G, h);
              law.tangent(Undeformed(), h, s);
              const V root = law.data[n - 2], weighted = root * p[at.q];
              for (unsigned int c = 0; c < dim; ++c)
                s[c][c] -= weighted;
              set_stress(s, at.G, at.n, g + at.q);
              p[at.q] = -root * (h[0][0] + h[1][1] + h[2][2] -
                                 law.data[n - 1] * weighted);
            });
            this->add_forces(cells, batch, dst.displacement);
            this->add_tested(cells, batch, dst.pressure);
          }
    }

    void
    add_pressure_force(const CellBatches<Number> &cells,
                       const Number              *p,
                       Number                    *dst) override
    {
      if constexpr (mixed)
        {
          V *g = this->gradients();
          for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
            {
              const V           *values = this->pressures(cells, batch, p);
              const unsigned int n      = cells.n_numbers();
              this->at_laws(cells, batch, [=](const auto &law, const auto &at) {
                const V weighted = -law.data[n - 2] * values[at.q];
                for (unsigned int c = 0; c < dim; ++c)
                  for (unsigned int a = 0; a < dim; ++a)
                    g[(dim * c + a) * at.n + at.q] = weighted * at.G[a][c];
              });
              this->add_forces(cells, batch, dst);
            }
        }
      else
        Base::add_pressure_force(cells, p, dst);
    }

  private:
    struct Point
    {
      std::size_t number;      ///< among the points of all batches
      V           root;        ///< sqrt(w |J|)
      V           h[dim][dim]; ///< without thermal strain
      V           stretch;     ///< of that at finite strain, else 1
      V           volume;      ///< its cube
      const V    *before;
    };

    /// visit(point, state) from where gradients are.
    template <typename Visit>
    void
    at_states(const CellBatches<Number> &cells,
              const unsigned int         batch,
              const StateOfPoints       &state,
              const Visit               &visit)
    {
      const V           *g         = this->gradients();
      const unsigned int n_history = cells.nonlinear->n_history();
      this->template at_points_of<false>(
        cells.metric_of(batch), [&](const auto &at) {
          Point is{std::size_t(batch) * at.n + at.q,
                   at.root(),
                   {},
                   V{} + 1.,
                   V{} + 1.,
                   nullptr};
          is.before =
            reinterpret_cast<const V *>(state.history) + is.number * n_history;
          gradient_at(g + at.q, at.n, at.G, is.h);
          // lanes without a cell have no metric
          const V divisor = is.root > 0. ? is.root : V{} + 1.;
          for (auto &row : is.h)
            for (V &entry : row)
              entry /= divisor;
          if (state.thermal_strains != nullptr)
            remove_thermal_strain(reinterpret_cast<const V *>(
                                    state.thermal_strains)[is.number],
                                  is_finite(cells.nonlinear->form()),
                                  is);
          visit(at, is);
        });
    }

    static void
    remove_thermal_strain(const V &strain, const bool finite, Point &is)
    {
      for (unsigned int c = 0; c < dim; ++c)
        is.h[c][c] -= strain;
      if (!finite)
        return;
      // F = (1 + strain) F_e
      is.stretch = 1. + strain;
      is.volume  = is.stretch * is.stretch * is.stretch;
      for (auto &row : is.h)
        for (V &entry : row)
          entry /= is.stretch;
    }

    /// P = tau F^{-T}.
    static void
    make_nominal(const V (&h)[dim][dim], const V &J, V (&s)[dim][dim])
    {
      V inverse[dim][dim], tau[dim][dim];
      invert_gradient(h, J, inverse);
      std::memcpy(tau, s, sizeof tau);
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int e = 0; e < dim; ++e)
          s[c][e] = tau[c][0] * inverse[e][0] + tau[c][1] * inverse[e][1] +
                    tau[c][2] * inverse[e][2];
    }

    /// tau = -p I has the moduli 2 p of the symmetric identity.
    static void
    add_pressure(const TangentForm form,
                 const V          &p,
                 V                *moduli,
                 V (&tau)[dim][dim])
    {
      for (unsigned int c = 0; c < dim; ++c)
        tau[c][c] -= p;
      if (form == TangentForm::isotropic_finite)
        moduli[0] += p;
      else
        for (unsigned int i = 0, k = 0; i < 6; k += 6 - i, ++i)
          moduli[k] += i < 3 ? 2. * p : p;
    }

    static void
    set_initial_stress(const V (&tau)[dim][dim], V *numbers)
    {
      for (unsigned int c = 0; c < dim; ++c)
        {
          numbers[c]     = tau[c][c];
          numbers[3 + c] = tau[(c + 1) % 3][(c + 2) % 3];
        }
    }
  };

  template <typename Number>
  template <typename Shape>
  std::unique_ptr<typename MatrixFreeElasticity<Number>::Kernel>
  MatrixFreeElasticity<Number>::make_kernel_on(const CellBatches<Number> &cells)
  {
    if (!cells.nonlinear)
      return std::make_unique<KernelOn<Shape>>(cells);
    if constexpr (std::is_same_v<Number, double>)
      return std::make_unique<NonlinearKernelOn<KernelOn<Shape>, false>>(cells);
    else
      return std::make_unique<TangentKernelOn<KernelOn<Shape>>>(cells);
  }

  template <typename Number>
  template <typename Shape, typename Pressures>
  std::unique_ptr<typename MatrixFreeElasticity<Number>::Kernel>
  MatrixFreeElasticity<Number>::make_mixed_kernel_on(
    const CellBatches<Number> &cells)
  {
    using Linear = MixedKernelOn<Shape, Pressures>;
    if (cells.nonlinear)
      return std::make_unique<NonlinearKernelOn<Linear, true>>(cells);
    return std::make_unique<Linear>(cells);
  }
} // namespace mortise
