// See saddle_point.h.
#include <deal.II/lac/la_parallel_block_vector.h>
#include <deal.II/lac/solver_gmres.h>

#include <mortise/solvers/krylov/pressure_preconditioner.h>
#include <mortise/solvers/krylov/saddle_point.h>
#include <mortise/solvers/multigrid/degree_multigrid.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using BlockVector = LinearAlgebra::distributed::BlockVector<double>;

    /// Numbers of the blocks.
    constexpr unsigned int u = 0, p = 1, l = 2;

    BlockVector
    as_blocks(const SystemVector &from)
    {
      BlockVector  result(3);
      unsigned int b = 0;
      for (const Vector *part :
           {&from.displacement, &from.pressure, &from.multiplier})
        {
          result.block(b).reinit(*part, true);
          result.block(b++) = *part;
        }
      result.collect_sizes();
      return result;
    }

    void
    add(SystemVector &to, const BlockVector &from)
    {
      to.displacement += from.block(u);
      to.pressure += from.block(p);
      to.multiplier += from.block(l);
    }

    /// W A W with the matrix A of the system and W^2 = diag(D_u, D_p,
    /// D_lambda)^{-1}: the Euclidean norm of its residual is the norm that all
    /// solvers report.
    class ScaledOperator
    {
    public:
      ScaledOperator(const BlockSystem &system, const ScaledResidual &residual)
        : weight(as_blocks({residual.inverse_diagonal_u(),
                            residual.inverse_diagonal_p(),
                            residual.inverse_diagonal_lambda()}))
        , inverse(weight)
        , system(system)
        , tied(system.owned_multiplier.size() > 0)
        , scaled(weight)
      {
        for (unsigned int b = 0; b < 3; ++b)
          for (unsigned int i = 0; i < weight.block(b).locally_owned_size();
               ++i)
            {
              double &root = weight.block(b).local_element(i);
              root         = std::sqrt(root);
              inverse.block(b).local_element(i) = 1. / root;
            }
      }

      void
      vmult(BlockVector &y, const BlockVector &x) const
      {
        scaled = x;
        scaled.scale(weight);
        if (system.mixed())
          system.apply_mixed(y.block(u),
                             y.block(p),
                             scaled.block(u),
                             scaled.block(p));
        else
          system.bulk->apply_stiffness(y.block(u), scaled.block(u));
        if (tied)
          {
            system.add_multiplier_force(y.block(u), scaled.block(l));
            system.apply_constraint(y.block(l), scaled.block(u));
            system.subtract_spring_opening(y.block(l), scaled.block(l));
          }
        y.scale(weight);
      }

      BlockVector weight, inverse; ///< W and W^{-1}

    private:
      const BlockSystem  &system;
      const bool          tied;
      mutable BlockVector scaled;
    };

    /// The block factorisation of [A^ B^T; B -S] with A^ for K, its Schur
    /// complement replaced by C = B T B^T + S and A^{-1} B^T by T B^T: what it
    /// returns satisfies the constraint exactly. Around it the upper triangle
    /// of a block factorisation with the pressures, whose Schur complement is
    /// replaced by -P.
    class BlockPreconditioner
    {
    public:
      BlockPreconditioner(const BlockSystem            &system,
                          const ScaledOperator         &scaling,
                          const DegreeMultigrid        &bulk,
                          const PressurePreconditioner *pressure)
        : system(system)
        , scaling(scaling)
        , bulk(bulk)
        , projector(bulk.projector())
        , pressure(pressure)
      {}

      void
      vmult(BlockVector &z, const BlockVector &r) const
      {
        BlockVector &t = scratch;
        if (t.n_blocks() == 0)
          t.reinit(r);
        t = r;
        t.scale(scaling.inverse);
        Vector &z_u = z.block(u), &z_l = z.block(l);
        if (pressure)
          {
            pressure->vmult(z.block(p), t.block(p));
            system.free_pressures.project(z.block(p));
            system.bulk->add_pressure_force(t.block(u),
                                            z.block(p)); // z_p is minus it
            z.block(p) *= -1.;
          }
        z_l = 0.;
        if (projector) // r_u - B^T y with y = C^{-1} B T r_u
          projector->remove_multipliers(t.block(u), z_l);
        bulk.vmult(z_u, t.block(u));
        if (system.has_springs())
          {
            z_l += bulk.spring_multipliers();
            t.block(l) += opening(bulk.spring_multipliers());
          }
        if (projector) // z_u - T B^T y with y = C^{-1} (B z_u - r_lambda)
          z_l += projector->project(z_u, &t.block(l));
        z.scale(scaling.inverse);
      }

      /// An estimate of the energy of the error that belongs to the residual,
      /// which is not scaled.
      double
      error_energy(const SystemVector &r) const
      {
        Vector z(r.displacement), projected(z), multiplier(r.multiplier);
        if (projector)
          projector->remove_multipliers(projected, multiplier);
        bulk.vmult(z, projected);
        double energy = z * projected;
        if (pressure)
          {
            Vector q(r.pressure);
            pressure->vmult(q, r.pressure);
            energy += q * r.pressure;
          }
        return energy;
      }

    private:
      /// S lambda
      Vector
      opening(const Vector &lambda) const
      {
        Vector result(lambda);
        result = 0.;
        system.subtract_spring_opening(result, lambda);
        result *= -1.;
        return result;
      }

      const BlockSystem            &system;
      const ScaledOperator         &scaling;
      const DegreeMultigrid        &bulk;
      const ConstraintProjector    *projector; ///< null without multipliers
      const PressurePreconditioner *pressure;  ///< likewise pressures
      mutable BlockVector           scratch;
    };

    /// That of bodies and springs and p . P p, what error_energy() is to be
    /// small beside.
    double
    energy_of(const SystemVector &x, const BlockSystem &system)
    {
      double energy = system.energy_product(x);
      if (system.mixed())
        {
          Vector g(x.pressure);
          system.bulk->apply_pressure_norm(g, x.pressure);
          energy += g * x.pressure;
        }
      return energy;
    }

    /// One call of GMRES for the scaled residual @p r, until it is @p goal; adds
    /// the iterations to @p report. @p is_indefinite: may K be?
    BlockVector
    iterate(const ScaledOperator      &matrix,
            const BlockPreconditioner &preconditioner,
            const bool                 is_indefinite,
            const BlockVector         &r,
            const double               goal,
            const double               rhs_norm,
            const SolverOptions       &options,
            SolveReport               &report)
    {
      // what is to be found of negative directions is lost with the basis
      const unsigned int max_basis = is_indefinite ? 150 : 60;
      BlockVector        x(r);
      x = 0.;
      SolverControl control(options.max_iterations - report.iterations,
                            goal,
                            false,
                            false);
      const auto    note = [&](const unsigned int iteration,
                            const double       value,
                            const BlockVector &) {
        if (iteration > 0 && options.monitor)
          options.monitor(report.iterations + iteration, value / rhs_norm);
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
      // multigrid in single precision is linear to seven digits only
      using FGMRES = SolverFGMRES<BlockVector>;
      run(FGMRES(control, FGMRES::AdditionalData(max_basis)));
      report.iterations += control.last_step();
      x.scale(matrix.weight);
      return x;
    }
  } // namespace

  void
  solve_saddle_point(const BlockSystem            &system,
                     const ScaledResidual         &residual,
                     const DegreeMultigrid        &bulk,
                     const PressurePreconditioner *pressure,
                     const SolverOptions          &options,
                     const SystemVector           &rhs,
                     SystemVector                 &solution,
                     SolveReport                  &report)
  {
    const ScaledOperator      matrix(system, residual);
    const BlockPreconditioner preconditioner(system, matrix, bulk, pressure);
    const double              rhs_norm = residual.norm(rhs);
    const double              target   = options.tolerance * rhs_norm;
    SystemVector              all_r    = system.zero_vector();
    residual.compute(rhs, solution, all_r);
    double     reached = residual.norm(all_r), goal = 0.9 * target;
    const auto accurate = [&] {
      // beside pressures the residual does not say less than the energy
      const double energy_tolerance =
        system.mixed() ? options.tolerance : options.energy_tolerance();
      return reached <= target &&
             (!system.suits_conjugate_gradients() ||
              preconditioner.error_energy(all_r) <=
                energy_tolerance * energy_tolerance *
                  std::max(energy_of(solution, system),
                           residual.least_energy(rhs_norm)));
    };
    // Again from what was reached: rounding makes the recursive residual drift
    // from the true one, and the energy of the error is only looked at here.
    // What is no number stays none.
    for (unsigned int start = 0;
         start < 5 && std::isfinite(reached) && !accurate() &&
         report.iterations < options.max_iterations;
         ++start)
      {
        BlockVector r = as_blocks(all_r);
        r.scale(matrix.weight);
        add(solution,
            iterate(matrix,
                    preconditioner,
                    !system.bulk->may_be_positive(),
                    r,
                    goal,
                    rhs_norm,
                    options,
                    report));
        residual.compute(rhs, solution, all_r);
        reached = residual.norm(all_r);
        goal    = std::min(goal, 0.1 * reached);
      }
    residual.assess(
      {rhs, solution, all_r},
      options.tolerance,
      [&] {
        return std::sqrt(preconditioner.error_energy(all_r) /
                         energy_of(solution, system));
      },
      report);
  }

  SaddlePointSolver::SaddlePointSolver(const BlockSystem   &system,
                                       const SolverOptions &options)
    : LinearSolver(system, options, "saddle point")
  {}

  SaddlePointSolver::~SaddlePointSolver() = default;

  bool
  SaddlePointSolver::set_up()
  {
    bulk = std::make_unique<DegreeMultigrid>(system, options.max_gathered);
    if (system.mixed())
      pressure = std::make_unique<PressurePreconditioner>(system);
    describe();
    return bulk->is_valid() && (!pressure || pressure->is_valid());
  }

  bool
  SaddlePointSolver::set_up_active()
  {
    return bulk->update_active();
  }

  bool
  SaddlePointSolver::set_up_interfaces()
  {
    const bool result = bulk->update_interfaces();
    describe();
    return result;
  }

  bool
  SaddlePointSolver::set_up_directions()
  {
    return bulk->update_directions();
  }

  void
  SaddlePointSolver::describe()
  {
    description = "block factorisation: " + bulk->description() +
                  (pressure ? "; " + pressure->description() : "") +
                  (bulk->projector() != nullptr ?
                     "; interface Schur complement factorised" :
                     "");
  }

  void
  SaddlePointSolver::run(const SystemVector &rhs,
                         SystemVector       &solution,
                         bool /*is_zero*/,
                         SolveReport &report)
  {
    solve_saddle_point(
      system, *residual, *bulk, pressure.get(), options, rhs, solution, report);
  }
} // namespace mortise
