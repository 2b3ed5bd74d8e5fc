#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_tools.h>

#include <Teuchos_BLAS.hpp>
#include <mortise/base/lagrange.h>
#include <mortise/body/elements/hexahedral_mapping.h>
#include <mortise/body/elements/simplex_basis.h>
#include <mortise/body/elements/simplex_mapping.h>
#include <mortise/body/mesh/vertex_order.h>
#include <mortise/operators/cells/cell_geometry.h>

#include <array>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Nodes this close to those of the straight cell, relative to its size,
    /// differ by rounding.
    constexpr double rounding = 1e-13;

    void
    fill_tables(const ScalarPolynomialsBase<dim> &polynomials,
                const Quadrature<dim>            &quadrature,
                std::vector<double>              &value_table,
                std::vector<double>              &gradient_table)
    {
      const unsigned int n = polynomials.n();
      gradient_table.resize(quadrature.size() * dim * n);
      std::vector<Tensor<1, dim>> gradients;
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const auto values =
            values_at(polynomials, quadrature.point(q), &gradients);
          value_table.insert(value_table.end(), values.begin(), values.end());
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int k = 0; k < n; ++k)
              gradient_table[(q * dim + a) * n + k] = gradients[k][a];
        }
    }
  } // namespace

  CellGeometry::CellGeometry(const Body            &body,
                             const ReferenceCell   &shape,
                             const Quadrature<dim> &quadrature)
    : mapping_degree(body.mapping_degree)
    , simplices(dynamic_cast<const SimplexMapping *>(body.mapping.get()))
    , hexahedra(dynamic_cast<const HexahedralMapping *>(body.mapping.get()))
    , result(quadrature.size())
    , points_in_space(quadrature.size())
  {
    Assert((simplices != nullptr) == shape.is_simplex(), ExcInternalError());
    (void)shape;
    if (simplices == nullptr)
      {
        Assert(hexahedra != nullptr && quadrature.is_tensor_product(),
               ExcInternalError());
        const QGaussLobatto<1> nodes(mapping_degree + 1);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const Quadrature<1> &points = quadrature.get_tensor_basis()[d];
            lines[d]                    = {lagrange_values(nodes, points),
                                           lagrange_derivatives(nodes, points)};
          }
        lexicographic =
          FETools::lexicographic_to_hierarchic_numbering<dim>(mapping_degree);
        return;
      }
    for (const Point<dim> &x : simplices->reference_nodes())
      barycentric.push_back(barycentric_coordinates(x));
    fill_tables(simplices->nodal_polynomials(),
                quadrature,
                nodal_values,
                nodal_gradients);
  }

  std::optional<CellGeometry::Jacobian>
  CellGeometry::constant_jacobian(const Body::CellIterator &cell) const
  {
    const bool simplex = simplices != nullptr;
    // the vertex at the end of each axis of the reference cell
    Jacobian jacobian;
    for (unsigned int a = 0; a < dim; ++a)
      jacobian[a] = cell->vertex(simplex ? a + 1 : (1u << a)) - cell->vertex(0);
    const double tolerance = rounding * jacobian.norm();

    if (!simplex)
      {
        if (mapping_degree > 1)
          return {};
        for (const unsigned int v : cell->vertex_indices())
          {
            Tensor<1, dim> rest = cell->vertex(v) - cell->vertex(0);
            for (unsigned int a = 0; a < dim; ++a)
              if (v & (1u << a))
                rest -= jacobian[a];
            if (rest.norm() > tolerance)
              return {};
          }
        return jacobian;
      }
    if (mapping_degree == 1)
      return jacobian;
    const auto &nodes = simplices->nodes(cell);
    for (unsigned int k = 0; k < nodes.size(); ++k)
      {
        Tensor<1, dim> rest = nodes[k];
        for (unsigned int v = 0; v <= dim; ++v)
          rest -= barycentric[k][v] * cell->vertex(v);
        if (rest.norm() > tolerance)
          return {};
      }
    return jacobian;
  }

  const std::vector<CellGeometry::Jacobian> &
  CellGeometry::jacobians(const Body::CellIterator &cell)
  {
    if (simplices == nullptr)
      {
        const auto nodes = lexicographic_nodes(cell);
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int a = 0; a < dim; ++a)
            {
              const auto slope = apply_derivative(lines, a, nodes[c]);
              for (unsigned int q = 0; q < result.size(); ++q)
                result[q][a][c] = slope.values[q];
            }
        return result;
      }
    // J[q][a] = sum_k dN_k/dxi_a x_k: (dim x n) times (n x dim Q), all column
    // major as they lie in memory
    static_assert(sizeof(Point<dim>) == dim * sizeof(double) &&
                  sizeof(Jacobian) == dim * dim * sizeof(double));
    const auto                      &nodes = simplices->nodes(cell);
    const int                        n     = static_cast<int>(nodes.size());
    const Teuchos::BLAS<int, double> blas;
    blas.GEMM(Teuchos::NO_TRANS,
              Teuchos::NO_TRANS,
              dim,
              dim * static_cast<int>(result.size()),
              n,
              1.,
              &nodes[0][0],
              dim,
              nodal_gradients.data(),
              n,
              0.,
              &result[0][0][0],
              dim);
    return result;
  }

  std::array<TensorArray, dim>
  CellGeometry::lexicographic_nodes(const Body::CellIterator &cell) const
  {
    const auto nodes =
      hexahedra->nodes(Triangulation<dim>::cell_iterator(cell));
    const unsigned int           n = mapping_degree + 1;
    std::array<TensorArray, dim> by_component;
    for (unsigned int c = 0; c < dim; ++c)
      {
        by_component[c].n = {{n, n, n}};
        for (const unsigned int i : lexicographic)
          by_component[c].values.push_back(nodes[i][c]);
      }
    return by_component;
  }

  const std::vector<Point<dim>> &
  CellGeometry::points(const Body::CellIterator &cell)
  {
    if (simplices != nullptr)
      {
        const auto &nodes = simplices->nodes(cell);
        for (unsigned int q = 0; q < points_in_space.size(); ++q)
          {
            Tensor<1, dim> x;
            for (unsigned int k = 0; k < nodes.size(); ++k)
              x += nodal_values[q * nodes.size() + k] * nodes[k];
            points_in_space[q] = Point<dim>(x);
          }
        return points_in_space;
      }
    const auto nodes = lexicographic_nodes(cell);
    for (unsigned int c = 0; c < dim; ++c)
      {
        const auto x = apply_derivative(lines, dim, nodes[c]);
        for (unsigned int q = 0; q < points_in_space.size(); ++q)
          points_in_space[q][c] = x.values[q];
      }
    return points_in_space;
  }

  std::string
  tangled_message(const Body &body, const Body::CellIterator &cell)
  {
    std::ostringstream message;
    message
      << "Body " << body.name << ": the cell with centre " << cell->center()
      << " is tangled (its Jacobian is not positive everywhere); every cell must "
         "have a positive volume. Use a finer mesh or a lower degree";
    return message.str();
  }
} // namespace mortise
