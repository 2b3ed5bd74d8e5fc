// See direct.h.
#include <Epetra_Vector.h>
#include <mortise/solvers/factorisation/direct.h>
#include <mortise/solvers/factorisation/monolithic_matrix.h>
#include <mortise/solvers/factorisation/mumps_factorisation.h>

#include <cmath>
#include <limits>
#include <memory>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Square roots of the inverse diagonals of the residual's norm, in the
    /// monolithic numbering: they make the matrix free of units, so that
    /// pivoting compares like with like.
    void
    set_scaling(Epetra_Vector        &scale,
                const ScaledResidual &residual,
                const BlockSystem    &system)
    {
      int        next = 0;
      const auto add  = [&](const Epetra_Vector &square) {
        for (int i = 0; i < square.MyLength(); ++i)
          scale[next++] = std::sqrt(square[i]);
      };
      add(residual.inverse_diagonal_u());
      if (system.mixed())
        add(residual.inverse_diagonal_p());
      if (system.owned_multiplier.size() > 0)
        add(residual.inverse_diagonal_lambda());
    }

    /// Calls visit(monolithic value, value) for all values of this rank.
    template <typename Solution, typename Visit>
    void
    for_each_value(Epetra_Vector &v, Solution &x, const Visit &visit)
    {
      int next = 0;
      for (auto *part : {&x.displacement, &x.pressure, &x.multiplier})
        for (unsigned int i = 0; i < part->locally_owned_size(); ++i)
          visit(v[next++], part->begin()[i]);
    }

    /// What the system without pins leaves free, a constant pressure of mean
    /// one and the multipliers that come with it, by group of FreePressures:
    /// with a pin c at pressure k, (A + c e e^T) n = c e for A n = 0 and n_k
    /// = 1.
    std::vector<SystemVector>
    free_constants(const BlockSystem        &system,
                   const Epetra_CrsMatrix   &matrix,
                   const Epetra_Vector      &scale,
                   const MumpsFactorisation &factorisation)
    {
      std::vector<SystemVector> result;
      for (unsigned int g = 0; g < system.free_pressures.size(); ++g)
        {
          Epetra_Vector b(matrix.RowMap()), y(b);
          if (const int pinned = system.free_pressures.pinned(g); pinned >= 0)
            b[system.owned_displacement.n_elements() + pinned] = 1.;
          factorisation.solve(y, b);
          y.Multiply(1., scale, y, 0.);
          SystemVector constant = system.zero_vector();
          for_each_value(y, constant, [](const double from, double &to) {
            to = from;
          });
          SystemVector scaled = system.zero_vector();
          add_scaled(scaled,
                     1. / system.free_pressures.mean(g, constant.pressure),
                     constant);
          result.push_back(scaled);
        }
      return result;
    }
  } // namespace

  /// The factorised matrix, scaled, and what it leaves free.
  struct DirectSolver::Factors
  {
    explicit Factors(const BlockSystem &system, const ScaledResidual &residual)
      : system(system)
      , matrix(monolithic_matrix(system, residual, MonolithicNumbering(system)))
      , scale(matrix->RowMap())
      , b(scale)
      , y(scale)
    {
      set_scaling(scale, residual, system);
      matrix->LeftScale(scale);
      matrix->RightScale(scale);
      valid = factorisation.initialize(*matrix, MatrixKind::general);
      if (valid)
        constants = free_constants(system, *matrix, scale, factorisation);
    }

    /// @p x = A^{-1} r; false when the solve failed.
    bool
    solve(const SystemVector &r, SystemVector &x)
    {
      for_each_value(b, r, [](double &to, const double from) { to = from; });
      b.Multiply(1., scale, b, 0.);
      if (!factorisation.solve(y, b))
        return false;
      y.Multiply(1., scale, y, 0.);
      for_each_value(y, x, [](const double from, double &to) { to = from; });
      for (unsigned int g = 0; g < constants.size(); ++g)
        add_scaled(x, -system.free_pressures.mean(g, x.pressure), constants[g]);
      return true;
    }

    const BlockSystem                &system;
    std::unique_ptr<Epetra_CrsMatrix> matrix;
    Epetra_Vector                     scale, b, y;
    MumpsFactorisation                factorisation;
    std::vector<SystemVector>         constants;
    bool                              valid;
  };

  DirectSolver::DirectSolver(const BlockSystem   &system,
                             const SolverOptions &options)
    : LinearSolver(system, options, "direct")
  {}

  DirectSolver::~DirectSolver() = default;

  bool
  DirectSolver::set_up()
  {
    factors     = std::make_unique<Factors>(system, *residual);
    description = "factorisation (MUMPS)";
    return factors->valid;
  }

  void
  DirectSolver::run(const SystemVector &rhs,
                    SystemVector       &x,
                    bool /*is_zero*/,
                    SolveReport &report)
  {
    constexpr unsigned int max_refinements = 4;
    SystemVector           r = system.zero_vector(), correction = r;
    const double           rhs_norm = residual->norm(rhs);
    double                 previous = std::numeric_limits<double>::infinity();
    residual->compute(rhs, x, r);
    for (unsigned int step = 0; rhs_norm > 0. && step <= max_refinements &&
                                factors->solve(r, correction);
         ++step)
      {
        add_scaled(x, 1., correction);
        residual->compute(rhs, x, r);
        const double reached = residual->norm(r) / rhs_norm;
        if (options.monitor)
          options.monitor(step, reached);
        // Refine until rounding is reached, at least once.
        if (!(reached < 0.5 * previous) || (step > 0 && reached <= 1e-14))
          break;
        previous = reached;
      }
    const auto relative_error = [&] {
      return factors->solve(r, correction) ?
               std::sqrt(system.energy_product(correction) /
                         system.energy_product(x)) :
               1.;
    };
    residual->judge({rhs, x, r}, options.tolerance, relative_error, report);
  }
} // namespace mortise
