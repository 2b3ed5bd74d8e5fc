// Proves that Newton's method converges quadratically, reaches the exact
// solution from far away by halving increments, leaves the iterate where no
// increment helps, takes full increments where it is told so, and reports
// linear solves that fail.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/newton.h>
#include <verdict.h>

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

using namespace mortise;

namespace
{
  /// A(x)_i = f(x_i), each unknown for itself.
  struct Scalars
  {
    std::function<double(double)> f, derivative;
    std::vector<double>           b;
    std::vector<double>           slope;
    std::vector<double> norms; ///< of all residuals that were asked for
    bool                fails = false;
    double              scale = 1.; ///< of residuals

    SystemVector
    start(const double value) const
    {
      SystemVector x;
      x.displacement.reinit(dealii::complete_index_set(b.size()),
                            MPI_COMM_SELF);
      x.displacement = value;
      return x;
    }
  };

  class Problem : public NonlinearProblem
  {
  public:
    explicit Problem(Scalars &s)
      : s(s)
    {}

    double
    residual(const SystemVector &x) override
    {
      r = x.displacement;
      for (unsigned int i = 0; i < s.b.size(); ++i)
        r.begin()[i] = s.b[i] - s.f(x.displacement.begin()[i]);
      s.norms.push_back(r.l2_norm() / s.scale);
      return s.norms.back();
    }

    void
    linearise(const SystemVector &x) override
    {
      s.slope.clear();
      for (unsigned int i = 0; i < s.b.size(); ++i)
        s.slope.push_back(s.derivative(x.displacement.begin()[i]));
    }

    SolveReport
    solve(SystemVector &x) override
    {
      for (unsigned int i = 0; i < s.b.size(); ++i)
        x.displacement.begin()[i] += r.begin()[i] / s.slope[i];
      SolveReport report;
      report.converged     = !s.fails;
      report.iterations    = 3;
      report.solve_seconds = 2.;
      return report;
    }

  private:
    Scalars        &s;
    mortise::Vector r;
  };

  NewtonReport
  solve(Scalars &s, const NewtonOptions &options, SystemVector &x)
  {
    Problem problem(s);
    return solve_newton(problem, options, x);
  }

  void
  check_quadratic()
  {
    Scalars       s{[](const double x) { return x + x * x * x; },
              [](const double x) { return 1. + 3. * x * x; },
                    {2., 10., -30.},
                    {},
                    {}};
    SystemVector  x = s.start(0.5);
    NewtonOptions options;
    options.tolerance          = 1e-13;
    s.scale                    = 30.;
    const NewtonReport report  = solve(s, options, x);
    const double       exact[] = {1., 2., -3.};
    double             error   = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      error = std::max(error, std::fabs(x.displacement.begin()[i] - exact[i]));
    verdict(report.converged && error < 1e-12, "cubic: solved", error);
    verdict(report.linear_iterations == 3 * report.iterations,
            "cubic: linear iterations are counted",
            report.linear_iterations);
    // |r_{k+1}| / |r_k|^2 stays bounded at the end
    const auto  &n = s.norms;
    unsigned int k = 0;
    while (k + 1 < n.size() && n[k + 1] > 1e-9)
      ++k;
    const double order =
      std::log(n[k] / n[k - 1]) / std::log(n[k - 1] / n[k - 2]);
    verdict(order > 1.7, "cubic: order of convergence above 1.7", -order);
  }

  void
  check_search()
  {
    // full increments from 3 on diverge
    Scalars            s{[](const double x) { return std::atan(x); },
              [](const double x) { return 1. / (1. + x * x); },
                         {0.1, 0.},
                         {},
                         {}};
    SystemVector       x      = s.start(3.);
    const NewtonReport report = solve(s, NewtonOptions(), x);
    verdict(report.converged && !report.easy &&
              std::fabs(x.displacement.begin()[0] - std::tan(0.1)) < 1e-9,
            "arc tangent: solved with halved increments",
            std::fabs(x.displacement.begin()[0] - std::tan(0.1)));
    NewtonOptions none;
    none.max_halvings        = 1;
    x                        = s.start(3.);
    const NewtonReport stuck = solve(s, none, x);
    verdict(!stuck.converged && x.displacement.begin()[0] == 3. &&
              x.displacement.begin()[1] == 3.,
            "arc tangent: with one halving the iterate stays",
            x.displacement.begin()[0]);
  }

  void
  check_full_increments()
  {
    // the residual rises from 4 to 27 on the way
    Scalars s{[](const double x) { return x + 9. * std::max(x - 1., 0.); },
              [](const double x) { return x > 1. ? 10. : 1.; },
              {4.},
              {},
              {}};
    NewtonOptions full;
    full.max_halvings         = 0;
    SystemVector       x      = s.start(0.);
    const NewtonReport report = solve(s, full, x);
    verdict(report.converged && report.iterations == 2 &&
              std::fabs(x.displacement.begin()[0] - 1.3) < 1e-12,
            "piecewise linear: solved in two full increments",
            report.iterations);
    verdict(report.linear.solve_seconds == 4. && report.linear.iterations == 3,
            "piecewise linear: the last solve, with the seconds of all",
            report.linear.solve_seconds);
  }

  void
  check_failures()
  {
    Scalars      s{[](const double x) { return x * x; },
              [](const double x) { return 2. * x; },
                   {-1.},
                   {},
                   {}};
    SystemVector x      = s.start(1.);
    NewtonReport report = solve(s, NewtonOptions(), x);
    verdict(!report.converged && report.residual >= 1. && report.residual <= 2.,
            "no solution: not converged, not worse than the start",
            report.residual);
    s.b     = {4.};
    s.fails = true;
    x       = s.start(1.);
    report  = solve(s, NewtonOptions(), x);
    verdict(!report.converged && report.iterations == 0 &&
              x.displacement.begin()[0] == 1.,
            "a linear solve that fails moves nothing",
            x.displacement.begin()[0]);
    s.fails = false;
    s.b     = {std::nan("")};
    report  = solve(s, NewtonOptions(), x);
    verdict(!report.converged, "not a number: not converged");
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_quadratic();
  check_search();
  check_full_increments();
  check_failures();
}
