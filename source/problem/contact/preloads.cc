#include <deal.II/base/mpi.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/base/error.h>
#include <mortise/problem/contact/preloads.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Forces are met to the solver's tolerance after one correction; more
    /// are for solves that are looser.
    constexpr unsigned int max_corrections = 10;

    /// Cosine in the mean between normals and their mean.
    constexpr double flat = 0.99;
  } // namespace

  Preloads::Preloads(const RunContext     &run,
                     const Discretisation &discretisation,
                     LinearSolver         &solver)
    : run(run)
    , discretisation(discretisation)
    , solver(solver)
  {
    const Pairing &couplings = discretisation.interfaces();
    for (unsigned int i = 0; i < couplings.all().size(); ++i)
      if (const InterfaceParameters &given = couplings.sides()[i];
          given.preload)
        {
          const Coupling &coupling = couplings.all()[i];
          Tensor<1, dim>  sum;
          double          number = 0.;
          for (const auto &of_face : coupling.frames)
            for (const Frame &frame : of_face)
              {
                sum += frame[0];
                number += 1.;
              }
          const auto n_patches =
            std::count_if(couplings.sides().begin(),
                          couplings.sides().end(),
                          [&](const InterfaceParameters &other) {
                            return other.name == given.name;
                          });
          if (n_patches > 1)
            run.parameters.fail("Interface " + given.name + "/Preload",
                                "an interface with edges, in " +
                                  std::to_string(n_patches) + " smooth patches",
                                "a nearly flat interface");
          sum    = Utilities::MPI::sum(sum, run.comm);
          number = Utilities::MPI::sum(number, run.comm);
          if (sum.norm() < flat * number)
            run.parameters.fail(
              "Interface " + given.name + "/Preload",
              "an interface whose normals differ (their mean has length " +
                RunLog::number(sum.norm() / number) + ")",
              "a nearly flat interface, whose normal is the direction of the force");
          indices.push_back(i);
          values.push_back(0.);
        }
    forces.resize(indices.size());
    units.resize(indices.size());
    pair_again();
  }

  void
  Preloads::pair_again()
  {
    for (unsigned int j = 0; j < indices.size(); ++j)
      {
        units[j] = {discretisation.linear_system().zero_vector(), {}};
        add_offset(
          discretisation.interfaces().all()[indices[j]],
          [](const Point<dim> &) { return 1.; },
          units[j].rhs.multiplier);
      }
    have_units = known = false;
  }

  void
  Preloads::add_shortenings(SceneLoad &load) const
  {
    for (unsigned int j = 0; j < indices.size(); ++j)
      load.rhs.multiplier.add(values[j], units[j].rhs.multiplier);
  }

  std::vector<double>
  Preloads::shortenings_by_interface() const
  {
    std::vector<double> result(discretisation.interfaces().all().size(), 0.);
    for (unsigned int j = 0; j < indices.size(); ++j)
      result[indices[j]] = values[j];
    return result;
  }

  std::vector<bool>
  Preloads::have_forces() const
  {
    std::vector<bool> result(discretisation.interfaces().all().size(), false);
    for (unsigned int j = 0; j < indices.size(); ++j)
      result[indices[j]] = forces[j].has_value();
    return result;
  }

  double
  Preloads::work(const Vector &opening) const
  {
    double sum = 0.;
    for (unsigned int j = 0; j < indices.size(); ++j)
      if (forces[j])
        sum += *forces[j] * shortening(j, opening);
    return sum;
  }

  double
  Preloads::shortening(const unsigned int j, const Vector &opening) const
  {
    const Vector &w = units[j].rhs.multiplier;
    return (w * opening) / (w * w);
  }

  double
  Preloads::force(const unsigned int j, const SystemVector &x) const
  {
    return -(units[j].rhs.multiplier * x.multiplier);
  }

  void
  Preloads::begin(const SceneData           &data,
                  const std::vector<double> &shortenings,
                  SceneLoad                 &load)
  {
    for (unsigned int j = 0; j < indices.size(); ++j)
      {
        values[j] =
          indices[j] < shortenings.size() ? shortenings[indices[j]] : 0.;
        forces[j] =
          data.preload(discretisation.interfaces().sides()[indices[j]]);
      }
    add_shortenings(load);
  }

  void
  Preloads::shorten(const unsigned int j,
                    const double       d,
                    SceneLoad         &load,
                    SystemVector      *x)
  {
    values[j] += d;
    load.rhs.multiplier.add(d, units[j].rhs.multiplier);
    if (x != nullptr)
      add_scaled(*x, d, units[j].x);
  }

  dealii::Vector<double>
  Preloads::missing(const SystemVector &x) const
  {
    dealii::Vector<double> result(indices.size());
    for (unsigned int j = 0; j < indices.size(); ++j)
      if (forces[j])
        result(j) = *forces[j] - force(j, x);
    return result;
  }

  void
  Preloads::solve_units(SolveReport &report)
  {
    const auto &now = discretisation.linear_system().active;
    if (known && Utilities::MPI::max(now == active ? 0 : 1, run.comm) == 0)
      return;
    for (unsigned int j = 0; j < indices.size(); ++j)
      {
        Unit             &unit    = units[j];
        const SolveReport of_unit = have_units ?
                                      solver.solve_from(unit.rhs, unit.x) :
                                      solver.solve(unit.rhs, unit.x);
        report.iterations += of_unit.iterations;
        report.add_seconds(of_unit);
        report.converged = report.converged && of_unit.converged;
      }
    active     = now;
    have_units = known = true;
  }

  dealii::Vector<double>
  Preloads::shortenings_for(const dealii::Vector<double> &lacks) const
  {
    const unsigned int n = indices.size();
    FullMatrix<double> stiffness(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        stiffness(i, j) =
          forces[i] && forces[j] ? force(i, units[j].x) : (i == j ? 1. : 0.);
    stiffness.gauss_jordan();
    dealii::Vector<double> result(n);
    stiffness.vmult(result, lacks);
    return result;
  }

  void
  Preloads::release(SystemVector &rhs, SystemVector &z, SolveReport &report)
  {
    if (!report.converged || !has_force())
      return;
    solve_units(report);
    if (!report.converged)
      return;
    dealii::Vector<double> lacks(indices.size());
    for (unsigned int j = 0; j < indices.size(); ++j)
      if (forces[j])
        lacks(j) = -force(j, z);
    const dealii::Vector<double> d = shortenings_for(lacks);
    for (unsigned int j = 0; j < indices.size(); ++j)
      {
        rhs.multiplier.add(d(j), units[j].rhs.multiplier);
        add_scaled(z, d(j), units[j].x);
      }
    const SolveReport again = solver.solve_from(rhs, z);
    report.iterations += again.iterations;
    report.solve_seconds += again.solve_seconds;
    report.relative_residual = again.relative_residual;
    report.attainable        = again.attainable;
    report.converged         = again.converged;
  }

  bool
  Preloads::has_force() const
  {
    return std::any_of(forces.begin(), forces.end(), [](const auto &given) {
      return given.has_value();
    });
  }

  double
  Preloads::largest_force() const
  {
    double size = 0.;
    for (const auto &given : forces)
      size = std::max(size, std::fabs(given.value_or(0.)));
    return size;
  }

  double
  Preloads::lack(const SystemVector &x) const
  {
    const double size = largest_force();
    return size == 0. ? 0. : missing(x).linfty_norm() / size;
  }

  void
  Preloads::complete_increment(const SystemVector &x,
                               SceneLoad          &load,
                               SystemVector       &dx,
                               SolveReport        &report)
  {
    if (!report.converged || !has_force())
      return;
    solve_units(report);
    SystemVector next = x;
    add_scaled(next, 1., dx);
    const dealii::Vector<double> d = shortenings_for(missing(next));
    for (unsigned int j = 0; j < indices.size(); ++j)
      shorten(j, d(j), load, &dx);
  }

  SolveReport
  Preloads::solve_other_loads(const SceneLoad &load, SystemVector &x)
  {
    SystemVector others = load.rhs;
    for (unsigned int j = 0; j < indices.size(); ++j)
      others.multiplier.add(-values[j], units[j].rhs.multiplier);
    SolveReport report = solver.solve(others, x);
    if (report.converged)
      solve_units(report);
    if (report.converged)
      for (unsigned int j = 0; j < indices.size(); ++j)
        add_scaled(x, values[j], units[j].x);
    return report;
  }

  SolveReport
  Preloads::solve(const bool goes_on, SceneLoad &load, SystemVector &x)
  {
    if (indices.empty())
      return goes_on ? solver.solve_from(load.rhs, x) :
                       solver.solve(load.rhs, x);
    const bool is_new =
      std::all_of(values.begin(), values.end(), [](const double value) {
        return value == 0.;
      });
    SolveReport  report      = goes_on ? solver.solve_from(load.rhs, x) :
                               is_new  ? solver.solve(load.rhs, x) :
                                         solve_other_loads(load, x);
    const double size        = largest_force();
    bool         solves_load = goes_on || is_new; // not only about
    for (unsigned int k = 0; k < max_corrections && report.converged; ++k)
      {
        const dealii::Vector<double> lacks = missing(x);
        if (solves_load &&
            !(lacks.linfty_norm() > run.parameters.solver.tolerance * size))
          break;
        solves_load = true;
        solve_units(report);
        if (!report.converged)
          break;
        const dealii::Vector<double> d = shortenings_for(lacks);
        for (unsigned int j = 0; j < indices.size(); ++j)
          shorten(j, d(j), load, &x);
        const SolveReport again = solver.solve_from(load.rhs, x);
        report.iterations += again.iterations;
        report.solve_seconds += again.solve_seconds;
        report.relative_residual = again.relative_residual;
        report.attainable        = again.attainable;
        report.converged         = again.converged;
      }
    return report;
  }
} // namespace mortise
