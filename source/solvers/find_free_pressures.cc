#include <deal.II/base/mpi.h>

#include <deal.II/lac/solver_cg.h>

#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/find_free_pressures.h>
#include <mortise/solvers/rough.h>
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

    double
    square(const Vector &force, const Normal &normal)
    {
      Vector scaled(force);
      normal.scale(scaled);
      return force * scaled;
    }

    /// The part of the square that no multiplier reaches.
    double
    outside_of_interfaces(const BlockSystem &system,
                          const Vector      &force,
                          const Normal      &normal)
    {
      Vector any(system.owned_multiplier, system.communicator), reached(force),
        outside(force);
      for (unsigned int i = 0; i < any.locally_owned_size(); ++i)
        any.begin()[i] = 1.5 + 0.5 * rough(i);
      system.coupling.Tvmult(reached, any);
      for (unsigned int i = 0; i < reached.locally_owned_size(); ++i)
        if (reached.begin()[i] != 0.)
          outside.begin()[i] = 0.;
      return square(outside, normal);
    }
  } // namespace

  EnclosureTest
  test_enclosure(const BlockSystem &system, const Vector &one)
  {
    const ScaledResidual residual(system);
    const Normal         normal{system, residual};
    Vector               force(system.owned_displacement, system.communicator);
    system.add_pressure_force(force, one);
    // what a pressure on a free boundary would bring is h / L of this norm
    double norm = 0., total_flux = 0.;
    for (unsigned int i = 0; i < one.locally_owned_size(); ++i)
      {
        const double value = one.begin()[i];
        norm += value * value / residual.inverse_diagonal_p()[i];
        total_flux += std::abs(system.pressure_load.begin()[i] * value);
      }
    norm              = Utilities::MPI::sum(norm, system.communicator);
    total_flux        = Utilities::MPI::sum(total_flux, system.communicator);
    double       left = square(force, normal);
    const double rounding  = 1e-16 * norm,
                 tolerance = std::max(rounding, 1e-4 * left);
    double net             = system.pressure_load * one;
    Vector y(system.owned_multiplier, system.communicator);
    if (left > rounding && system.owned_multiplier.size() > 0 &&
        outside_of_interfaces(system, force, normal) <= rounding)
      {
        Vector rhs(y);
        Vector scaled(force);
        normal.scale(scaled);
        system.coupling.vmult(rhs, scaled);
        SolverControl control(500, 1e-5 * rhs.l2_norm(), false, false);
        try
          {
            SolverCG<Vector>(control).solve(normal, y, rhs, Jacobi{residual});
          }
        catch (const SolverControl::NoConvergence &)
          {}
        y *= -1.;
        system.coupling.Tvmult_add(force, y);
        left = square(force, normal);
        net += y * system.coupling_rhs; // what flows through interfaces
      }
    return {left <= tolerance,
            total_flux > 0. ? std::abs(net) / total_flux : 0.};
  }
} // namespace mortise
