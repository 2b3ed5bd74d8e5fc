#include <deal.II/fe/fe_poly.h>

#include <deal.II/grid/manifold.h>

#include <mortise/body/elements/fe_simplex_legendre.h>
#include <mortise/body/elements/simplex_mapping.h>

#include "simplex_blending.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The polynomials that are one at one interpolation point and zero at the
    /// others, as combinations of the modes.
    class NodalPolynomials : public ScalarPolynomialsBase<3>
    {
    public:
      explicit NodalPolynomials(const unsigned int degree)
        : ScalarPolynomialsBase<3>(degree,
                                   (degree + 1) * (degree + 2) * (degree + 3) /
                                     6)
        , modal(degree, {{0, 1, 2, 3}})
        , modes(this->n(), this->n())
      {
        const auto         nodes = simplex_interpolation_points(degree);
        FullMatrix<double> at_nodes(this->n(), this->n());
        for (unsigned int q = 0; q < this->n(); ++q)
          for (unsigned int i = 0; i < this->n(); ++i)
            at_nodes(q, i) = modal.compute_value(i, nodes[q]);
        modes.invert(at_nodes);
      }

      void
      evaluate(const Point<3>            &point,
               std::vector<double>       &values,
               std::vector<Tensor<1, 3>> &gradients,
               std::vector<Tensor<2, 3>> &hessians,
               std::vector<Tensor<3, 3>> &third_derivatives,
               std::vector<Tensor<4, 3>> &fourth_derivatives) const override
      {
        modal.evaluate(point,
                       values,
                       gradients,
                       hessians,
                       third_derivatives,
                       fourth_derivatives);
        combine(values);
        combine(gradients);
        combine(hessians);
      }

      double
      compute_value(const unsigned int i, const Point<3> &x) const override
      {
        double     sum    = 0.;
        const auto values = values_at(modal, x);
        for (unsigned int k = 0; k < this->n(); ++k)
          sum += modes(k, i) * values[k];
        return sum;
      }

      Tensor<1, 3>
      compute_1st_derivative(const unsigned int i,
                             const Point<3>    &x) const override
      {
        Tensor<1, 3>              sum;
        std::vector<Tensor<1, 3>> gradients;
        values_at(modal, x, &gradients);
        for (unsigned int k = 0; k < this->n(); ++k)
          sum += modes(k, i) * gradients[k];
        return sum;
      }

      Tensor<1, 3>
      compute_grad(const unsigned int i, const Point<3> &x) const override
      {
        return compute_1st_derivative(i, x);
      }

      // What a mapping never asks for one by one.
      Tensor<2, 3>
      compute_2nd_derivative(const unsigned int,
                             const Point<3> &) const override
      {
        AssertThrow(false, ExcNotImplemented());
        return {};
      }
      Tensor<3, 3>
      compute_3rd_derivative(const unsigned int,
                             const Point<3> &) const override
      {
        AssertThrow(false, ExcNotImplemented());
        return {};
      }
      Tensor<4, 3>
      compute_4th_derivative(const unsigned int,
                             const Point<3> &) const override
      {
        AssertThrow(false, ExcNotImplemented());
        return {};
      }
      Tensor<2, 3>
      compute_grad_grad(const unsigned int, const Point<3> &) const override
      {
        AssertThrow(false, ExcNotImplemented());
        return {};
      }

      std::unique_ptr<ScalarPolynomialsBase<3>>
      clone() const override
      {
        return std::make_unique<NodalPolynomials>(*this);
      }

      std::string
      name() const override
      {
        return "SimplexNodal";
      }

    private:
      template <typename Number>
      void
      combine(std::vector<Number> &functions) const
      {
        if (functions.empty())
          return;
        const std::vector<Number> modal_functions = functions;
        for (unsigned int i = 0; i < this->n(); ++i)
          {
            functions[i] = modes(0, i) * modal_functions[0];
            for (unsigned int k = 1; k < this->n(); ++k)
              functions[i] += modes(k, i) * modal_functions[k];
          }
      }

      SimplexLegendrePolynomials modal;
      FullMatrix<double>         modes; ///< of the functions, one per column
    };

    /// Positions of one cell; it does not connect cells.
    class FE_Positions : public FE_Poly<3>
    {
    public:
      explicit FE_Positions(const unsigned int degree)
        : FE_Positions(NodalPolynomials(degree))
      {}

      std::unique_ptr<FiniteElement<3>>
      clone() const override
      {
        return std::make_unique<FE_Positions>(this->degree);
      }

      std::string
      get_name() const override
      {
        return "FE_Positions<3>(" + std::to_string(this->degree) + ")";
      }

    private:
      explicit FE_Positions(const NodalPolynomials &polynomials)
        : FE_Poly<3>(polynomials,
                     FiniteElementData<3>({0, 0, 0, polynomials.n()},
                                          ReferenceCells::Tetrahedron,
                                          1,
                                          polynomials.degree(),
                                          FiniteElementData<3>::L2),
                     std::vector<bool>(polynomials.n(), true),
                     std::vector<ComponentMask>(polynomials.n(),
                                                std::vector<bool>(1, true)))
      {
        this->unit_support_points =
          simplex_interpolation_points(polynomials.degree());
      }
    };
  } // namespace

  SimplexMapping::SimplexMapping(const unsigned int      degree,
                                 const Triangulation<3> &triangulation)
    : SimplexMapping(degree,
                     triangulation,
                     [blending = SimplexBlending(
                        degree)](const CellIterator &cell,
                                 const std::vector<Point<3>> &) mutable {
                       return blending.points(cell);
                     })
  {}

  SimplexMapping::SimplexMapping(const unsigned int      degree,
                                 const Triangulation<3> &triangulation,
                                 const PointsOfCell     &points_of_cell)
    : MappingFE<3>(FE_Positions(degree))
    , nodal(std::make_shared<NodalPolynomials>(degree))
  {
    const auto nodes = simplex_interpolation_points(degree);
    auto       all   = std::make_shared<Points>(triangulation.n_active_cells());
    for (const auto &cell : triangulation.active_cell_iterators())
      if (!cell->is_artificial())
        (*all)[cell->active_cell_index()] = points_of_cell(cell, nodes);
    points = all;
  }

  std::vector<Point<3>>
  SimplexMapping::reference_nodes() const
  {
    return simplex_interpolation_points(nodal->degree());
  }

  std::vector<Point<3>>
  SimplexMapping::compute_mapping_support_points(const CellIterator &cell) const
  {
    const unsigned int index = cell->active_cell_index();
    Assert(index < points->size() && !(*points)[index].empty(),
           ExcMessage("SimplexMapping: the mesh has changed"));
    return (*points)[index];
  }

  Point<3>
  SimplexMapping::transform_unit_to_real_cell(const CellIterator &cell,
                                              const Point<3>     &point) const
  {
    const auto  values = values_at(*nodal, point);
    const auto &nodes  = (*points)[cell->active_cell_index()];
    Point<3>    x;
    for (unsigned int i = 0; i < values.size(); ++i)
      x += values[i] * nodes[i];
    return x;
  }

  Point<3>
  SimplexMapping::transform_real_to_unit_cell(const CellIterator &cell,
                                              const Point<3>     &point) const
  {
    constexpr unsigned int max_iterations = 30;

    const auto               &nodes = (*points)[cell->active_cell_index()];
    std::vector<Tensor<1, 3>> gradients;
    Point<3>                  unit(0.25, 0.25, 0.25);
    for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
      {
        const auto   values = values_at(*nodal, unit, &gradients);
        Tensor<1, 3> rest   = point;
        Tensor<2, 3> jacobian;
        for (unsigned int i = 0; i < values.size(); ++i)
          {
            rest -= values[i] * nodes[i];
            jacobian += outer_product(nodes[i], gradients[i]);
          }
        if (!(std::abs(determinant(jacobian)) > 0.))
          break;
        const Tensor<1, 3> step = invert(jacobian) * rest;
        unit += step;
        // far away the polynomial means nothing
        if (!(unit.norm() < 10.))
          break;
        if (step.norm() < 1e-8)
          return unit;
      }
    AssertThrow(false, ExcTransformationFailed());
    return unit;
  }
} // namespace mortise
