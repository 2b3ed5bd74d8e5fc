#include <mortise/body/elements/fe_hierarchical.h>
#include <mortise/body/elements/simplex_basis.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Null for elements of another family.
    const FE_Hierarchical *
    relative(const FE_Hierarchical &element, const FiniteElement<3> &other)
    {
      return other.reference_cell() == element.reference_cell() ?
               dynamic_cast<const FE_Hierarchical *>(&other) :
               nullptr;
    }

    /// The least degree; deal.II's exception for elements of another family.
    unsigned int
    common_degree(const FE_Hierarchical &element, const FiniteElement<3> &other)
    {
      AssertThrow(relative(element, other) != nullptr,
                  FiniteElement<3>::ExcInterpolationNotImplemented());
      return std::min(element.degree, other.degree);
    }

    FE_Hierarchical::Identities
    first_modes(const unsigned int n)
    {
      FE_Hierarchical::Identities identities;
      for (unsigned int i = 0; i < n; ++i)
        identities.emplace_back(i, i);
      return identities;
    }
  } // namespace

  FE_Hierarchical::FE_Hierarchical(const ScalarPolynomialsBase<3> &functions,
                                   const FiniteElementData<3>     &data)
    : FE_Poly<3>(functions,
                 data,
                 std::vector<bool>(data.n_dofs_per_cell(), true),
                 std::vector<ComponentMask>(data.n_dofs_per_cell(),
                                            std::vector<bool>(1, true)))
  {}

  FE_Hierarchical::FE_Hierarchical(const FE_Hierarchical &other)
    : FE_Poly<3>(other)
  {}

  FE_Hierarchical::Identities
  FE_Hierarchical::hp_vertex_dof_identities(const FiniteElement<3> &other) const
  {
    common_degree(*this, other);
    return first_modes(1);
  }

  FE_Hierarchical::Identities
  FE_Hierarchical::hp_line_dof_identities(const FiniteElement<3> &other) const
  {
    return first_modes(common_degree(*this, other) - 1);
  }

  FE_Hierarchical::Identities
  FE_Hierarchical::hp_quad_dof_identities(const FiniteElement<3> &other,
                                          const unsigned int) const
  {
    const unsigned int n = common_degree(*this, other) - 1;
    if (this->reference_cell() == ReferenceCells::Tetrahedron)
      return first_modes(n_face_modes(n + 1));
    Identities identities;
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        identities.emplace_back(i + (this->degree - 1) * j,
                                i + (other.degree - 1) * j);
    return identities;
  }

  FiniteElementDomination::Domination
  FE_Hierarchical::compare_for_domination(const FiniteElement<3> &other,
                                          const unsigned int) const
  {
    if (relative(*this, other) == nullptr)
      return FiniteElementDomination::no_requirements;
    if (this->degree == other.degree)
      return FiniteElementDomination::either_element_can_dominate;
    return this->degree < other.degree ?
             FiniteElementDomination::this_element_dominates :
             FiniteElementDomination::other_element_dominates;
  }

  void
  FE_Hierarchical::convert_generalized_support_point_values_to_dof_values(
    const std::vector<dealii::Vector<double>> &values,
    std::vector<double>                       &dof_values) const
  {
    const unsigned int n = this->n_dofs_per_cell();
    AssertDimension(values.size(), n);
    AssertDimension(dof_values.size(), n);
    const std::lock_guard<std::mutex> lock(mutex);
    if (nodes_to_modes.m() == 0)
      {
        modes_to_nodes.reinit(n, n);
        for (unsigned int q = 0; q < n; ++q)
          {
            const auto at_node =
              values_at(*this->poly_space, this->generalized_support_points[q]);
            std::copy(at_node.begin(), at_node.end(), &modes_to_nodes(q, 0));
          }
        nodes_to_modes.reinit(n, n);
        nodes_to_modes.invert(modes_to_nodes);
      }
    dealii::Vector<double> at_nodes(n), modes(n), rest(n);
    for (unsigned int q = 0; q < n; ++q)
      at_nodes(q) = values[q][0];
    nodes_to_modes.vmult(modes, at_nodes);
    // and what the rounding of the inverse has left
    modes_to_nodes.residual(rest, modes, at_nodes);
    nodes_to_modes.vmult(modes, rest, true);
    std::copy(modes.begin(), modes.end(), dof_values.begin());
  }
} // namespace mortise
