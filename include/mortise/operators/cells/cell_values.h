// A displacement on one cell or face at quadrature points.
#pragma once

#include <deal.II/fe/fe_values.h>

#include <mortise/operators/scene_solution.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace mortise
{
  /// Coefficients of the three components on one cell, in the order of the
  /// scalar element.
  inline std::array<std::vector<double>, dim>
  cell_coefficients(const Body::CellIterator &cell,
                    const BodyVector         &displacement)
  {
    const auto                                  &fe = cell->get_fe();
    std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    std::array<std::vector<double>, dim> coefficients;
    for (auto &of_component : coefficients)
      of_component.resize(fe.n_dofs_per_cell() / dim);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        // the inverse, component_to_system_index(), searches
        const auto [c, mode]  = fe.system_to_component_index(i);
        coefficients[c][mode] = displacement(dofs[i]);
      }
    return coefficients;
  }

  /// The same for a scalar field.
  inline std::vector<double>
  scalar_coefficients(const Body::CellIterator &cell, const BodyVector &field)
  {
    std::vector<double> coefficients(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_values(field, coefficients.begin(), coefficients.end());
    return coefficients;
  }

  /// Gradient at point @p q of a function with these coefficients, by component.
  template <typename Values, typename Coefficients>
  dealii::Tensor<2, dim>
  gradient(const Values       &values,
           const Coefficients &coefficients,
           const unsigned int  q)
  {
    dealii::Tensor<2, dim> result;
    for (unsigned int i = 0; i < coefficients[0].size(); ++i)
      {
        const dealii::Tensor<1, dim> shape = values.shape_grad(i, q);
        for (unsigned int c = 0; c < dim; ++c)
          result[c] += coefficients[c][i] * shape;
      }
    return result;
  }

  template <typename Values, typename Coefficients>
  dealii::Tensor<1, dim>
  value(const Values       &values,
        const Coefficients &coefficients,
        const unsigned int  q)
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int i = 0; i < coefficients[0].size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        result[c] += coefficients[c][i] * values.shape_value(i, q);
    return result;
  }

  /// The pressure with @p coefficients on a cell at all points of @p values.
  template <typename Values>
  std::vector<double>
  pressures_at(const Values &values, const std::vector<double> &coefficients)
  {
    std::vector<double> result(values.n_quadrature_points);
    for (unsigned int q = 0; q < result.size(); ++q)
      for (unsigned int i = 0; i < coefficients.size(); ++i)
        result[q] += coefficients[i] * values.shape_value(i, q);
    return result;
  }

  /// FEValues or FEFaceValues of the scalar elements of a body, made when an
  /// element first appears.
  template <typename Values>
  class ValuesByElement
  {
  public:
    using Rule = std::function<dealii::Quadrature<Values::integral_dimension>(
      const dealii::FiniteElement<dim> &)>;

    ValuesByElement(const Body               &body,
                    const Rule               &rule,
                    const dealii::UpdateFlags flags)
      : body(body)
      , rule(rule)
      , flags(flags)
    {}

    Values &
    operator()(const Body::CellIterator &cell)
    {
      auto &values = all[cell->active_fe_index()];
      if (!values)
        {
          const auto &element = cell->get_fe().base_element(0);
          values              = std::make_unique<Values>(*body.mapping,
                                            element,
                                            rule(element),
                                            flags);
        }
      return *values;
    }

  private:
    const Body                                     &body;
    const Rule                                      rule;
    const dealii::UpdateFlags                       flags;
    std::map<unsigned int, std::unique_ptr<Values>> all;
  };
} // namespace mortise
