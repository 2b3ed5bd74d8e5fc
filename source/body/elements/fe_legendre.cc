#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/tensor_product_polynomials.h>

#include <deal.II/fe/fe_tools.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/legendre_basis.h>

#include <algorithm>
#include <array>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    FiniteElementData<3>
    element_data(const unsigned int p)
    {
      AssertThrow(p >= 1 && p <= max_lobatto_degree,
                  ExcMessage("FE_Legendre: the degree is " + std::to_string(p) +
                             ", allowed is 1 to " +
                             std::to_string(max_lobatto_degree)));
      const std::vector<unsigned int> dofs_per_object = {
        1, p - 1, (p - 1) * (p - 1), (p - 1) * (p - 1) * (p - 1)};
      return FiniteElementData<3>(dofs_per_object,
                                  1,
                                  p,
                                  FiniteElementData<3>::H1);
    }

    TensorProductPolynomials<3>
    polynomial_space(const unsigned int p)
    {
      TensorProductPolynomials<3> space(lobatto_polynomials(p));
      space.set_numbering(FETools::hierarchic_to_lexicographic_numbering<3>(p));
      return space;
    }

    /// For each of the dofs_per_cell (structdim 3) or dofs_per_face (2)
    /// functions, the indices of its 1D factors in the order of
    /// evaluate_lobatto().
    template <int structdim>
    std::vector<std::array<unsigned int, structdim>>
    tensor_indices(const unsigned int degree)
    {
      std::vector<std::array<unsigned int, structdim>> indices;
      for (unsigned int l :
           FETools::hierarchic_to_lexicographic_numbering<structdim>(degree))
        {
          std::array<unsigned int, structdim> index;
          for (unsigned int d = 0; d < structdim; ++d, l /= degree + 1)
            index[d] = lexicographic_to_lobatto(degree, l % (degree + 1));
          indices.push_back(index);
        }
      return indices;
    }

    /// The element as FE_Legendre; deal.II's exception for elements of another
    /// family.
    const FE_Legendre &
    as_legendre(const FiniteElement<3> &fe)
    {
      const FE_Legendre *const legendre =
        dynamic_cast<const FE_Legendre *>(&fe);
      AssertThrow(legendre != nullptr,
                  FiniteElement<3>::ExcInterpolationNotImplemented());
      return *legendre;
    }
  } // namespace

  FE_Legendre::FE_Legendre(const unsigned int degree)
    : FE_Poly<3>(
        polynomial_space(degree),
        element_data(degree),
        std::vector<bool>(element_data(degree).n_dofs_per_cell(), true),
        std::vector<ComponentMask>(element_data(degree).n_dofs_per_cell(),
                                   std::vector<bool>(1, true)))
  {
    initialize_quad_transposition();
    initialize_generalized_support_points();
  }

  void
  FE_Legendre::initialize_quad_transposition()
  {
    // A face in non-standard orientation (flag false) is seen with its two
    // directions swapped: mode (i,j) of the cell is mode (j,i) of the quad.
    // Flips and rotations would change signs; consistently ordered cells do not
    // have them.
    const unsigned int n = this->degree - 1;
    for (auto &table : this->adjust_quad_dof_index_for_face_orientation_table)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int flags = 0; flags < 8; ++flags)
            {
              // deal.II numbers the flags 4*orientation + 2*flip + rotation.
              const bool standard = flags >= 4;
              const int  here     = i + n * j;
              table(i + n * j, flags) =
                (standard ? here : static_cast<int>(j + n * i)) - here;
            }
  }

  void
  FE_Legendre::initialize_generalized_support_points()
  {
    const QGaussLobatto<1> nodes(this->degree + 1);
    const QGaussLobatto<3> points(this->degree + 1);
    this->generalized_support_points = points.get_points();

    FullMatrix<double>  modes_to_nodes(nodes.size(), nodes.size());
    std::vector<double> values(nodes.size());
    for (unsigned int q = 0; q < nodes.size(); ++q)
      {
        evaluate_lobatto(this->degree, nodes.point(q)[0], values.data());
        for (unsigned int k = 0; k < nodes.size(); ++k)
          modes_to_nodes(q, lobatto_to_lexicographic(this->degree, k)) =
            values[k];
      }
    nodes_to_modes.reinit(nodes.size(), nodes.size());
    nodes_to_modes.invert(modes_to_nodes);
  }

  std::unique_ptr<FiniteElement<3>>
  FE_Legendre::clone() const
  {
    return std::make_unique<FE_Legendre>(this->degree);
  }

  std::string
  FE_Legendre::get_name() const
  {
    return "FE_Legendre<3>(" + std::to_string(this->degree) + ")";
  }

  bool
  FE_Legendre::has_support_on_face(const unsigned int shape_index,
                                   const unsigned int face_index) const
  {
    AssertIndexRange(shape_index, this->n_dofs_per_cell());
    AssertIndexRange(face_index, 6);
    // Lexicographic place along the normal: first or last for the two faces.
    unsigned int l = this->get_poly_space_numbering()[shape_index];
    for (unsigned int d = 0; d < face_index / 2; ++d)
      l /= this->degree + 1;
    return l % (this->degree + 1) == (face_index % 2) * this->degree;
  }

  void
  FE_Legendre::get_interpolation_matrix(const FiniteElement<3> &source,
                                        FullMatrix<double>     &matrix) const
  {
    const unsigned int source_degree = as_legendre(source).degree;
    AssertDimension(matrix.m(), this->n_dofs_per_cell());
    AssertDimension(matrix.n(), source.n_dofs_per_cell());
    matrix                   = 0.;
    const auto         own   = cell_dof_indices(this->degree);
    const auto         other = cell_dof_indices(source_degree);
    const unsigned int n     = this->degree + 1;
    const unsigned int m     = source_degree + 1;
    const unsigned int both  = std::min(n, m);
    for (unsigned int k = 0; k < both; ++k)
      for (unsigned int j = 0; j < both; ++j)
        for (unsigned int i = 0; i < both; ++i)
          matrix(own[i + n * (j + n * k)], other[i + m * (j + m * k)]) = 1.;
  }

  namespace
  {
    /// matrix(row, column) = prod_d R_d(i_d(row), j_d(column)); a null factor
    /// is the identity.
    template <int structdim>
    void
    fill_kronecker(
      const std::array<const FullMatrix<double> *, structdim> &factors,
      const unsigned int                                       row_degree,
      const unsigned int                                       column_degree,
      FullMatrix<double>                                      &matrix)
    {
      const auto rows    = tensor_indices<structdim>(row_degree);
      const auto columns = tensor_indices<structdim>(column_degree);
      AssertDimension(matrix.m(), rows.size());
      AssertDimension(matrix.n(), columns.size());
      for (unsigned int r = 0; r < rows.size(); ++r)
        for (unsigned int c = 0; c < columns.size(); ++c)
          {
            double product = 1.;
            for (unsigned int d = 0; d < structdim; ++d)
              product *= factors[d] != nullptr ?
                           (*factors[d])(rows[r][d], columns[c][d]) :
                           (rows[r][d] == columns[c][d] ? 1. : 0.);
            matrix(r, c) = product;
          }
    }
  } // namespace

  void
  FE_Legendre::get_face_interpolation_matrix(const FiniteElement<3> &source,
                                             FullMatrix<double>     &matrix,
                                             const unsigned int) const
  {
    const unsigned int source_degree = as_legendre(source).degree;
    AssertThrow(source_degree >= this->degree,
                ExcInterpolationNotImplemented());
    fill_kronecker<2>({{nullptr, nullptr}},
                      source_degree,
                      this->degree,
                      matrix);
  }

  void
  FE_Legendre::get_subface_interpolation_matrix(const FiniteElement<3> &source,
                                                const unsigned int      subface,
                                                FullMatrix<double>     &matrix,
                                                const unsigned int) const
  {
    const unsigned int source_degree = as_legendre(source).degree;
    AssertThrow(source_degree >= this->degree,
                ExcInterpolationNotImplemented());
    AssertIndexRange(subface, 4);
    fill_kronecker<2>({{&lobatto_restriction(subface % 2),
                        &lobatto_restriction(subface / 2)}},
                      source_degree,
                      this->degree,
                      matrix);
  }

  const FullMatrix<double> &
  FE_Legendre::get_prolongation_matrix(
    const unsigned int       child,
    const RefinementCase<3> &refinement_case) const
  {
    AssertThrow(refinement_case == RefinementCase<3>::isotropic_refinement,
                ExcNotImplemented());
    AssertIndexRange(child, 8);
    const std::lock_guard<std::mutex> lock(mutex);
    FullMatrix<double>               &matrix =
      const_cast<FE_Legendre *>(this)->prolongation[refinement_case - 1][child];
    if (matrix.m() == 0)
      {
        const unsigned int n = this->n_dofs_per_cell();
        matrix.reinit(n, n);
        fill_kronecker<3>({{&lobatto_restriction(child % 2),
                            &lobatto_restriction(child / 2 % 2),
                            &lobatto_restriction(child / 4)}},
                          this->degree,
                          this->degree,
                          matrix);
      }
    return matrix;
  }

  const FullMatrix<double> &
  FE_Legendre::get_restriction_matrix(
    const unsigned int       child,
    const RefinementCase<3> &refinement_case) const
  {
    AssertThrow(refinement_case == RefinementCase<3>::isotropic_refinement,
                ExcNotImplemented());
    AssertIndexRange(child, 8);
    const std::lock_guard<std::mutex> lock(mutex);
    FullMatrix<double>               &matrix =
      const_cast<FE_Legendre *>(this)->restriction[refinement_case - 1][child];
    if (matrix.m() == 0)
      {
        const unsigned int n = this->n_dofs_per_cell();
        matrix.reinit(n, n);
        fill_kronecker<3>({{&lobatto_coarsening(child % 2),
                            &lobatto_coarsening(child / 2 % 2),
                            &lobatto_coarsening(child / 4)}},
                          this->degree,
                          this->degree,
                          matrix);
      }
    return matrix;
  }
  bool
  FE_Legendre::hp_constraints_are_implemented() const
  {
    return true;
  }

  namespace
  {
    using Identities = std::vector<std::pair<unsigned int, unsigned int>>;

    /// Bubbles 2..min(p, q) in structdim directions.
    Identities
    common_bubbles(const unsigned int structdim,
                   const unsigned int p,
                   const unsigned int q)
    {
      Identities         identities;
      const unsigned int n = std::min(p, q) - 1;
      for (unsigned int j = 0; j < (structdim == 2 ? n : 1); ++j)
        for (unsigned int i = 0; i < n; ++i)
          identities.emplace_back(i + (p - 1) * j, i + (q - 1) * j);
      return identities;
    }
  } // namespace

  Identities
  FE_Legendre::hp_vertex_dof_identities(const FiniteElement<3> &other) const
  {
    as_legendre(other);
    return {{0u, 0u}};
  }

  Identities
  FE_Legendre::hp_line_dof_identities(const FiniteElement<3> &other) const
  {
    return common_bubbles(1, this->degree, as_legendre(other).degree);
  }

  Identities
  FE_Legendre::hp_quad_dof_identities(const FiniteElement<3> &other,
                                      const unsigned int) const
  {
    return common_bubbles(2, this->degree, as_legendre(other).degree);
  }

  FiniteElementDomination::Domination
  FE_Legendre::compare_for_domination(const FiniteElement<3> &other,
                                      const unsigned int) const
  {
    const FE_Legendre *const legendre =
      dynamic_cast<const FE_Legendre *>(&other);
    if (legendre == nullptr)
      return FiniteElementDomination::no_requirements;
    if (this->degree < legendre->degree)
      return FiniteElementDomination::this_element_dominates;
    return this->degree == legendre->degree ?
             FiniteElementDomination::either_element_can_dominate :
             FiniteElementDomination::other_element_dominates;
  }

  std::pair<Table<2, bool>, std::vector<unsigned int>>
  FE_Legendre::get_constant_modes() const
  {
    Table<2, bool> modes(1, this->n_dofs_per_cell());
    for (unsigned int v = 0; v < 8; ++v)
      modes(0, v) = true;
    return {modes, {0}};
  }

  void
  FE_Legendre::convert_generalized_support_point_values_to_dof_values(
    const std::vector<dealii::Vector<double>> &values,
    std::vector<double>                       &dof_values) const
  {
    const unsigned int n = this->degree + 1;
    AssertDimension(values.size(), this->n_dofs_per_cell());
    AssertDimension(dof_values.size(), this->n_dofs_per_cell());
    std::vector<double> data(values.size()), line(n);
    for (unsigned int q = 0; q < values.size(); ++q)
      data[q] = values[q][0];
    for (unsigned int d = 0, stride = 1; d < 3; ++d, stride *= n)
      for (unsigned int start = 0; start < data.size(); ++start)
        if (start / stride % n == 0)
          {
            for (unsigned int q = 0; q < n; ++q)
              line[q] = data[start + q * stride];
            for (unsigned int k = 0; k < n; ++k)
              {
                double sum = 0.;
                for (unsigned int q = 0; q < n; ++q)
                  sum += nodes_to_modes(k, q) * line[q];
                data[start + k * stride] = sum;
              }
          }
    const std::vector<unsigned int> lexicographic =
      this->get_poly_space_numbering();
    for (unsigned int i = 0; i < dof_values.size(); ++i)
      dof_values[i] = data[lexicographic[i]];
  }
} // namespace mortise
