#include <deal.II/lac/vector.h>

#include <mortise/base/tensor_product.h>
#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/simplex_elements.h>
#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/body/spaces/nodal_space.h>
#include <mortise/operators/cells/cell_order.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    void
    multiply(const FullMatrix<double> &matrix, std::vector<double> &values)
    {
      const dealii::Vector<double> in(values.begin(), values.end());
      dealii::Vector<double>       out(values.size());
      matrix.vmult(out, in);
      std::copy(out.begin(), out.end(), values.begin());
    }
  } // namespace

  void
  transform_along_lines(const FullMatrix<double> &matrix,
                        std::vector<double>      &values)
  {
    const unsigned int n = matrix.n();
    values =
      apply_product(matrix, matrix, matrix, {{{n, n, n}}, std::move(values)})
        .values;
  }

  CellOrder::CellOrder(const FiniteElement<dim> &element)
    : degree(element.degree)
    , tetrahedra(element.reference_cell() == ReferenceCells::Tetrahedron)
    , scalar(
        tetrahedra ?
          ascending_dof_indices(degree, SimplexElements::base(element).order) :
          cell_dof_indices(degree))
    , values(scalar.size())
  {
    for (unsigned int c = 0; c < element.n_components(); ++c)
      for (const unsigned int i : scalar)
        modes[c].push_back(element.component_to_system_index(c, i));
  }

  void
  CellOrder::transform_to_nodes()
  {
    if (tetrahedra)
      multiply(simplex_modes_to_nodes(degree), values);
    else
      transform_along_lines(modes_to_nodes(degree), values);
  }

  void
  CellOrder::transform_to_modes()
  {
    if (tetrahedra)
      multiply(simplex_nodes_to_modes(degree), values);
    else
      transform_along_lines(nodes_to_modes(degree), values);
  }

  void
  CellOrder::transform_functional_to_nodes()
  {
    if (tetrahedra)
      multiply(transposed(simplex_nodes_to_modes(degree)), values);
    else
      transform_along_lines(transposed(nodes_to_modes(degree)), values);
  }
} // namespace mortise
