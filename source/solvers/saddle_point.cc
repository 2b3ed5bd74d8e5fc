// See saddle_point.h.
#include <deal.II/base/timer.h>

#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_parallel_block_vector.h>

#include <mortise/base/timers.h>
#include <mortise/solvers/bulk_preconditioner.h>
#include <mortise/solvers/condensed.h>
#include <mortise/solvers/constraint_projector.h>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/saddle_point.h>
#include <mortise/solvers/scaled_residual.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using BlockVector = TrilinosWrappers::MPI::BlockVector;

    /// W [K B^T; B 0] W with W^2 = diag(D_u, D_lambda)^{-1}: the Euclidean norm
    /// of its residual is the norm that all solvers report.
    class ScaledOperator
    {
    public:
      ScaledOperator(const BlockSystem &system, const ScaledResidual &residual)
        : weight({system.owned_displacement, system.owned_multiplier},
                 system.communicator)
        , system(system)
        , scaled(weight)
      {
        set_root(residual.inverse_diagonal_u(), weight.block(0));
        set_root(residual.inverse_diagonal_lambda(), weight.block(1));
        inverse = weight;
        for (unsigned int b = 0; b < 2; ++b)
          for (unsigned int i = 0; i < inverse.block(b).locally_owned_size();
               ++i)
            epetra(inverse.block(b))[0][i] =
              1. / epetra(inverse.block(b))[0][i];
      }

      void
      vmult(BlockVector &y, const BlockVector &x) const
      {
        scaled = x;
        scaled.scale(weight);
        system.apply_stiffness(y.block(0), scaled.block(0));
        system.coupling.Tvmult_add(y.block(0), scaled.block(1));
        system.coupling.vmult(y.block(1), scaled.block(0));
        y.scale(weight);
      }

      BlockVector weight, inverse; ///< W and W^{-1}

    private:
      static void
      set_root(const Epetra_Vector &square, Vector &root)
      {
        for (int i = 0; i < square.MyLength(); ++i)
          epetra(root)[0][i] = std::sqrt(square[i]);
      }

      const BlockSystem  &system;
      mutable BlockVector scaled;
    };

    /// The block factorisation of [A^ B^T; B 0] with A^ for K + J, its Schur
    /// complement replaced by C = B T B^T and A^{-1} B^T by T B^T: what it
    /// returns satisfies the constraint exactly.
    class BlockPreconditioner
    {
    public:
      BlockPreconditioner(const BlockSystem    &system,
                          const ScaledOperator &scaling)
        : scaling(scaling)
        , bulk(make_bulk_preconditioner(system))
        , valid(bulk->initialize(system))
      {
        if (valid)
          projector =
            std::make_unique<ConstraintProjector>(system, *bulk->lifting());
      }

      void
      vmult(BlockVector &z, const BlockVector &r) const
      {
        BlockVector &t = scratch;
        if (t.n_blocks() == 0)
          t.reinit(r);
        t = r;
        t.scale(scaling.inverse);
        Vector &z_u = z.block(0), &z_l = z.block(1);
        // r_u - B^T y with y = C^{-1} B T r_u
        z_l = 0.;
        projector->project_residual(t.block(0), z_l);
        bulk->vmult(z_u, t.block(0));
        // z_u - T B^T y with y = C^{-1} (B z_u - r_lambda)
        z_l += projector->project(z_u, &t.block(1));
        z.scale(scaling.inverse);
      }

      /// An estimate of e . K e for the error e that belongs to the residual,
      /// which is not scaled.
      double
      error_energy(const BlockVector &r) const
      {
        Vector z(r.block(0)), projected(z), multiplier(r.block(1));
        projector->project_residual(projected, multiplier);
        bulk->vmult(z, projected);
        return z * projected;
      }

      std::string
      description() const
      {
        return "block factorisation: " + bulk->description() +
               "; interface Schur complement factorised";
      }

      bool
      is_valid() const
      {
        return valid;
      }

    private:
      const ScaledOperator                &scaling;
      std::unique_ptr<BulkPreconditioner>  bulk;
      std::unique_ptr<ConstraintProjector> projector;
      bool                                 valid;
      mutable BlockVector                  scratch;
    };
  } // namespace

  SolveReport
  solve_saddle_point(const BlockSystem   &system,
                     const SolverOptions &options,
                     Vector              &u,
                     Vector              &lambda)
  {
    if (system.owned_multiplier.size() == 0) // nothing indefinite about it
      return solve_condensed(system, options, u, lambda);

    constexpr unsigned int max_basis = 60;
    SolveReport            report;
    report.method = "saddle point";
    announce_stage("solver_setup");
    Timer                     timer;
    const ScaledResidual      residual(system);
    const ScaledOperator      matrix(system, residual);
    const BlockPreconditioner preconditioner(system, matrix);
    report.preconditioner = preconditioner.description();
    report.setup_seconds  = timer.wall_time();
    announce_stage("solve");
    timer.restart();

    u.reinit(system.owned_displacement, system.communicator);
    lambda.reinit(system.owned_multiplier, system.communicator);
    const double rhs_norm = residual.right_hand_side_norm();
    const double target   = options.tolerance * rhs_norm;
    double       reached = rhs_norm, goal = 0.9 * target;
    bool         accurate = rhs_norm == 0.;
    BlockVector  x(matrix.weight), r(x);
    // Again from what was reached: rounding makes the recursive residual drift
    // from the true one, and the energy of the error is only looked at here.
    for (unsigned int start = 0;
         start < 5 && preconditioner.is_valid() && !accurate &&
         report.iterations < options.max_iterations;
         ++start)
      {
        residual.compute(u, lambda, r.block(0), r.block(1));
        r.scale(matrix.weight);
        x = 0.;
        SolverControl control(options.max_iterations - report.iterations,
                              goal,
                              false,
                              false);
        const auto    note = [&](const unsigned int iteration,
                              const double       value,
                              const BlockVector &) {
          if (iteration > 0)
            {
              report.history.push_back(value / rhs_norm);
              if (options.monitor)
                options.monitor(report.iterations + iteration,
                                value / rhs_norm);
            }
          return SolverControl::success;
        };
        const auto run = [&](auto &&solver) {
          solver.connect(note);
          try
            {
              solver.solve(matrix, x, r, preconditioner);
            }
          catch (const SolverControl::NoConvergence &)
            {}
        };
        using GMRES  = SolverGMRES<BlockVector>;
        using FGMRES = SolverFGMRES<BlockVector>;
        // flexible where multigrid in single precision is linear to seven
        // digits only
        if (system.nodal)
          run(FGMRES(control, FGMRES::AdditionalData(max_basis)));
        else
          run(GMRES(control, GMRES::AdditionalData(max_basis + 2, true)));
        report.iterations += control.last_step();
        x.scale(matrix.weight);
        u += x.block(0);
        lambda += x.block(1);
        residual.compute(u, lambda, r.block(0), r.block(1));
        reached = residual.norm(r.block(0), r.block(1));
        goal    = std::min(goal, 0.1 * reached);
        system.apply_stiffness(x.block(0), u);
        const double energy = x.block(0) * u;
        accurate            = reached <= target &&
                   preconditioner.error_energy(r) <=
                     std::pow(options.energy_tolerance(), 2) * energy;
      }
    report.relative_residual = reached == 0. ? 0. : reached / rhs_norm;
    report.converged         = reached <= target;
    report.solve_seconds     = timer.wall_time();
    return report;
  }
} // namespace mortise
