// A displacement, its gradient and a pressure at the quadrature points of
// cells, by sum factorisation on hexahedra.
#pragma once

#include <mortise/operators/cells/cell_geometry.h>
#include <mortise/operators/cells/cell_values.h>

#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace mortise
{
  /// Of the displacement, component by component, and of the pressure in mixed
  /// form, on one cell in the order of the scalar elements.
  using CellCoefficients = std::vector<std::vector<double>>;

  CellCoefficients
  cell_coefficients(const Body               &body,
                    const Body::CellIterator &cell,
                    const BodySolution       &solution);

  class CellFields
  {
  public:
    /// The rule for the cells of an element: a tensor product on hexahedra.
    using Rule = std::function<dealii::Quadrature<dim>(
      const dealii::FiniteElement<dim> &)>;

    /// The body is kept by reference.
    CellFields(const Body &body, const Rule &rule);
    ~CellFields();

    /// Evaluate @p solution on @p cell: fills the members below.
    void
    reinit(const Body::CellIterator &cell, const BodySolution &solution);

    /// The same for given coefficients.
    void
    reinit(const Body::CellIterator &cell,
           const CellCoefficients   &coefficients);

    std::vector<dealii::Point<dim>>     points;
    std::vector<double>                 weights; ///< JxW
    std::vector<dealii::Tensor<1, dim>> values;
    std::vector<dealii::Tensor<2, dim>> gradients; ///< du_c/dx_e as [c][e]
    std::vector<double> pressures;       ///< of the mixed form, else empty
    std::vector<double> thermal_strains; ///< if there are any, else empty
    /// [point][number] of NonlinearLaw::n_history(), else empty.
    std::vector<double> histories;

    /// @p gradient at point @p q without the thermal strain.
    dealii::Tensor<2, dim>
    elastic(const dealii::Tensor<2, dim> &gradient, unsigned int q) const;

    Material::Response
    respond(unsigned int q) const;

    /// The derivative of the nominal stress at point @p q in the direction of a
    /// change of gradient and pressure, where points remember nothing.
    dealii::Tensor<2, dim>
    nominal_change(unsigned int                  q,
                   const dealii::Tensor<2, dim> &change,
                   double                        pressure_change) const;

    /// The product of @p a and @p b, changes of what these fields are of, with the
    /// tangent at point @p q.
    double
    tangent_product(unsigned int      q,
                    const CellFields &a,
                    const CellFields &b) const;

    /// In mixed form the residual of the dilatation at point @p q: ln J or tr e, less what
    /// belongs to the pressure.
    double
    missing_dilatation(unsigned int q) const;

    /// The equivalent plastic strain at point @p q, zero of laws without.
    double
    plastic_strain(unsigned int q) const;

    /// Cauchy's, at point @p q.
    dealii::SymmetricTensor<2, dim>
    stress(unsigned int q) const;

  private:
    /// s of F = s F_e at point @p q; one at small strain.
    double
    thermal_stretch(unsigned int q) const;
    const double *
    history(unsigned int q) const;

    struct Hexahedra;  ///< of one degree
    struct Tetrahedra; ///< of one degree and order of vertices

    void
    evaluate_hexahedron(const Body::CellIterator &cell,
                        const CellCoefficients   &coefficients);
    void
    evaluate_tetrahedron(const Body::CellIterator &cell,
                         const CellCoefficients   &coefficients);
    void
    map_to_space(const std::vector<CellGeometry::Jacobian> &jacobians,
                 const std::vector<double>                 &reference_weights);

    struct Histories
    {
      Histories(const Body &body, const dealii::Quadrature<dim> &given)
        : rule(given)
        , values(body, rule)
      {}

      const dealii::Quadrature<dim> rule;
      HistoryValues                 values;
    };

    const Body                                         &body;
    const Rule                                          rule;
    std::map<unsigned int, std::unique_ptr<Histories>>  by_element;
    std::map<unsigned int, std::unique_ptr<Hexahedra>>  hexahedra;
    std::map<unsigned int, std::unique_ptr<Tetrahedra>> tetrahedra;
  };
} // namespace mortise
