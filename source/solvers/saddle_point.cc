// See saddle_point.h.
#include <mortise/solvers/condensed.h>
#include <mortise/solvers/hierarchical_preconditioner.h>
#include <mortise/solvers/saddle_point.h>
#include <mortise/solvers/scaled_residual.h>
#include <mortise/solvers/sparse_factorization.h>

#include <deal.II/base/timer.h>

#include <array>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// (u, lambda) as one vector.
    struct Pair
    {
      Vector u;
      Vector l;

      void
      add(const double a, const Pair &x)
      {
        u.add(a, x.u);
        l.add(a, x.l);
      }

      void
      scale(const double a)
      {
        u *= a;
        l *= a;
      }

      double
      operator*(const Pair &x) const
      {
        return u * x.u + l * x.l;
      }
    };

    /// diag(A^, W)^{-1} with A^ for K + J. Scaling W by 1/2 to 5 takes more iterations (measured).
    class BlockDiagonalPreconditioner
    {
    public:
      explicit BlockDiagonalPreconditioner(const BlockSystem &system)
      {
        valid = bulk.initialize(system);
        valid = multiplier.initialize(system.multiplier_norm.trilinos_matrix()) && valid;
      }

      void
      vmult(Pair &z, const Pair &r) const
      {
        bulk.vmult(z.u, r.u);
        multiplier.solve(const_cast<Epetra_FEVector &>(z.l.trilinos_vector()), r.l.trilinos_vector());
      }

      std::string
      description() const
      {
        return "block diagonal: " + bulk.description() + "; multiplier norm factorised (" +
               multiplier.backend() + ")";
      }

      bool
      is_valid() const
      {
        return valid;
      }

    private:
      bool                       valid = true;
      HierarchicalPreconditioner bulk;
      SparseFactorization        multiplier;
    };
  } // namespace

  /// MINRES as in Elman, Silvester and Wathen, Finite Elements and Fast Iterative Solvers (2014),
  /// algorithm 4.1, with the residual vector carried along so that the stopping test is the
  /// norm that all solvers report.
  class Minres
  {
  public:
    Minres(const BlockSystem                 &system,
           const ScaledResidual              &residual,
           const BlockDiagonalPreconditioner &preconditioner,
           const SolverOptions               &options)
      : system(system)
      , residual(residual)
      , preconditioner(preconditioner)
      , options(options)
    {}

    /// Improve @p x until its residual is below @p target; counts in @p report.
    void
    run(Pair &x, const double target, SolveReport &report) const
    {
      const double rhs_norm = residual.right_hand_side_norm();
      Pair         r{x.u, x.l};
      residual.compute(x.u, x.l, r.u, r.l);
      Pair   v_old = r, v = r, z = r, av = r, w_old = r, w = r, next = r;
      v_old.scale(0.);
      w_old.scale(0.);
      w.scale(0.);
      preconditioner.vmult(z, v);
      double gamma = std::sqrt(z * v), gamma_old = 1.;
      double eta = gamma;
      double s_old = 0., s = 0., c_old = 1., c = 1.;
      while (report.iterations < options.max_iterations && gamma > 0.)
        {
          z.scale(1. / gamma);
          apply(av, z);
          const double delta = av * z;
          // Lanczos: v_{j+1} = A z_j - (delta/gamma_j) v_j - (gamma_j/gamma_{j-1}) v_{j-1}.
          av.add(-delta / gamma, v);
          av.add(-gamma / gamma_old, v_old);
          std::swap(v_old, v);
          std::swap(v, av);
          next = z;
          preconditioner.vmult(z, v);
          const double gamma_new = std::sqrt(std::max(0., z * v));

          const double a0 = c * delta - c_old * s * gamma;
          const double a1 = std::sqrt(a0 * a0 + gamma_new * gamma_new);
          const double a2 = s * delta + c_old * c * gamma;
          const double a3 = s_old * gamma;
          c_old           = c;
          s_old           = s;
          c               = a0 / a1;
          s               = gamma_new / a1;
          next.add(-a3, w_old);
          next.add(-a2, w);
          next.scale(1. / a1);
          std::swap(w_old, w);
          std::swap(w, next);
          x.add(c * eta, w);
          eta *= -s;
          // r_j = s^2 r_{j-1} + eta_j c v_{j+1} / gamma_{j+1}
          r.scale(s * s);
          if (gamma_new > 0.)
            r.add(eta * c / gamma_new, v);
          gamma_old = gamma;
          gamma     = gamma_new;

          const double reached = residual.norm(r.u, r.l);
          ++report.iterations;
          report.history.push_back(reached / rhs_norm);
          if (options.monitor)
            options.monitor(report.iterations, reached / rhs_norm);
          if (!(reached > target))
            break;
        }
    }

  private:
    void
    apply(Pair &y, const Pair &x) const
    {
      system.stiffness.vmult(y.u, x.u);
      system.coupling.Tvmult_add(y.u, x.l);
      system.coupling.vmult(y.l, x.u);
    }

    const BlockSystem                 &system;
    const ScaledResidual              &residual;
    const BlockDiagonalPreconditioner &preconditioner;
    const SolverOptions               &options;
  };

  SolveReport
  solve_saddle_point(const BlockSystem   &system,
                     const SolverOptions &options,
                     Vector              &u,
                     Vector              &lambda)
  {
    if (system.owned_multiplier.size() == 0) // nothing indefinite about it
      return solve_condensed(system, options, u, lambda);

    SolveReport report;
    report.method = "saddle point";
    Timer                             timer;
    const BlockDiagonalPreconditioner preconditioner(system);
    const ScaledResidual              residual(system);
    report.preconditioner = preconditioner.description();
    report.setup_seconds  = timer.wall_time();
    timer.restart();

    u.reinit(system.owned_displacement, system.communicator);
    lambda.reinit(system.owned_multiplier, system.communicator);
    const double target = options.tolerance * residual.right_hand_side_norm();
    const Minres minres(system, residual, preconditioner, options);
    Pair         x{u, lambda}, r{u, lambda};
    double       reached = residual.right_hand_side_norm();
    // The carried residual drifts from the true one by rounding: start again from what was reached.
    for (unsigned int start = 0; start < 3 && preconditioner.is_valid() && reached > target &&
                                 report.iterations < options.max_iterations;
         ++start)
      {
        minres.run(x, 0.9 * target, report);
        residual.compute(x.u, x.l, r.u, r.l);
        reached = residual.norm(r.u, r.l);
      }
    u                        = x.u;
    lambda                   = x.l;
    report.relative_residual = reached == 0. ? 0. : reached / residual.right_hand_side_norm();
    report.converged         = reached <= target;
    report.solve_seconds     = timer.wall_time();
    return report;
  }
} // namespace mortise
