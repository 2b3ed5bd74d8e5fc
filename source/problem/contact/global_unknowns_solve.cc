// The solves of GlobalUnknowns.
#include <deal.II/base/mpi.h>

#include <mortise/problem/contact/global_unknowns.h>

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
  } // namespace

  dealii::Vector<double>
  GlobalUnknowns::missing(const SystemVector &x) const
  {
    dealii::Vector<double> result(all.size());
    for (unsigned int j = 0; j < all.size(); ++j)
      if (forces[j])
        result(j) = *forces[j] - force(j, x);
    return result;
  }

  double
  GlobalUnknowns::size_of_forces(const SystemVector &x) const
  {
    double size = 0.;
    for (unsigned int j = 0; j < first_motion; ++j)
      size = std::max(size, std::fabs(forces[j].value_or(0.)));
    if (size > 0.)
      return size;
    for (unsigned int j = 0; j < first_motion; ++j)
      {
        size = std::max(size, std::fabs(force(j, x)));
        if (all[j].known)
          size = std::max(size, std::fabs(values[j] * force(j, all[j].x)));
      }
    return size;
  }

  double
  GlobalUnknowns::relative(const dealii::Vector<double> &lacks,
                           const SystemVector           &x) const
  {
    double motion = 0., result = 0.;
    for (unsigned int j = first_motion; j < all.size(); ++j)
      motion = std::max({motion, std::fabs(*forces[j]), size_of_product(j, x)});
    const double size = size_of_forces(x);
    for (unsigned int j = 0; j < all.size(); ++j)
      if (const double of = j < first_motion ? size : motion; of > 0.)
        result = std::max(result, std::fabs(lacks(j)) / of);
    return result;
  }

  double
  GlobalUnknowns::lack(const SystemVector &x, const double reference) const
  {
    const dealii::Vector<double> missed = missing(x);
    double                       result = 0.;
    if (const double of = size_of_forces(x); of > 0.)
      for (unsigned int j = 0; j < first_motion; ++j)
        result = std::max(result, std::fabs(missed(j)) / of);
    const double size =
      sizes.empty() ? 0. : *std::max_element(sizes.begin(), sizes.end());
    for (unsigned int j = first_motion; j < all.size(); ++j)
      // bodies that turn as a whole bear nothing but rounding
      if (const double stiffness = all[j].at_nodes * all[j].borne,
          scale =
            std::max(size, std::sqrt(std::max(0., stiffness)) * reference);
          scale > 0.)
        result = std::max(result, std::fabs(lacks[j]) / scale);
    return result;
  }

  void
  GlobalUnknowns::solve_units(SolveReport &report)
  {
    const auto &now = discretisation.linear_system().active;
    if (Utilities::MPI::max(now == active ? 0 : 1, run.comm) == 1)
      for (Unknown &unknown : all)
        unknown.known = false;
    for (unsigned int j = 0; j < all.size(); ++j)
      {
        Unknown &unknown = all[j];
        if (!forces[j] || unknown.known)
          continue;
        if (j >= first_motion && !unknown.has_lift)
          set_lift(unknown);
        const SolveReport of_one = unknown.has_x ?
                                     solver.solve_from(unknown.rhs, unknown.x) :
                                     solver.solve(unknown.rhs, unknown.x);
        report.iterations += of_one.iterations;
        report.add_seconds(of_one);
        report.converged = report.converged && of_one.converged;
        unknown.has_x = unknown.known = true;
      }
    active = now;
  }

  dealii::Vector<double>
  GlobalUnknowns::changes_for(const dealii::Vector<double> &lacks,
                              const SystemVector           &rhs) const
  {
    const unsigned int n = all.size();
    FullMatrix<double> stiffness(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        stiffness(i, j) = forces[i] && forces[j] ?
                            force(i, all[j].x) + stiffness_of(i, j) :
                            (i == j ? 1. : 0.);
    check_resistance(stiffness);
    // with the pressure, and the volume that is kept
    FullMatrix<double>     system(n + 1, n + 1);
    dealii::Vector<double> right(n + 1), result(n + 1);
    system(n, n) = 1.;
    for (unsigned int i = 0; i < n; ++i)
      {
        right(i) = lacks(i);
        for (unsigned int j = 0; j < n; ++j)
          system(i, j) = stiffness(i, j);
        if (forces[i] && fluxes(i) != 0.)
          {
            system(i, n) = system(n, i) = -fluxes(i);
            system(n, n)                = 0.;
          }
      }
    right(n) = net_flux(rhs);
    system.gauss_jordan();
    system.vmult(result, right);
    result.grow_or_shrink(n);
    return result;
  }

  bool
  GlobalUnknowns::has_force() const
  {
    return std::any_of(forces.begin(), forces.end(), [](const auto &given) {
      return given.has_value();
    });
  }

  void
  GlobalUnknowns::complete_increment(const SystemVector &x,
                                     const Vector       &rest,
                                     SceneLoad          &load,
                                     SystemVector       &dx,
                                     SolveReport        &report)
  {
    if (!report.converged || !has_force())
      return;
    solve_units(report);
    SystemVector next = x;
    add_scaled(next, 1., dx);
    dealii::Vector<double> missed = missing(next);
    for (unsigned int j = first_motion; j < all.size(); ++j)
      missed(j) = lacks[j] - force(j, dx) - all[j].borne * rest;
    const dealii::Vector<double> d = changes_for(missed, load.rhs);
    for (unsigned int j = 0; j < all.size(); ++j)
      if (forces[j])
        {
          change(j, d(j), load, &dx);
          if (all[j].is_motion())
            dx.displacement.add(d(j), all[j].at_nodes);
        }
  }

  SolveReport
  GlobalUnknowns::solve_other_loads(const SceneLoad &load, SystemVector &x)
  {
    SystemVector others = load.rhs;
    for (unsigned int j = 0; j < all.size(); ++j)
      if (forces[j])
        add_scaled(others, -values[j], all[j].rhs);
    SolveReport report = solver.solve(others, x);
    if (report.converged)
      solve_units(report);
    if (report.converged)
      for (unsigned int j = 0; j < all.size(); ++j)
        if (forces[j])
          add_scaled(x, values[j], all[j].x);
    return report;
  }

  void
  GlobalUnknowns::solve_again(SystemVector &rhs,
                              SystemVector &x,
                              SolveReport  &report)
  {
    const SolveReport again = solver.solve_from(rhs, x);
    report.iterations += again.iterations;
    report.solve_seconds += again.solve_seconds;
    report.relative_residual = again.relative_residual;
    report.attainable        = again.attainable;
    report.converged         = again.converged;
  }

  SolveReport
  GlobalUnknowns::solve(const bool goes_on, SceneLoad &load, SystemVector &x)
  {
    if (!has_force())
      return goes_on ? solver.solve_from(load.rhs, x) :
                       solver.solve(load.rhs, x);
    bool is_new = true;
    for (unsigned int j = 0; j < all.size(); ++j)
      is_new = is_new && (!forces[j] || values[j] == 0.);
    SolveReport report      = goes_on ? solver.solve_from(load.rhs, x) :
                              is_new  ? solver.solve(load.rhs, x) :
                                        solve_other_loads(load, x);
    bool        solves_load = goes_on || is_new; // not only about
    for (unsigned int k = 0; k < max_corrections && report.converged; ++k)
      {
        dealii::Vector<double> lacks = missing(x);
        take_pressure(lacks);
        double strain     = 0.;
        bool   is_checked = true; // check_resistance()
        for (unsigned int j = indices.size(); j < first_motion; ++j)
          {
            strain     = std::max(strain, std::fabs(values[j]));
            is_checked = is_checked && (!forces[j] || all[j].has_x);
          }
        const double tolerance = run.parameters.solver.tolerance;
        if (solves_load && is_checked && !(relative(lacks, x) > tolerance) &&
            !(std::fabs(net_flux(load.rhs)) > tolerance * strain * volume))
          break;
        solves_load = true;
        solve_units(report);
        if (!report.converged)
          break;
        const dealii::Vector<double> d = changes_for(lacks, load.rhs);
        for (unsigned int j = 0; j < all.size(); ++j)
          if (forces[j])
            change(j, d(j), load, &x);
        solve_again(load.rhs, x, report);
      }
    dealii::Vector<double> lacks = missing(x);
    if (const double pressure = take_pressure(lacks); pressure != 0.)
      add_scaled(x, pressure, *enclosure);
    return report;
  }

  void
  GlobalUnknowns::release(const std::vector<double> &functional,
                          SceneLoad                 &load,
                          SystemVector              &z,
                          SolveReport               &report)
  {
    if (!report.converged || !has_force())
      return;
    solve_units(report);
    if (!report.converged)
      return;
    dealii::Vector<double> missed(all.size());
    for (unsigned int j = 0; j < all.size(); ++j)
      if (forces[j])
        missed(j) = functional[j] - force(j, z);
    const dealii::Vector<double> d = changes_for(missed, load.rhs);
    for (unsigned int j = 0; j < all.size(); ++j)
      {
        if (!forces[j])
          continue;
        add_scaled(load.rhs, d(j), all[j].rhs);
        add_scaled(z, d(j), all[j].x);
        for (const auto &[dof, value] : all[j].prescribed)
          load.prescribed[dof] += d(j) * value;
      }
    solve_again(load.rhs, z, report);
  }
} // namespace mortise
