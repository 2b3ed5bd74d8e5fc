#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/precondition.h>

#include <mortise/solvers/krylov/pressure_preconditioner.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Steps and the range of eigenvalues of diag(P)^{-1} P, whose condition is
    /// that of a mass matrix: it grows neither with the mesh nor, in this
    /// basis, much with the degree.
    constexpr unsigned int polynomial_degree = 6;
    constexpr double       polynomial_range  = 20.;
  } // namespace

  struct PressurePreconditioner::Polynomial
  {
    struct Matrix : Subscriptor
    {
      explicit Matrix(const BulkSystem &bulk)
        : bulk(bulk)
      {}

      types::global_dof_index
      m() const
      {
        return bulk.pressure_norm_diagonal().size();
      }

      double
      el(const types::global_dof_index i, const types::global_dof_index) const
      {
        return bulk.pressure_norm_diagonal()(i);
      }

      void
      vmult(Vector &dst, const Vector &src) const
      {
        bulk.apply_pressure_norm(dst, src);
      }

      const BulkSystem &bulk;
    };

    using Diagonal  = DiagonalMatrix<Vector>;
    using Chebyshev = PreconditionChebyshev<Matrix, Vector, Diagonal>;

    explicit Polynomial(const BulkSystem &bulk)
      : matrix(bulk)
    {
      const Vector &diagonal = bulk.pressure_norm_diagonal();
      const double  least    = Utilities::MPI::min(
        diagonal.locally_owned_size() == 0 ?
          1. :
          *std::min_element(diagonal.begin(),
                            diagonal.begin() + diagonal.locally_owned_size()),
        diagonal.get_mpi_communicator());
      valid = least > 0.;
      if (!valid)
        return;
      typename Chebyshev::AdditionalData data(polynomial_degree,
                                              polynomial_range);
      data.preconditioner = std::make_shared<Diagonal>();
      auto &inverse       = data.preconditioner->get_vector();
      inverse.reinit(diagonal);
      for (unsigned int i = 0; i < diagonal.locally_owned_size(); ++i)
        inverse.local_element(i) = 1. / diagonal.local_element(i);
      chebyshev.initialize(matrix, data);
    }

    Matrix    matrix;
    Chebyshev chebyshev;
    bool      valid;
  };

  PressurePreconditioner::PressurePreconditioner(const BlockSystem &system)
    : polynomial(std::make_unique<Polynomial>(*system.bulk))
  {}

  PressurePreconditioner::~PressurePreconditioner() = default;

  bool
  PressurePreconditioner::is_valid() const
  {
    return polynomial->valid;
  }

  void
  PressurePreconditioner::vmult(Vector &dst, const Vector &src) const
  {
    polynomial->chebyshev.vmult(dst, src);
  }

  std::string
  PressurePreconditioner::description() const
  {
    return "mass of pressures by a polynomial";
  }
} // namespace mortise
