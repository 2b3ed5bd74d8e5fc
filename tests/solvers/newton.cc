// Proves that Newton's method converges quadratically, reaches the exact
// solution from far away by halving increments, leaves the iterate where no
// increment helps, and reports linear solves that fail.
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

    SystemVector
    start(const double value) const
    {
      SystemVector x;
      x.displacement.reinit(dealii::complete_index_set(b.size()),
                            MPI_COMM_SELF);
      x.displacement = value;
      return x;
    }

    NonlinearProblem
    problem()
    {
      NonlinearProblem p;
      p.residual = [this](const SystemVector &x, SystemVector &r) {
        for (unsigned int i = 0; i < b.size(); ++i)
          r.displacement.begin()[i] = b[i] - f(x.displacement.begin()[i]);
      };
      p.linearise = [this](const SystemVector &x) {
        slope.clear();
        for (unsigned int i = 0; i < b.size(); ++i)
          slope.push_back(derivative(x.displacement.begin()[i]));
      };
      p.solve = [this](const SystemVector &r, SystemVector &dx) {
        for (unsigned int i = 0; i < b.size(); ++i)
          dx.displacement.begin()[i] = r.displacement.begin()[i] / slope[i];
        SolveReport report;
        report.converged  = !fails;
        report.iterations = 3;
        return report;
      };
      p.norm = [this](const SystemVector &r) {
        norms.push_back(r.displacement.l2_norm());
        return norms.back();
      };
      return p;
    }
  };

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
    options.scale              = 30.;
    const NewtonReport report  = solve_newton(s.problem(), options, x);
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
    const NewtonReport report = solve_newton(s.problem(), NewtonOptions(), x);
    verdict(report.converged && !report.easy &&
              std::fabs(x.displacement.begin()[0] - std::tan(0.1)) < 1e-9,
            "arc tangent: solved with halved increments",
            std::fabs(x.displacement.begin()[0] - std::tan(0.1)));
    NewtonOptions none;
    none.max_halvings        = 0;
    x                        = s.start(3.);
    const NewtonReport stuck = solve_newton(s.problem(), none, x);
    verdict(!stuck.converged && x.displacement.begin()[0] == 3. &&
              x.displacement.begin()[1] == 3.,
            "arc tangent: without halving the iterate stays",
            x.displacement.begin()[0]);
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
    NewtonReport report = solve_newton(s.problem(), NewtonOptions(), x);
    verdict(!report.converged && report.relative_residual >= 1. &&
              report.relative_residual <= 2.,
            "no solution: not converged, not worse than the start",
            report.relative_residual);
    s.b     = {4.};
    s.fails = true;
    x       = s.start(1.);
    report  = solve_newton(s.problem(), NewtonOptions(), x);
    verdict(!report.converged && report.iterations == 0 &&
              x.displacement.begin()[0] == 1.,
            "a linear solve that fails moves nothing",
            x.displacement.begin()[0]);
    s.fails = false;
    s.b     = {std::nan("")};
    report  = solve_newton(s.problem(), NewtonOptions(), x);
    verdict(!report.converged, "not a number: not converged");
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_quadratic();
  check_search();
  check_failures();
}
