#include <deal.II/base/mpi.h>

#include <deal.II/lac/solver_cg.h>

#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/find_free_pressures.h>
#include <mortise/solvers/scaled_residual.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// B D^{-1} B^T with D = diag(K).
    struct Normal
    {
      void
      vmult(Vector &dst, const Vector &src) const
      {
        Vector force(system.owned_displacement, system.communicator);
        system.coupling.Tvmult(force, src);
        scale(force);
        system.coupling.vmult(dst, force);
      }

      void
      scale(Vector &u) const
      {
        const auto &inverse = residual.inverse_diagonal_u();
        for (int i = 0; i < inverse.MyLength(); ++i)
          u.begin()[i] *= inverse[i];
      }

      const BlockSystem    &system;
      const ScaledResidual &residual;
    };

    /// Its diagonal's inverse.
    struct Jacobi
    {
      void
      vmult(Vector &dst, const Vector &src) const
      {
        const auto &inverse = residual.inverse_diagonal_lambda();
        for (int i = 0; i < inverse.MyLength(); ++i)
          dst.begin()[i] = inverse[i] * src.begin()[i];
      }

      const ScaledResidual &residual;
    };
  } // namespace

  EnclosureTest
  test_enclosure(const BlockSystem &system, const Vector &one)
  {
    const ScaledResidual residual(system);
    const Normal         normal{system, residual};
    const auto           square = [&](const Vector &force) {
      Vector scaled(force);
      normal.scale(scaled);
      return force * scaled;
    };
    Vector force(system.owned_displacement, system.communicator);
    system.add_pressure_force(force, one);
    // what a pressure on a free boundary would bring is h / L of this
    SystemSolution diagonal = system.zero_solution();
    for (unsigned int i = 0; i < one.locally_owned_size(); ++i)
      diagonal.pressure.begin()[i] =
        one.begin()[i] / residual.inverse_diagonal_p()[i];
    double       left      = square(force);
    const double rounding  = 1e-16 * (diagonal.pressure * one),
                 tolerance = std::max(rounding, 1e-4 * left);
    if (left > rounding && system.owned_multiplier.size() > 0)
      {
        Vector rhs(system.owned_multiplier, system.communicator), y(rhs);
        Vector scaled(force);
        normal.scale(scaled);
        system.coupling.vmult(rhs, scaled);
        SolverControl control(200, 1e-4 * rhs.l2_norm(), false, false);
        try
          {
            SolverCG<Vector>(control).solve(normal, y, rhs, Jacobi{residual});
          }
        catch (const SolverControl::NoConvergence &)
          {}
        y *= -1.;
        system.coupling.Tvmult_add(force, y);
        left = square(force);
      }
    double total = 0.;
    for (unsigned int i = 0; i < one.locally_owned_size(); ++i)
      total += std::abs(system.pressure_load.begin()[i] * one.begin()[i]);
    total            = Utilities::MPI::sum(total, system.communicator);
    const double net = std::abs(system.pressure_load * one);
    return {left <= tolerance, total > 0. ? net / total : 0.};
  }
} // namespace mortise
