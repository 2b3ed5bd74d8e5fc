// See condensed.h.
#include <mortise/solvers/condensed.h>
#include <mortise/solvers/hierarchical_preconditioner.h>
#include <mortise/solvers/scaled_residual.h>
#include <mortise/solvers/sparse_factorization.h>

#include <deal.II/base/timer.h>

#include <EpetraExt_MatrixMatrix.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    Epetra_MultiVector &
    epetra(Vector &v)
    {
      return const_cast<Epetra_FEVector &>(v.trilinos_vector());
    }

    /// The projector onto { u : B u = 0 } along D^{-1} B^T, D = diag(K + J):
    ///
    ///     P = I - D^{-1} B^T (B D^{-1} B^T)^{-1} B.
    class ConstraintProjector
    {
    public:
      explicit ConstraintProjector(const BlockSystem &system)
        : system(system)
        , n_multipliers(system.owned_multiplier.size())
      {
        if (n_multipliers == 0)
          return;
        weight.reinit(system.owned_displacement, system.communicator);
        jump.reinit(system.owned_multiplier, system.communicator);
        multiplier = jump;
        correction = weight;
        for (const auto i : system.owned_displacement)
          weight[i] =
            1. / (system.stiffness.diag_element(i) + system.jump_penalty.diag_element(i));
        weight.compress(VectorOperation::insert);

        Epetra_CrsMatrix scaled(system.coupling.trilinos_matrix());
        Vector           root(weight);
        for (unsigned int i = 0; i < root.locally_owned_size(); ++i)
          epetra(root)[0][i] = std::sqrt(epetra(weight)[0][i]);
        scaled.RightScale(*epetra(root)(0));
        inner_matrix =
          std::make_unique<Epetra_CrsMatrix>(Copy, system.coupling.trilinos_matrix().RowMap(), 0);
        EpetraExt::MatrixMatrix::Multiply(scaled, false, scaled, true, *inner_matrix);
        valid = inner.initialize(*inner_matrix);
      }

      /// False when the multipliers are not independent of each other.
      bool
      is_valid() const
      {
        return valid;
      }

      bool
      is_identity() const
      {
        return n_multipliers == 0;
      }

      /// r := P^T r = r - B^T y; lambda += y.
      void
      project_residual(Vector &r, Vector &lambda) const
      {
        correction = r;
        correction.scale(weight);
        system.coupling.vmult(jump, correction);
        inner.solve(epetra(multiplier), epetra(jump));
        lambda += multiplier;
        multiplier *= -1.;
        system.coupling.Tvmult_add(r, multiplier);
      }

      /// u := the nearest vector with B u = g, in the norm of D; g = 0 without @p g.
      void
      project(Vector &u, const Vector *g = nullptr) const
      {
        system.coupling.vmult(jump, u);
        if (g != nullptr)
          jump -= *g;
        inner.solve(epetra(multiplier), epetra(jump));
        system.coupling.Tvmult(correction, multiplier);
        correction.scale(weight);
        u -= correction;
      }

    private:
      const BlockSystem                &system;
      types::global_dof_index           n_multipliers;
      bool                              valid = true;
      Vector                            weight;
      mutable Vector                    jump, multiplier, correction;
      std::unique_ptr<Epetra_CrsMatrix> inner_matrix;
      SparseFactorization               inner;
    };
  } // namespace

  SolveReport
  solve_condensed(const BlockSystem   &system,
                  const SolverOptions &options,
                  Vector              &u,
                  Vector              &lambda)
  {
    SolveReport report;
    report.method = "condensed";
    Timer                      timer;
    HierarchicalPreconditioner preconditioner;
    const bool                 bulk_is_valid = preconditioner.initialize(system);
    const ConstraintProjector projector(system);
    const ScaledResidual      residual(system);
    report.preconditioner = preconditioner.description();
    report.setup_seconds  = timer.wall_time();
    timer.restart();

    u.reinit(system.owned_displacement, system.communicator);
    lambda.reinit(system.owned_multiplier, system.communicator);
    const double rhs_norm = residual.right_hand_side_norm();
    const double target   = options.tolerance * rhs_norm;
    Vector       r(u), r_lambda(lambda), z(u), d(u), kd(u);
    const bool   valid = bulk_is_valid && projector.is_valid();
    double       reached = rhs_norm;
    for (unsigned int start = 0; start < 3 && valid && reached > target &&
                                 report.iterations < options.max_iterations;
         ++start)
      {
        if (!projector.is_identity())
          projector.project(u, &system.coupling_rhs);
        residual.compute(u, lambda, r, r_lambda);
        double rho_old = 0.;
        for (bool first = true; report.iterations < options.max_iterations; first = false)
          {
            if (!projector.is_identity())
              projector.project_residual(r, lambda);
            reached = residual.norm(r, r_lambda);
            if (!first)
              {
                report.history.push_back(reached / rhs_norm);
                if (options.monitor)
                  options.monitor(report.iterations, reached / rhs_norm);
              }
            if (!(reached > 0.9 * target))
              break;
            preconditioner.vmult(z, r);
            if (!projector.is_identity())
              projector.project(z);
            const double rho = r * z;
            if (first)
              d = z;
            else
              d.sadd(rho / rho_old, 1., z);
            rho_old = rho;
            system.stiffness.vmult(kd, d);
            const double energy = d * kd;
            if (!(rho > 0. && energy > 0.)) // not positive definite, or not a number
              break;
            const double alpha = rho / energy;
            u.add(alpha, d);
            r.add(-alpha, kd);
            ++report.iterations;
          }
        residual.compute(u, lambda, r, r_lambda);
        reached = residual.norm(r, r_lambda);
      }
    report.relative_residual = reached == 0. ? 0. : reached / rhs_norm;
    report.converged         = reached <= target;
    report.solve_seconds     = timer.wall_time();
    return report;
  }
} // namespace mortise
