// Forms and matrices of one cell by FEValues and plain sums over points: what
// tests compare with.
#pragma once

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/body/body.h>
#include <mortise/body/elements/simplex_quadrature.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <vector>

namespace mortise::testing
{
  using namespace dealii;

  /// Integrates the stiffness on curved cells.
  inline Quadrature<dim>
  reference_rule(const Body &body, const FiniteElement<dim> &element)
  {
    const unsigned int p = element.degree;
    if (!body.mesh.tetrahedra)
      return QGauss<dim>(p + 1);
    return simplex_quadrature<dim>(p + std::max(p, body.mapping_degree));
  }

  /// Of the cells with one element. By the functions N_i of the displacement,
  /// component by component, and Q_k of the pressure
  ///
  ///     K_(ic)(jd) = int sum_ef C_cedf dN_i/dx_e dN_j/dx_f,
  ///     G_kj = -int Q_k div N_j,  M_kl = int Q_k Q_l.
  class ReferenceCell
  {
  public:
    /// Coefficients by component.
    using Coefficients = std::array<std::vector<double>, dim>;

    /// All are kept by reference.
    ReferenceCell(const Body               &body,
                  const FiniteElement<dim> &displacement,
                  const FiniteElement<dim> *pressure = nullptr)
      : body(body)
      , values(*body.mapping,
               displacement.base_element(0),
               reference_rule(body, displacement),
               update_gradients | update_JxW_values)
    {
      if (pressure != nullptr)
        pressures = std::make_unique<FEValues<dim>>(*body.mapping,
                                                    *pressure,
                                                    values.get_quadrature(),
                                                    update_values);
    }

    void
    reinit(const Body::CellIterator &cell)
    {
      values.reinit(Triangulation<dim>::cell_iterator(cell));
      if (pressures)
        pressures->reinit(Triangulation<dim>::cell_iterator(cell));
    }

    /// w.Ku
    double
    stiffness(const Coefficients &w, const Coefficients &u) const
    {
      const auto law = body.material.displacement_law();
      double     sum = 0.;
      for (const unsigned int q : values.quadrature_point_indices())
        sum +=
          values.JxW(q) *
          (std::visit(
             [&](const auto &any) { return stress_at(any, gradient(u, q)); },
             law) *
           symmetrize(gradient(w, q)));
      return sum;
    }

    /// q.Gu
    double
    divergence(const std::vector<double> &of_q, const Coefficients &u) const
    {
      double sum = 0.;
      for (const unsigned int q : values.quadrature_point_indices())
        sum -= values.JxW(q) * pressure(of_q, q) * trace(gradient(u, q));
      return sum;
    }

    /// p.Mq
    double
    mass(const std::vector<double> &of_p, const std::vector<double> &of_q) const
    {
      double sum = 0.;
      for (const unsigned int q : values.quadrature_point_indices())
        sum += values.JxW(q) * pressure(of_p, q) * pressure(of_q, q);
      return sum;
    }

    /// p^2 at the points, the same on all cells
    std::vector<double>
    squares(const std::vector<double> &of_p) const
    {
      std::vector<double> result;
      for (const unsigned int q : values.quadrature_point_indices())
        {
          const double p = pressure(of_p, q);
          result.push_back(p * p);
        }
      return result;
    }

    /// p.Mp of several p, given by their squares() at the points
    std::vector<double>
    masses(const std::vector<std::vector<double>> &squares) const
    {
      std::vector<double> result;
      for (const auto &square : squares)
        result.push_back(std::inner_product(
          square.begin(), square.end(), values.get_JxW_values().begin(), 0.));
      return result;
    }

    /// [K G^T; G M] of few functions, the components of N_i beside each other.
    FullMatrix<double>
    matrix() const
    {
      const unsigned int n = values.dofs_per_cell,
                         m = pressures ? pressures->dofs_per_cell : 0;
      const Moduli C = std::visit([](const auto &law) { return moduli(law); },
                                  body.material.displacement_law());
      FullMatrix<double> result(dim * n + m);
      for (const unsigned int q : values.quadrature_point_indices())
        for (unsigned int i = 0; i < dim * n; ++i)
          {
            const Tensor<1, dim> g =
              values.JxW(q) * values.shape_grad(i / dim, q);
            std::array<Tensor<1, dim>, dim> tested; // with those of component d
            for (unsigned int d = 0; d < dim; ++d)
              for (unsigned int e = 0; e < dim; ++e)
                for (unsigned int f = 0; f < dim; ++f)
                  tested[d][f] += C[i % dim][e][d][f] * g[e];
            for (unsigned int j = 0; j < dim * n; ++j)
              result(i, j) += tested[j % dim] * values.shape_grad(j / dim, q);
            for (unsigned int k = 0; k < m; ++k)
              {
                result(dim * n + k, i) -=
                  pressures->shape_value(k, q) * g[i % dim];
                result(i, dim * n + k) = result(dim * n + k, i);
              }
          }
      for (const unsigned int q : values.quadrature_point_indices())
        for (unsigned int k = 0; k < m; ++k)
          for (unsigned int l = 0; l < m; ++l)
            result(dim * n + k, dim * n + l) += values.JxW(q) *
                                                pressures->shape_value(k, q) *
                                                pressures->shape_value(l, q);
      return result;
    }

  private:
    Tensor<2, dim>
    gradient(const Coefficients &u, const unsigned int q) const
    {
      Tensor<2, dim> result;
      for (unsigned int i = 0; i < values.dofs_per_cell; ++i)
        for (unsigned int c = 0; c < dim; ++c)
          result[c] += u[c][i] * values.shape_grad(i, q);
      return result;
    }

    double
    pressure(const std::vector<double> &p, const unsigned int q) const
    {
      double result = 0.;
      for (unsigned int k = 0; k < p.size(); ++k)
        if (p[k] != 0.)
          result += p[k] * pressures->shape_value(k, q);
      return result;
    }

    const Body                    &body;
    FEValues<dim>                  values;
    std::unique_ptr<FEValues<dim>> pressures;
  };
} // namespace mortise::testing
