// See scaled_residual.h.
#include <mortise/solvers/scaled_residual.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// 1 / d for each positive entry of the diagonal of a (+ b), 1 elsewhere.
    Vector
    inverse_diagonal(const IndexSet &owned, const SparseMatrix &a, const SparseMatrix *b, MPI_Comm comm)
    {
      Vector result(owned, comm);
      for (const auto i : owned)
        {
          const double d = a.diag_element(i) + (b != nullptr ? b->diag_element(i) : 0.);
          result[i]      = d > 0. ? 1. / d : 1.;
        }
      result.compress(VectorOperation::insert);
      return result;
    }

    double
    weighted_square(const Vector &r, const Vector &weight)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < r.locally_owned_size(); ++i)
        {
          const double value = r.trilinos_vector()[0][i];
          sum += value * value * weight.trilinos_vector()[0][i];
        }
      return Utilities::MPI::sum(sum, r.get_mpi_communicator());
    }
  } // namespace

  ScaledResidual::ScaledResidual(const BlockSystem &system)
    : system(system)
    , interface_present(system.owned_multiplier.size() > 0)
  {
    inverse_diagonal_u = inverse_diagonal(system.owned_displacement,
                                          system.stiffness,
                                          interface_present ? &system.jump_penalty : nullptr,
                                          system.communicator);
    if (interface_present)
      inverse_diagonal_lambda = inverse_diagonal(system.owned_multiplier,
                                                 system.multiplier_norm,
                                                 nullptr,
                                                 system.communicator);
    rhs_norm = norm(system.load, system.coupling_rhs);
  }

  void
  ScaledResidual::compute(const Vector &u, const Vector &lambda, Vector &r_u, Vector &r_lambda) const
  {
    system.stiffness.vmult(r_u, u);
    if (interface_present)
      {
        system.coupling.Tvmult_add(r_u, lambda);
        system.coupling.vmult(r_lambda, u);
        r_lambda.sadd(-1., 1., system.coupling_rhs);
      }
    r_u.sadd(-1., 1., system.load);
  }

  double
  ScaledResidual::norm(const Vector &r_u, const Vector &r_lambda) const
  {
    double square = weighted_square(r_u, inverse_diagonal_u);
    if (interface_present)
      square += weighted_square(r_lambda, inverse_diagonal_lambda);
    return std::sqrt(square);
  }
} // namespace mortise
