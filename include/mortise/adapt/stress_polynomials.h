// Stresses on the cells of one element as polynomials through their values at
// the points of a rule, to be differentiated, and taken to faces.
#pragma once

#include <deal.II/base/tensor.h>

#include <mortise/operators/cells/cell_geometry.h>

#include <array>
#include <vector>

namespace mortise
{
  class StressPolynomials
  {
  public:
    /// Both are kept by reference.
    StressPolynomials(const Body                       &body,
                      const dealii::FiniteElement<dim> &element);

    /// At whose points stresses are given.
    static dealii::Quadrature<dim>
    nodes(const Body &body, const dealii::FiniteElement<dim> &element);

    /// A finer one for integrals over cells.
    static dealii::Quadrature<dim>
    rule(const Body &body, const dealii::FiniteElement<dim> &element);

    /// At points of rule() on @p cell, a force per volume; @p stresses, nominal
    /// ones, at nodes().
    std::vector<dealii::Tensor<1, dim>>
    divergence(const Body::CellIterator                  &cell,
               const std::vector<dealii::Tensor<2, dim>> &stresses);

    /// Coefficients on face @p f of what has @p stresses at nodes().
    std::vector<dealii::Tensor<2, dim>>
    on_face(unsigned int                               f,
            const std::vector<dealii::Tensor<2, dim>> &stresses) const;

    /// By which those of face @p f are to be multiplied at point @p x of the unit cell, which is on it.
    std::vector<double>
    factors_on_face(unsigned int f, const dealii::Point<dim> &x) const;

    /// Points and Jacobians at rule().
    CellGeometry geometry;

  private:
    void
    prepare_hexahedra(const Body &body);
    void
    prepare_tetrahedra(const Body &body);
    /// Derivatives along the axes of the unit cell at rule(), one axis below
    /// the other; a column for each component.
    dealii::FullMatrix<double>
    slopes(const std::vector<dealii::Tensor<2, dim>> &stresses) const;

    const dealii::FiniteElement<dim> &element;
    const bool                        simplex;
    std::vector<dealii::Point<1>>     line; ///< of hexahedra, nodes()
    std::array<LineTable, dim>        to_rule;
    std::vector<std::vector<double>>  ends;        ///< values at 0 and 1
    dealii::FullMatrix<double>        projection;  ///< of tetrahedra
    dealii::FullMatrix<double>        derivatives; ///< slopes() from values
  };
} // namespace mortise
