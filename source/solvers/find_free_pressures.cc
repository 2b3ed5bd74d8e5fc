#include <deal.II/base/mpi.h>

#include <deal.II/lac/solver_cg.h>

#include <mortise/solvers/find_free_pressures.h>
#include <mortise/solvers/pseudo_random.h>
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
        Vector force;
        system.bulk->initialize(force);
        system.add_multiplier_force(force, src);
        scale(force);
        system.apply_constraint(dst, force);
      }

      void
      scale(Vector &u) const
      {
        u.scale(residual.inverse_diagonal_u());
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
        dst = src;
        dst.scale(residual.inverse_diagonal_lambda());
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
        any.begin()[i] = 1.5 + 0.5 * pseudo_random(i);
      reached = 0.;
      system.add_multiplier_force(reached, any);
      for (unsigned int i = 0; i < reached.locally_owned_size(); ++i)
        if (reached.begin()[i] != 0.)
          outside.begin()[i] = 0.;
      return square(outside, normal);
    }
  } // namespace

  double
  Enclosure::flux(const SystemVector &rhs) const
  {
    double total = 0.;
    for (unsigned int i = 0; i < rhs.pressure.locally_owned_size(); ++i)
      total += std::abs(rhs.pressure.begin()[i] * state.pressure.begin()[i]);
    total = Utilities::MPI::sum(total, rhs.pressure.get_mpi_communicator());
    double net = rhs.pressure * state.pressure;
    if (rhs.multiplier.size() > 0)
      net += rhs.multiplier * state.multiplier; // through interfaces
    return total > 0. ? std::abs(net) / total : 0.;
  }

  Enclosure
  test_enclosure(const BlockSystem &system, const Vector &one)
  {
    const ScaledResidual residual(system);
    const Normal         normal{system, residual};
    Enclosure            result;
    result.state          = system.zero_vector();
    result.state.pressure = one;
    Vector force(result.state.displacement);
    system.bulk->add_pressure_force(force, one);
    // what a pressure on a free boundary would bring is h / L of this norm
    double norm = 0.;
    for (unsigned int i = 0; i < one.locally_owned_size(); ++i)
      norm += one.local_element(i) * one.local_element(i) /
              residual.inverse_diagonal_p().local_element(i);
    norm                   = Utilities::MPI::sum(norm, system.communicator);
    double       left      = square(force, normal);
    const double rounding  = 1e-16 * norm,
                 tolerance = std::max(rounding, 1e-4 * left);
    if (left > rounding && system.owned_multiplier.size() > 0 &&
        outside_of_interfaces(system, force, normal) <= rounding)
      {
        Vector &y = result.state.multiplier;
        Vector  rhs(y), scaled(force);
        normal.scale(scaled);
        system.apply_constraint(rhs, scaled);
        SolverControl control(500, 1e-10 * rhs.l2_norm(), false, false);
        try
          {
            SolverCG<Vector>(control).solve(normal, y, rhs, Jacobi{residual});
          }
        catch (const SolverControl::NoConvergence &)
          {}
        y *= -1.;
        system.add_multiplier_force(force, y);
        left = square(force, normal);
      }
    result.enclosed = left <= tolerance;
    return result;
  }
} // namespace mortise
