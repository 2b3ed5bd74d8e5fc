#include <deal.II/base/mpi.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <mortise/base/error.h>
#include <mortise/problem/contact/preloads.h>
#include <mortise/problem/input/periodic_cell.h>

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
    if (!translations(run.parameters).empty())
      {
        volume = cell_volume(run.parameters);
        if (volume == 0.)
          volume = discretisation.volume();
        values.resize(indices.size() + run.parameters.mean_strain.size());
      }
    forces.resize(values.size());
    units.resize(values.size());
    pair_again();
    find_enclosure();
  }

  void
  Preloads::pair_again()
  {
    for (unsigned int j = 0; j < units.size(); ++j)
      {
        units[j]  = {discretisation.linear_system().zero_vector(), {}};
        Vector &w = units[j].rhs.multiplier;
        if (j < indices.size())
          add_offset(
            discretisation.interfaces().all()[indices[j]],
            [](const Point<dim> &) { return 1.; },
            w);
        else
          for (const Coupling &coupling : discretisation.interfaces().all())
            if (!coupling.is_turned)
              add_jump(coupling,
                       unit_strain(j - indices.size()) *
                         coupling.placement.translation,
                       w);
      }
  }

  void
  Preloads::find_enclosure()
  {
    constexpr double least = 0.5; // of the volume
    fluxes.reinit(units.size());
    for (const SystemVector &state : discretisation.free_states())
      if (state.multiplier.size() > 0)
        {
          for (unsigned int j = indices.size(); j < units.size(); ++j)
            if (j - indices.size() < dim) // shears keep the volume
              fluxes(j) = units[j].rhs.multiplier * state.multiplier;
          if (fluxes.linfty_norm() > least * volume)
            {
              enclosure.emplace(state);
              break;
            }
          fluxes = 0.;
        }
    if (enclosure && has_free_volume(run.parameters) &&
        (discretisation.linear_system().bulk->is_nonlinear() ||
         discretisation.interfaces().follow()))
      run.parameters.fail(
        "Periodic cell/Mean strain",
        "free components of a cell that is filled with incompressible bodies, whose law is not linear, or with contact that follows bodies",
        "Poisson ratios below 0.5, or a Mean strain that keeps the volume");
  }

  void
  Preloads::check_volume() const
  {
    constexpr double rounding = 0.01;
    double           net = 0., total = 0.;
    for (unsigned int j = 0; j < units.size(); ++j)
      {
        if (forces[j] && fluxes(j) != 0.)
          return; // that component keeps it
        net += values[j] * fluxes(j);
        total += std::fabs(values[j] * fluxes(j));
      }
    if (std::fabs(net) > rounding * total)
      run.parameters.fail(
        "Periodic cell/Mean strain",
        "a change of volume of a cell that is filled with incompressible bodies",
        "components xx, yy, zz whose sum is zero, one of them free, or smaller Poisson ratios");
  }

  void
  Preloads::add_shortenings(SceneLoad &load) const
  {
    for (unsigned int j = 0; j < units.size(); ++j)
      load.rhs.multiplier.add(values[j], units[j].rhs.multiplier);
  }

  std::vector<double>
  Preloads::shortenings_by_interface() const
  {
    std::vector<double> result(discretisation.interfaces().all().size(), 0.);
    for (unsigned int j = 0; j < indices.size(); ++j)
      result[indices[j]] = values[j];
    result.insert(result.end(), values.begin() + indices.size(), values.end());
    return result;
  }

  std::optional<PeriodicCellSummary>
  Preloads::cell(const SystemVector &x) const
  {
    if (units.size() == indices.size())
      return {};
    PeriodicCellSummary result;
    result.volume = volume;
    for (unsigned int j = indices.size(); j < units.size(); ++j)
      {
        result.mean_strain.push_back(values[j]);
        result.mean_stress.push_back(force(j, x) /
                                     work_of_stress(j - indices.size()));
      }
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
    for (unsigned int j = 0; j < units.size(); ++j)
      if (forces[j])
        sum += *forces[j] * shortening(j, opening);
    return sum;
  }

  double
  Preloads::shortening(const unsigned int j, const Vector &opening) const
  {
    const Vector &w      = units[j].rhs.multiplier;
    const double  square = w * w;
    return square > 0. ? (w * opening) / square : 0.;
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
    const unsigned int n = discretisation.interfaces().all().size();
    for (unsigned int j = 0; j < units.size(); ++j)
      {
        const bool         is_tie = j < indices.size();
        const unsigned int k      = is_tie ? 0 : j - indices.size(),
                           last   = is_tie ? indices[j] : n + k;
        values[j] = last < shortenings.size() ? shortenings[last] : 0.;
        if (is_tie)
          forces[j] =
            data.preload(discretisation.interfaces().sides()[indices[j]]);
        else if (const auto strain = data.mean_strain(k))
          values[j] = *strain;
        else
          forces[j] = work_of_stress(k) * data.mean_stress(k);
      }
    check_volume();
    add_shortenings(load);
  }

  void
  Preloads::shorten(const dealii::Vector<double> &d,
                    SceneLoad                    &load,
                    SystemVector                 &x)
  {
    for (unsigned int j = 0; j < units.size(); ++j)
      if (forces[j])
        {
          values[j] += d(j);
          load.rhs.multiplier.add(d(j), units[j].rhs.multiplier);
          add_scaled(x, d(j), units[j].x);
        }
  }

  dealii::Vector<double>
  Preloads::missing(const SystemVector &x) const
  {
    dealii::Vector<double> result(units.size());
    for (unsigned int j = 0; j < units.size(); ++j)
      if (forces[j])
        result(j) = *forces[j] - force(j, x);
    return result;
  }

  void
  Preloads::solve_units(SolveReport &report)
  {
    const auto &now = discretisation.linear_system().active;
    if (Utilities::MPI::max(now == active ? 0 : 1, run.comm) == 1)
      system_changed();
    for (unsigned int j = 0; j < units.size(); ++j)
      {
        Unit &unit = units[j];
        if (!forces[j] || unit.known)
          continue;
        const SolveReport of_unit = unit.has_x ?
                                      solver.solve_from(unit.rhs, unit.x) :
                                      solver.solve(unit.rhs, unit.x);
        report.iterations += of_unit.iterations;
        report.add_seconds(of_unit);
        report.converged = report.converged && of_unit.converged;
        unit.has_x = unit.known = true;
      }
    active = now;
  }

  dealii::Vector<double>
  Preloads::shortenings_for(const dealii::Vector<double> &lacks,
                            const SystemVector           &rhs) const
  {
    const unsigned int n = units.size();
    FullMatrix<double> stiffness(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        stiffness(i, j) =
          forces[i] && forces[j] ? force(i, units[j].x) : (i == j ? 1. : 0.);
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

  double
  Preloads::net_flux(const SystemVector &rhs) const
  {
    for (unsigned int j = 0; j < units.size(); ++j)
      if (forces[j] && fluxes(j) != 0.)
        return rhs.pressure * enclosure->pressure +
               rhs.multiplier * enclosure->multiplier;
    return 0.;
  }

  double
  Preloads::take_pressure(dealii::Vector<double> &lacks) const
  {
    dealii::Vector<double> free(units.size());
    for (unsigned int j = 0; j < units.size(); ++j)
      free(j) = forces[j] ? fluxes(j) : 0.;
    const double square = free * free;
    if (square == 0.)
      return 0.;
    const double pressure = -(lacks * free) / square;
    lacks.add(pressure, free);
    return pressure;
  }

  void
  Preloads::release(SystemVector &rhs, SystemVector &z, SolveReport &report)
  {
    if (!report.converged || !has_force())
      return;
    solve_units(report);
    if (!report.converged)
      return;
    dealii::Vector<double> lacks(units.size());
    for (unsigned int j = 0; j < units.size(); ++j)
      if (forces[j])
        lacks(j) = -force(j, z);
    const dealii::Vector<double> d = shortenings_for(lacks, rhs);
    for (unsigned int j = 0; j < units.size(); ++j)
      if (forces[j])
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
    const double size = size_of_forces(x);
    return size == 0. ? 0. : missing(x).linfty_norm() / size;
  }

  double
  Preloads::size_of_forces(const SystemVector &x) const
  {
    double size = largest_force();
    if (size > 0. || !has_force())
      return size;
    for (unsigned int j = 0; j < units.size(); ++j)
      {
        size = std::max(size, std::fabs(force(j, x)));
        if (units[j].known)
          size = std::max(size, std::fabs(values[j] * force(j, units[j].x)));
      }
    return size;
  }

  double
  Preloads::work_of_stress(const unsigned int k) const
  {
    return volume * unit_strain(k).norm_square();
  }

  void
  Preloads::check_resistance(const FullMatrix<double> &stiffness) const
  {
    // a lattice of pores resists with more of what its solid does
    constexpr double          least = 1e-9;
    std::vector<unsigned int> free;
    for (unsigned int j = indices.size(); j < units.size(); ++j)
      if (forces[j])
        free.push_back(j);
    if (free.empty())
      return;
    double modulus = 0.;
    for (const auto &body : discretisation.bodies())
      modulus = std::max(modulus, body->material.modulus());
    LAPACKFullMatrix<double> matrix(free.size(), free.size());
    for (unsigned int a = 0; a < free.size(); ++a)
      for (unsigned int b = 0; b < free.size(); ++b)
        matrix(a, b) = stiffness(free[a], free[b]);
    matrix.compute_svd();
    if (matrix.singular_value(free.size() - 1) > least * modulus * volume)
      return;
    run.parameters.fail(
      "Periodic cell/Mean strain",
      "free components that nothing resists",
      "free components of which none is a rigid motion of all cells, as shears along a single translation are, and bodies that "
      "hold together from cell to cell");
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
    const dealii::Vector<double> d = shortenings_for(missing(next), load.rhs);
    shorten(d, load, dx);
  }

  SolveReport
  Preloads::solve_other_loads(const SceneLoad &load, SystemVector &x)
  {
    SystemVector others = load.rhs;
    for (unsigned int j = 0; j < units.size(); ++j)
      if (forces[j])
        others.multiplier.add(-values[j], units[j].rhs.multiplier);
    SolveReport report = solver.solve(others, x);
    if (report.converged)
      solve_units(report);
    if (report.converged)
      for (unsigned int j = 0; j < units.size(); ++j)
        if (forces[j])
          add_scaled(x, values[j], units[j].x);
    return report;
  }

  SolveReport
  Preloads::solve(const bool goes_on, SceneLoad &load, SystemVector &x)
  {
    if (!has_force())
      return goes_on ? solver.solve_from(load.rhs, x) :
                       solver.solve(load.rhs, x);
    bool is_new = true;
    for (unsigned int j = 0; j < units.size(); ++j)
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
        for (unsigned int j = indices.size(); j < units.size(); ++j)
          {
            strain     = std::max(strain, std::fabs(values[j]));
            is_checked = is_checked && (!forces[j] || units[j].has_x);
          }
        const double tolerance = run.parameters.solver.tolerance;
        if (solves_load && is_checked &&
            !(lacks.linfty_norm() > tolerance * size_of_forces(x)) &&
            !(std::fabs(net_flux(load.rhs)) > tolerance * strain * volume))
          break;
        solves_load = true;
        solve_units(report);
        if (!report.converged)
          break;
        const dealii::Vector<double> d = shortenings_for(lacks, load.rhs);
        shorten(d, load, x);
        const SolveReport again = solver.solve_from(load.rhs, x);
        report.iterations += again.iterations;
        report.solve_seconds += again.solve_seconds;
        report.relative_residual = again.relative_residual;
        report.attainable        = again.attainable;
        report.converged         = again.converged;
      }
    dealii::Vector<double> lacks = missing(x);
    if (const double pressure = take_pressure(lacks); pressure != 0.)
      add_scaled(x, pressure, *enclosure);
    return report;
  }
} // namespace mortise
