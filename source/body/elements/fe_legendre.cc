#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/tensor_product_polynomials.h>

#include <deal.II/fe/fe_tools.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/legendre_basis.h>

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
  } // namespace

  FE_Legendre::FE_Legendre(const unsigned int degree)
    : FE_Hierarchical(polynomial_space(degree), element_data(degree))
  {
    this->generalized_support_points =
      QGaussLobatto<3>(degree + 1).get_points();

    // A face in non-standard orientation (flag false) is seen with its two
    // directions swapped: mode (i,j) of the cell is mode (j,i) of the quad.
    // Flips and rotations would change signs; consistently ordered cells do not
    // have them.
    const unsigned int n = degree - 1;
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

  std::vector<unsigned int>
  cell_dof_indices(const unsigned int degree)
  {
    const unsigned int n = degree + 1;
    const auto         positions =
      FETools::hierarchic_to_lexicographic_numbering<3>(degree);
    std::vector<unsigned int> dofs(positions.size());
    for (unsigned int dof = 0; dof < positions.size(); ++dof)
      {
        const unsigned int i =
          lexicographic_to_lobatto(degree, positions[dof] % n);
        const unsigned int j =
          lexicographic_to_lobatto(degree, positions[dof] / n % n);
        const unsigned int k =
          lexicographic_to_lobatto(degree, positions[dof] / (n * n));
        dofs[i + n * (j + n * k)] = dof;
      }
    return dofs;
  }

  std::vector<unsigned int>
  face_dof_indices(const unsigned int degree, const unsigned int face_no)
  {
    AssertIndexRange(face_no, 6);
    const unsigned int              n          = degree + 1;
    const unsigned int              d          = face_no / 2;
    const std::vector<unsigned int> cell       = cell_dof_indices(degree);
    const unsigned int              strides[3] = {1, n, n * n};
    std::vector<unsigned int>       dofs(n * n);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        dofs[i + n * j] =
          cell[(face_no % 2) * strides[d] + i * strides[(d + 1) % 3] +
               j * strides[(d + 2) % 3]];
    return dofs;
  }

  namespace
  {
    /// Of a cell of @p degree, with the matrix along(d) in each direction d.
    template <typename Along>
    std::vector<double>
    transform(const unsigned int         degree,
              const std::vector<double> &coefficients,
              const Along               &along)
    {
      const unsigned int              n    = degree + 1;
      const std::vector<unsigned int> dofs = cell_dof_indices(degree);
      AssertDimension(coefficients.size(), dofs.size());
      std::vector<double> tensor(dofs.size()), result(dofs.size());
      for (unsigned int l = 0; l < dofs.size(); ++l)
        tensor[l] = coefficients[dofs[l]];
      for (unsigned int d = 0, stride = 1; d < 3; ++d, stride *= n)
        {
          const FullMatrix<double> &matrix = along(d);
          const std::vector<double> before = tensor;
          for (unsigned int l = 0; l < tensor.size(); ++l)
            {
              const unsigned int i = l / stride % n;
              tensor[l]            = 0.;
              for (unsigned int j = 0; j < n; ++j)
                tensor[l] += matrix(i, j) * before[l + j * stride - i * stride];
            }
        }
      for (unsigned int l = 0; l < dofs.size(); ++l)
        result[dofs[l]] = tensor[l];
      return result;
    }
  } // namespace

  std::vector<double>
  embed_in_child(const unsigned int         degree,
                 const unsigned int         child,
                 const std::vector<double> &parent)
  {
    return transform(degree,
                     parent,
                     [&](const unsigned int d) -> const FullMatrix<double> & {
                       return lobatto_restriction(child >> d & 1);
                     });
  }

  std::vector<double>
  merge_from_child(const unsigned int         degree,
                   const unsigned int         child,
                   const std::vector<double> &of_child)
  {
    const std::array<FullMatrix<double>, 2> halves = {
      {lobatto_merging(degree, 0), lobatto_merging(degree, 1)}};
    return transform(degree,
                     of_child,
                     [&](const unsigned int d) -> const FullMatrix<double> & {
                       return halves[child >> d & 1];
                     });
  }
} // namespace mortise
