#include <deal.II/base/quadrature_lib.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <boost/container/static_vector.hpp>

#include <Teuchos_BLAS.hpp>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/cells/cell_kernel.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  Quadrature<dim>
  stiffness_quadrature(const FiniteElement<dim> &element,
                       const unsigned int        mapping_degree)
  {
    const unsigned int p = element.degree;
    if (element.reference_cell() == ReferenceCells::Hexahedron)
      return QGauss<dim>(p + 1);
    return simplex_quadrature<dim>(p + std::max(p, mapping_degree));
  }

  std::vector<double>
  element_gradients(const FiniteElement<dim> &element,
                    const Quadrature<dim>    &quadrature)
  {
    const ReferenceCell shape = element.reference_cell();
    Triangulation<dim>  unit;
    GridGenerator::reference_cell(unit, shape);
    FEValues<dim> values(shape.get_default_linear_mapping<dim>(),
                         element,
                         quadrature,
                         update_gradients);
    values.reinit(unit.begin_active());

    std::vector<double> table;
    for (const unsigned int q : values.quadrature_point_indices())
      for (unsigned int a = 0; a < dim; ++a)
        for (const unsigned int i : values.dof_indices())
          table.push_back(values.shape_grad(i, q)[a]);
    return table;
  }

  namespace
  {
    /// The upper triangle of A^T A, row major; @p A has @p rows rows of length
    /// @p columns.
    void
    symmetric_product(const std::vector<double> &A,
                      const unsigned int         rows,
                      const unsigned int         columns,
                      std::vector<double>       &product)
    {
      const Teuchos::BLAS<int, double> blas;
      // what is row major here is the transpose in column major order
      blas.SYRK(Teuchos::LOWER_TRI,
                Teuchos::NO_TRANS,
                columns,
                rows,
                1.,
                A.data(),
                columns,
                0.,
                product.data(),
                columns);
    }

    /// R_ab of CellKernel; exact, by a rule of degree 2p on tetrahedra and
    /// 2p + 1 in each direction on hexahedra.
    void
    compute_reference(
      const FiniteElement<dim>                              &element,
      std::array<std::array<std::vector<double>, dim>, dim> &reference)
    {
      const Quadrature<dim> quadrature =
        element.reference_cell() == ReferenceCells::Hexahedron ?
          Quadrature<dim>(QGauss<dim>(element.degree + 1)) :
          simplex_quadrature<dim>(2 * element.degree);
      const unsigned int  n         = element.n_dofs_per_cell();
      std::vector<double> gradients = element_gradients(element, quadrature);
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        for (unsigned int i = 0; i < dim * n; ++i)
          gradients[q * dim * n + i] *= std::sqrt(quadrature.weight(q));
      std::vector<double> products(dim * n * dim * n);
      symmetric_product(gradients, quadrature.size(), dim * n, products);
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              {
                const unsigned int row = a * n + i, column = b * n + j;
                reference[a][b].push_back(
                  products[std::min(row, column) * dim * n +
                           std::max(row, column)]);
              }
    }
  } // namespace

  CellKernel::CellKernel(const Body &body, const FiniteElement<dim> &system)
    : n(system.base_element(0).n_dofs_per_cell())
    , geometry(body,
               system.reference_cell(),
               stiffness_quadrature(system, body.mapping_degree))
    , products(dim * n * dim * n)
    , row(n)
  {
    const Moduli C = std::visit([](const auto &law) { return moduli(law); },
                                body.material.displacement_law());
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = c; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          for (unsigned int f = 0; f < dim; ++f)
            if (C[c][e][d][f] != 0.)
              terms[c][d].push_back({e, f, C[c][e][d][f]});
    const FiniteElement<dim> &element = system.base_element(0);
    const Quadrature<dim>     quadrature =
      stiffness_quadrature(system, body.mapping_degree);
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < n; ++i)
        system_index[c].push_back(system.component_to_system_index(c, i));
    compute_reference(element, reference);
    weights             = quadrature.get_weights();
    reference_gradients = element_gradients(element, quadrature);
    gradients.resize(reference_gradients.size());
  }

  bool
  CellKernel::compute(const Body::CellIterator &cell,
                      FullMatrix<double>       &matrix)
  {
    if (const auto jacobian = geometry.constant_jacobian(cell))
      {
        const double det = determinant(*jacobian);
        if (!(det > 0.))
          return false;
        transform_reference(invert(*jacobian), det);
      }
    else if (!integrate(cell))
      return false;
    combine(matrix);
    return true;
  }

  void
  CellKernel::transform_reference(const CellGeometry::Jacobian &inverse,
                                  const double                  det)
  {
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = c; d < dim; ++d)
        {
          std::array<double, dim * dim>         factor;
          std::array<const double *, dim * dim> R;
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = 0; b < dim; ++b)
              {
                // inverse is (J^-1)_ac as [c][a]
                factor[a * dim + b] = det * inverse[c][a] * inverse[d][b];
                R[a * dim + b]      = reference[a][b].data();
              }
          for (unsigned int i = 0; i < n; ++i)
            {
              double *row = &products[(c * n + i) * dim * n + d * n];
              for (unsigned int j = 0; j < n; ++j)
                {
                  double sum = 0.;
                  for (unsigned int k = 0; k < dim * dim; ++k)
                    sum += factor[k] * R[k][i * n + j];
                  row[j] = sum;
                }
            }
        }
  }

  bool
  CellKernel::integrate(const Body::CellIterator &cell)
  {
    const auto &jacobians = geometry.jacobians(cell);
    for (unsigned int q = 0; q < weights.size(); ++q)
      {
        const double det = determinant(jacobians[q]);
        if (!(det > 0.))
          return false;
        const CellGeometry::Jacobian inverse =
          std::sqrt(weights[q] * det) * invert(jacobians[q]);
        const double *in  = &reference_gradients[q * dim * n];
        double       *out = &gradients[q * dim * n];
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int i = 0; i < n; ++i)
            out[c * n + i] = inverse[c][0] * in[i] + inverse[c][1] * in[n + i] +
                             inverse[c][2] * in[2 * n + i];
      }
    symmetric_product(gradients, weights.size(), dim * n, products);
    return true;
  }

  namespace
  {
    /// A row of a product of gradients, or a column of it, times a modulus.
    struct Source
    {
      const double *from;
      std::size_t   stride;
      double        modulus;
    };

    /// to[j] = the sum of the sources' entries j; @p n_sources: their number, or 0 if it is not known
    /// when this is compiled.
    template <unsigned int n_sources>
    void
    sum(const boost::container::static_vector<Source, 9> &sources,
        const unsigned int                                begin,
        const unsigned int                                end,
        double                                           *to)
    {
      const unsigned int n = n_sources == 0 ? sources.size() : n_sources;
      for (unsigned int j = begin; j < end; ++j)
        {
          double value = 0.;
          for (unsigned int k = 0; k < n; ++k)
            value +=
              sources[k].modulus * sources[k].from[j * sources[k].stride];
          to[j] = value;
        }
    }
  } // namespace

  void
  CellKernel::sum_terms(const unsigned int c,
                        const unsigned int d,
                        const unsigned int i,
                        const unsigned int begin,
                        const unsigned int end)
  {
    const std::size_t                          size = dim * n;
    boost::container::static_vector<Source, 9> sources;
    for (const auto &[e, f, modulus] : terms[c][d])
      // H_ef(i, j) = H_fe(j, i), of which there is that with e < f, or j >= i
      // for e = f
      if (e < f || (e == f && begin >= i))
        sources.push_back({&products[(e * n + i) * size + f * n], 1, modulus});
      else
        sources.push_back({&products[f * n * size + e * n + i], size, modulus});
    switch (sources.size()) // two and three are those of isotropic bodies
      {
        case 2:
          return sum<2>(sources, begin, end, row.data());
        case 3:
          return sum<3>(sources, begin, end, row.data());
        default:
          return sum<0>(sources, begin, end, row.data());
      }
  }

  void
  CellKernel::combine(FullMatrix<double> &matrix)
  {
    const auto splits = [](const Term &term) { return term.e == term.f; };
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = c; d < dim; ++d)
        for (unsigned int i = 0; i < n; ++i)
          {
            // the blocks of the diagonal are symmetric
            const unsigned int first = c == d ? i : 0;
            const bool         split =
              first < i &&
              std::any_of(terms[c][d].begin(), terms[c][d].end(), splits);
            if (split)
              sum_terms(c, d, i, first, i);
            sum_terms(c, d, i, split ? i : first, n);
            const unsigned int index = system_index[c][i];
            for (unsigned int j = first; j < n; ++j)
              {
                const unsigned int column = system_index[d][j];
                matrix(index, column) = matrix(column, index) = row[j];
              }
          }
  }
} // namespace mortise
