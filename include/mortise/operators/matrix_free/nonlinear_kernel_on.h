// The kernels behind MatrixFreeElasticity for laws that are not linear, for any
// shape of cells, see kernel_on.h. Only sources of kernels include this.
#pragma once

#include <mortise/material/kinematics.h>
#include <mortise/operators/matrix_free/kept_tangent_on.h>
#include <mortise/operators/matrix_free/stressed_point.h>

namespace mortise
{
  /// Forces and linearisation as well. @p mixed: has Base pressures?
  template <typename Number>
  template <typename Base, bool mixed>
  class MatrixFreeElasticity<Number>::NonlinearKernelOn
    : public KeptTangentOn<Base>
  {
  public:
    using V = typename Batch<Number>::Vector;
    using KeptTangentOn<Base>::KeptTangentOn;

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
              const Fields        &previous,
              const StateOfPoints &state) override
    {
      const NonlinearLaw &law     = *cells.nonlinear;
      const bool          finite  = is_finite(law.form());
      const bool          goes_on = finite && previous.displacement != nullptr;
      V *deformed    = reinterpret_cast<V *>(cells.deformed_metric.data()),
        *of_pressure = reinterpret_cast<V *>(cells.pressure_tangent.data());
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        {
          if (goes_on)
            keep_stresses(cells, batch, previous, state);
          this->gradients(cells, batch, src.displacement);
          const V *p = nullptr;
          if constexpr (mixed)
            p = this->pressures(cells, batch, src.pressure);
          at_states(cells, batch, state, [&](const auto &at, const Point &is) {
            V       numbers[n_tangent(TangentForm::full_finite)];
            const V pressure = mixed ? p[at.q] : V{};
            V       tau[dim][dim];
            if (goes_on)
              {
                with_form(law.form(), [&](const auto form) {
                  this->template load_tangent<form()>(cells,
                                                      is.number,
                                                      numbers);
                });
                kept[at.q].get_linear(
                  law.form(), numbers, is.volume, is.h, pressure, tau);
              }
            else if (finite)
              get_stress(law, is, pressure, tau);
            law.tangent(is.h, is.before, numbers);
            if (finite)
              {
                V inverse[dim][dim];
                if constexpr (mixed)
                  add_pressure(law.form(), pressure, numbers);
                set_initial_stress(tau, numbers + n_moduli(law.form()));
                for (unsigned int k = 0; k < n_tangent(law.form()); ++k)
                  numbers[k] *= is.volume;
                // F_e^{-1} / (1 + thermal strain)
                invert_gradient(is.h,
                                is.stretch * (1. + dilatation(is.h)),
                                inverse);
                V *G = deformed + is.number * dim * dim;
                for (unsigned int a = 0; a < dim; ++a)
                  for (unsigned int e = 0; e < dim; ++e)
                    G[dim * a + e] = at.G[a][0] * inverse[0][e] +
                                     at.G[a][1] * inverse[1][e] +
                                     at.G[a][2] * inverse[2][e];
              }
            if constexpr (mixed)
              {
                V unused, *root = of_pressure + 2 * is.number, &slope = root[1];
                *root = is.root * is.volume;
                law.dilatation_of_pressure(p[at.q], unused, slope);
                slope /= is.volume;
              }
            this->store_tangent(numbers, cells, is.number);
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
            const V *of_pressure = pressure_tangent(cells, batch);
            this->at_laws(cells, batch, [=](const auto &law, const auto &at) {
              V h[dim][dim], s[dim][dim];
              gradient_at(g + at.q, at.n, at.G, h);
              law.tangent(Undeformed(), h, s);
              const V root     = of_pressure[2 * at.q],
                      slope    = of_pressure[2 * at.q + 1],
                      weighted = root * p[at.q];
              for (unsigned int c = 0; c < dim; ++c)
                s[c][c] -= weighted;
              set_stress(s, at.G, at.n, g + at.q);
              p[at.q] =
                -root * (h[0][0] + h[1][1] + h[2][2] - slope * weighted);
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
              const V *values      = this->pressures(cells, batch, p);
              const V *of_pressure = pressure_tangent(cells, batch);
              this->at_laws(cells, batch, [=](const auto &, const auto &at) {
                const V weighted = -of_pressure[2 * at.q] * values[at.q];
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
    static const V *
    pressure_tangent(const CellBatches<Number> &cells, const unsigned int batch)
    {
      return reinterpret_cast<const V *>(cells.pressure_tangent.data()) +
             2 * std::size_t(batch) * cells.n_points;
    }

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
          const V factor = is.root > 0. ? 1. / is.root : V{};
          for (auto &row : is.h)
            for (V &entry : row)
              entry *= factor;
          if (state.thermal_strains != nullptr)
            remove_thermal_strain(reinterpret_cast<const V *>(
                                    state.thermal_strains)[is.number],
                                  is_finite(cells.nonlinear->form()),
                                  is);
          visit(at, is);
        });
    }

    /// Keeps the stresses of a batch at the previous iterate.
    void
    keep_stresses(const CellBatches<Number> &cells,
                  const unsigned int         batch,
                  const Fields              &previous,
                  const StateOfPoints       &state)
    {
      this->gradients(cells, batch, previous.displacement);
      const V *p = nullptr;
      if constexpr (mixed)
        p = this->pressures(cells, batch, previous.pressure);
      kept.resize(cells.n_points);
      at_states(cells, batch, state, [&](const auto &at, const Point &is) {
        StressedPoint<Number> &of = kept[at.q];
        std::memcpy(of.h, is.h, sizeof is.h);
        of.p = mixed ? p[at.q] : V{};
        get_stress(*cells.nonlinear, is, of.p, of.tau);
      });
    }

    /// tau less the pressure.
    static void
    get_stress(const NonlinearLaw &law,
               const Point        &is,
               const V            &p,
               V (&tau)[dim][dim])
    {
      law.stress(is.h, is.before, nullptr, tau);
      for (unsigned int c = 0; c < dim; ++c)
        tau[c][c] -= p;
    }

    static void
    remove_thermal_strain(const V &strain, const bool finite, Point &is)
    {
      for (unsigned int c = 0; c < dim; ++c)
        is.h[c][c] -= strain;
      if (!finite)
        return;
      // F = (1 + strain) F_e
      is.stretch     = 1. + strain;
      is.volume      = is.stretch * is.stretch * is.stretch;
      const V factor = 1. / is.stretch;
      for (auto &row : is.h)
        for (V &entry : row)
          entry *= factor;
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
    add_pressure(const TangentForm form, const V &p, V *moduli)
    {
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

    std::vector<StressedPoint<Number>> kept; ///< of one batch
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
