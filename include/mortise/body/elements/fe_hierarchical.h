// What the hierarchical finite elements of hexahedra and tetrahedra have in
// common, for FEValues, FESystem and hp::FECollection. Their degrees of freedom
// are modes, not values at points. They never build constraints of a mesh (see
// hp_constraints.h) and know no refinement.
#pragma once

#include <deal.II/fe/fe_poly.h>

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace mortise
{
  /// Scalar, H1-conforming element on the functions of @p FE_Poly. Elements of
  /// one reference cell share what both have on vertices, lines and faces; the
  /// one of lower degree dominates.
  class FE_Hierarchical : public dealii::FE_Poly<3>
  {
  public:
    using Identities = std::vector<std::pair<unsigned int, unsigned int>>;

    FE_Hierarchical(const dealii::ScalarPolynomialsBase<3> &functions,
                    const dealii::FiniteElementData<3>     &data);

    FE_Hierarchical(const FE_Hierarchical &other);

    bool
    hp_constraints_are_implemented() const override
    {
      return true;
    }

    Identities
    hp_vertex_dof_identities(
      const dealii::FiniteElement<3> &other) const override;

    Identities
    hp_line_dof_identities(
      const dealii::FiniteElement<3> &other) const override;

    Identities
    hp_quad_dof_identities(const dealii::FiniteElement<3> &other,
                           unsigned int face_no = 0) const override;

    dealii::FiniteElementDomination::Domination
    compare_for_domination(const dealii::FiniteElement<3> &other,
                           unsigned int codim = 0) const override;

    /// Modes of the polynomial that takes @p values at the generalized support
    /// points, which makes VectorTools::interpolate() usable.
    void
    convert_generalized_support_point_values_to_dof_values(
      const std::vector<dealii::Vector<double>> &values,
      std::vector<double>                       &dof_values) const override;

  private:
    mutable std::mutex mutex; ///< guards the next, which are made on first use
    mutable dealii::FullMatrix<double> modes_to_nodes, nodes_to_modes;
  };

  /// The numbering of @p Element for values at nodes: those of two degrees on a
  /// line or face are different ones, but for the ends.
  template <typename Element>
  class NodesOf : public Element
  {
  public:
    using Element::Element;

    explicit NodesOf(const Element &modes)
      : Element(modes)
    {}

    std::unique_ptr<dealii::FiniteElement<3>>
    clone() const override
    {
      return std::make_unique<NodesOf>(*this);
    }

    FE_Hierarchical::Identities
    hp_line_dof_identities(const dealii::FiniteElement<3> &other) const override
    {
      if (this->degree != other.degree)
        return {};
      return Element::hp_line_dof_identities(other);
    }

    FE_Hierarchical::Identities
    hp_quad_dof_identities(const dealii::FiniteElement<3> &other,
                           const unsigned int face_no = 0) const override
    {
      if (this->degree != other.degree)
        return {};
      return Element::hp_quad_dof_identities(other, face_no);
    }
  };
} // namespace mortise
