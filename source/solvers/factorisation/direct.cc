// See direct.h.
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
    std::vector<double>
    scaling(const ScaledResidual &residual)
    {
      std::vector<double> scale;
      for (const Vector *square : {&residual.inverse_diagonal_u(),
                                   &residual.inverse_diagonal_p(),
                                   &residual.inverse_diagonal_lambda()})
        for (unsigned int i = 0; i < square->locally_owned_size(); ++i)
          scale.push_back(std::sqrt(square->local_element(i)));
      return scale;
    }

    /// Calls visit(monolithic value, value) for all values of this rank.
    template <typename Solution, typename Visit>
    void
    for_each_value(std::vector<double> &v, Solution &x, const Visit &visit)
    {
      unsigned int next = 0;
      for (auto *part : {&x.displacement, &x.pressure, &x.multiplier})
        for (unsigned int i = 0; i < part->locally_owned_size(); ++i)
          visit(v[next++], part->local_element(i));
    }

    void
    multiply(std::vector<double> &v, const std::vector<double> &factors)
    {
      for (unsigned int i = 0; i < v.size(); ++i)
        v[i] *= factors[i];
    }

    /// The kernel of the system without pins, a constant pressure of mean one
    /// with its multipliers, by group of FreePressures: with a pin c at
    /// pressure k, (A + c e e^T) n = c e for A n = 0 and n_k = 1.
    std::vector<SystemVector>
    free_constants(const BlockSystem         &system,
                   const std::vector<double> &scale,
                   const MumpsFactorisation  &factorisation)
    {
      std::vector<SystemVector> result;
      for (unsigned int g = 0; g < system.free_pressures.size(); ++g)
        {
          std::vector<double> b(scale.size()), y(b);
          if (const int pinned = system.free_pressures.pinned(g); pinned >= 0)
            b[system.owned_displacement.n_elements() + pinned] = 1.;
          factorisation.solve(y.data(), b.data());
          multiply(y, scale);
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
      , scale(scaling(residual))
      , b(scale.size())
      , y(scale.size())
    {
      SparseMatrix matrix =
        monolithic_matrix(system, residual, MonolithicNumbering(system));
      const std::vector<double> of_columns = matrix.on_columns(scale.data());
      matrix.for_each_entry(
        [&](const unsigned int i, const unsigned int k, double &value) {
          value *= scale[i] * of_columns[k];
        });
      valid = factorisation.initialize(matrix, MatrixKind::general);
      if (valid)
        constants = free_constants(system, scale, factorisation);
    }

    /// @p x = A^{-1} r; false when the solve failed.
    bool
    solve(const SystemVector &r, SystemVector &x)
    {
      for_each_value(b, r, [](double &to, const double from) { to = from; });
      multiply(b, scale);
      if (!factorisation.solve(y.data(), b.data()))
        return false;
      multiply(y, scale);
      for_each_value(y, x, [](const double from, double &to) { to = from; });
      for (unsigned int g = 0; g < constants.size(); ++g)
        add_scaled(x, -system.free_pressures.mean(g, x.pressure), constants[g]);
      return true;
    }

    const BlockSystem        &system;
    const std::vector<double> scale;
    std::vector<double>       b, y;
    MumpsFactorisation        factorisation;
    std::vector<SystemVector> constants;
    bool                      valid;
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
    residual->assess({rhs, x, r}, options.tolerance, relative_error, report);
  }
} // namespace mortise
