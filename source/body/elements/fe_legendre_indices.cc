// The numbering of an FE_Legendre by its 1D factors, see fe_legendre.h.
#include <deal.II/fe/fe_tools.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/legendre_basis.h>

namespace mortise
{
  using namespace dealii;

  std::vector<unsigned int>
  cell_dof_indices(const unsigned int degree)
  {
    const unsigned int n = degree + 1;
    const auto         places =
      FETools::hierarchic_to_lexicographic_numbering<3>(degree);
    std::vector<unsigned int> dofs(places.size());
    for (unsigned int dof = 0; dof < places.size(); ++dof)
      {
        const unsigned int i =
          lexicographic_to_lobatto(degree, places[dof] % n);
        const unsigned int j =
          lexicographic_to_lobatto(degree, places[dof] / n % n);
        const unsigned int k =
          lexicographic_to_lobatto(degree, places[dof] / (n * n));
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
} // namespace mortise
