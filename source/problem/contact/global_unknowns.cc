#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/problem/contact/global_unknowns.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

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

  GlobalUnknowns::GlobalUnknowns(const RunContext     &run,
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
    all.resize(indices.size());
    pair_again();
  }

  void
  GlobalUnknowns::pair_again()
  {
    for (unsigned int j = 0; j < all.size(); ++j)
      if (all[j].is_motion())
        set_lift(all[j]);
      else
        {
          all[j].rhs = discretisation.linear_system().zero_vector();
          all[j].x   = {};
          add_offset(
            discretisation.interfaces().all()[indices[j]],
            [](const Point<dim> &) { return 1.; },
            all[j].rhs.multiplier);
        }
    have_units = known = false;
  }

  void
  GlobalUnknowns::set_product(Unknown &unknown) const
  {
    const BlockSystem &system  = discretisation.linear_system();
    SystemVector       product = system.zero_vector();
    system.apply_to_constrained(unknown.at_nodes, product, &unknown.borne);
    scale(product, -1.);
    unknown.rhs = product;
  }

  void
  GlobalUnknowns::set_lift(Unknown &unknown) const
  {
    const unsigned int p = unknown.part;
    if (parts[p].is_finite || unknown.at_nodes.size() == 0)
      {
        Unknown next       = lift(p, parts[p].change(at[p], unknown.direction));
        unknown.prescribed = std::move(next.prescribed);
        unknown.at_nodes   = next.at_nodes;
      }
    set_product(unknown);
  }

  GlobalUnknowns::Unknown
  GlobalUnknowns::lift(const unsigned int p, const AffineField &field) const
  {
    Unknown result;
    if (basis[p].empty())
      {
        result.prescribed = discretisation.lift(parts[p], field);
        result.at_nodes   = discretisation.at_nodes(result.prescribed);
        return result;
      }
    result.at_nodes.reinit(basis[p].front().at_nodes);
    const double scale = parts[p].where.size;
    for (unsigned int k = 0; k < basis[p].size(); ++k)
      {
        const double factor =
          k < dim ? field.value[k] :
                    scale * field.gradient[(k - dim) / dim][k % dim];
        result.at_nodes.add(factor, basis[p][k].at_nodes);
        for (const auto &[dof, value] : basis[p][k].prescribed)
          result.prescribed[dof] += factor * value;
      }
    return result;
  }

  void
  GlobalUnknowns::add_motions()
  {
    if (std::exchange(have_motions, true))
      return;
    basis.resize(parts.size());
    at.resize(parts.size());
    for (unsigned int p = 0; p < parts.size(); ++p)
      {
        std::vector<Unknown> own;
        for (unsigned int k = 0; k < dim + dim * dim && parts[p].is_finite; ++k)
          {
            AffineField field;
            if (k < dim)
              field.value[k] = 1.;
            else
              field.gradient[(k - dim) / dim][k % dim] =
                1. / parts[p].where.size;
            own.push_back(lift(p, field));
          }
        basis[p] = std::move(own);
        for (const Motion &direction : parts[p].free)
          {
            Unknown next;
            next.part      = p;
            next.direction = direction;
            all.push_back(std::move(next));
            values.push_back(0.);
            forces.emplace_back(0.);
          }
      }
    have_units = known = false;
  }

  void
  GlobalUnknowns::add_shortenings(SceneLoad &load) const
  {
    for (unsigned int j = 0; j < indices.size(); ++j)
      load.rhs.multiplier.add(values[j], all[j].rhs.multiplier);
  }

  std::vector<bool>
  GlobalUnknowns::have_forces() const
  {
    std::vector<bool> result(discretisation.interfaces().all().size(), false);
    for (unsigned int j = 0; j < indices.size(); ++j)
      result[indices[j]] = forces[j].has_value();
    return result;
  }

  void
  GlobalUnknowns::set_motions()
  {
    for (unsigned int p = 0; p < parts.size(); ++p)
      at[p] = parts[p].given;
    for (unsigned int j = indices.size(); j < all.size(); ++j)
      for (unsigned int i = 0; i < 6; ++i)
        at[all[j].part][i] += values[j] * all[j].direction[i];
  }

  void
  GlobalUnknowns::store(State &state) const
  {
    state.shortenings.assign(discretisation.interfaces().all().size(), 0.);
    for (unsigned int j = 0; j < indices.size(); ++j)
      state.shortenings[indices[j]] = values[j];
    state.motions.clear();
    for (const Motion &motion : at)
      state.motions.insert(state.motions.end(), motion.begin(), motion.end());
  }

  std::vector<double>
  GlobalUnknowns::values_of(const FreeMotions &free, const unsigned int k) const
  {
    std::vector<double> result(all.size(), 0.);
    for (unsigned int j = indices.size(); j < all.size(); ++j)
      {
        const RigidPart &part = parts[all[j].part];
        const Extent    &body = free.of_body[part.body];
        const Motion    &m    = free.motions[k][part.body];
        const auto       rows = part.rows_of(body);
        for (unsigned int i = 0; i < 6; ++i)
          result[j] +=
            all[j].direction[i] *
            std::inner_product(rows[i].begin(), rows[i].end(), m.begin(), 0.);
      }
    return result;
  }

  double
  GlobalUnknowns::work(const std::vector<double> &d,
                       const Vector              &opening) const
  {
    double sum = 0.;
    for (unsigned int j = 0; j < all.size(); ++j)
      if (forces[j])
        sum += *forces[j] *
               (j < indices.size() ? part_of_opening(j, opening) : d[j]);
    return sum;
  }

  void
  GlobalUnknowns::add_gaps(const std::vector<double> &d,
                           const double               factor,
                           Vector                    &gaps) const
  {
    for (unsigned int j = 0; j < all.size(); ++j)
      gaps.add(factor * d[j], all[j].rhs.multiplier);
  }

  double
  GlobalUnknowns::part_of_opening(const unsigned int j,
                                  const Vector      &opening) const
  {
    const Vector &w = all[j].rhs.multiplier;
    return (w * opening) / (w * w);
  }

  namespace
  {
    /// The sum of the sizes of the terms of a^T b. Collective.
    double
    size_of_product(const Vector &a, const Vector &b)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < a.locally_owned_size(); ++i)
        sum += std::fabs(a.begin()[i] * b.begin()[i]);
      return Utilities::MPI::sum(sum, a.get_mpi_communicator());
    }
  } // namespace

  double
  GlobalUnknowns::size_of_product(const unsigned int  j,
                                  const SystemVector &x) const
  {
    const SystemVector &w = all[j].rhs;
    return mortise::size_of_product(w.displacement, x.displacement) +
           (x.multiplier.size() > 0 ?
              mortise::size_of_product(w.multiplier, x.multiplier) :
              0.);
  }

  double
  GlobalUnknowns::product(const unsigned int j, const SystemVector &x) const
  {
    const Unknown &unknown = all[j];
    double         result  = 0.;
    if (unknown.is_motion())
      {
        result += unknown.rhs.displacement * x.displacement;
        if (x.pressure.size() > 0)
          result += unknown.rhs.pressure * x.pressure;
      }
    if (x.multiplier.size() > 0)
      result += unknown.rhs.multiplier * x.multiplier;
    return result;
  }

  double
  GlobalUnknowns::force(const unsigned int j, const SystemVector &x) const
  {
    return -product(j, x);
  }

  void
  GlobalUnknowns::begin(const SceneData &data,
                        const State     &last,
                        SceneLoad       &load)
  {
    for (unsigned int j = 0; j < indices.size(); ++j)
      {
        values[j] = indices[j] < last.shortenings.size() ?
                      last.shortenings[indices[j]] :
                      0.;
        forces[j] =
          data.preload(discretisation.interfaces().sides()[indices[j]]);
      }
    add_shortenings(load);
    parts = data.rigid_parts(discretisation.bodies());
    if (parts.empty())
      return;
    add_motions();
    for (unsigned int j = indices.size(); j < all.size(); ++j)
      {
        const unsigned int p = all[j].part;
        values[j]            = 0.;
        for (unsigned int i = 0; i < 6; ++i)
          if (6 * p + i < last.motions.size())
            values[j] += all[j].direction[i] * last.motions[6 * p + i];
      }
    set_motions();
    begin_values      = values;
    others.prescribed = load.prescribed;
    if (load.prescribed_at_nodes.size() > 0)
      others.at_nodes = load.prescribed_at_nodes;
    for (unsigned int p = 0; p < parts.size(); ++p)
      {
        Unknown moved = lift(p, parts[p].displacement(at[p]));
        set_product(moved);
        add_to_load(moved, 1., load);
      }
    for (unsigned int j = indices.size(); j < all.size(); ++j)
      set_lift(all[j]);
    known = false;
    if (!discretisation.linear_system().bulk->is_nonlinear())
      set_loads_of_motions(load);
  }

  void
  GlobalUnknowns::go_back(SceneLoad &load)
  {
    for (unsigned int j = 0; j < all.size(); ++j)
      if (values[j] != begin_values[j])
        change(j, begin_values[j] - values[j], load, nullptr);
    settle(load);
  }

  std::vector<double>
  GlobalUnknowns::work_of(const Vector &forces) const
  {
    std::vector<double> result(all.size(), 0.);
    for (unsigned int j = indices.size(); j < all.size() && forces.size() > 0;
         ++j)
      result[j] = all[j].at_nodes * forces;
    return result;
  }

  void
  GlobalUnknowns::set_loads_of_motions(const SceneLoad &load)
  {
    const BlockSystem &system = discretisation.linear_system();
    SystemVector       free   = system.zero_vector();
    Vector             borne;
    if (!load.prescribed.empty())
      system.apply_to_constrained(discretisation.at_nodes(load.prescribed),
                                  free,
                                  &borne);
    const std::vector<double> external = work_of(load.external),
                              internal = work_of(borne);
    for (unsigned int j = indices.size(); j < all.size(); ++j)
      forces[j] = external[j] - internal[j] +
                  parts[all[j].part].work(at[all[j].part], all[j].direction);
  }

  void
  GlobalUnknowns::take_forces(const NodalForces &at_nodes)
  {
    for (unsigned int j = indices.size(); j < all.size(); ++j)
      if (parts[all[j].part].is_finite)
        {
          Unknown moved =
            lift(all[j].part,
                 parts[all[j].part].change(at[all[j].part], all[j].direction));
          all[j].at_nodes   = moved.at_nodes;
          all[j].prescribed = std::move(moved.prescribed);
        }
    const std::vector<double> external       = work_of(at_nodes.external),
                              internal       = work_of(at_nodes.internal),
                              of_multipliers = work_of(at_nodes.of_multipliers);
    lacks.assign(all.size(), 0.);
    sizes.assign(all.size(), 0.);
    for (unsigned int j = indices.size(); j < all.size(); ++j)
      {
        const double loads =
          external[j] +
          parts[all[j].part].work(at[all[j].part], all[j].direction);
        lacks[j] = loads - internal[j] - of_multipliers[j];
        sizes[j] =
          std::fabs(loads) +
          mortise::size_of_product(all[j].at_nodes, at_nodes.internal) +
          mortise::size_of_product(all[j].at_nodes, at_nodes.of_multipliers);
        forces[j] = loads - internal[j];
      }
    Vector total = at_nodes.external;
    total -= at_nodes.internal;
    total -= at_nodes.of_multipliers;
    stiffness_of_forces.reinit(all.size(), all.size());
    for (unsigned int p = 0; p < parts.size(); ++p)
      if (!basis[p].empty())
        add_stiffness_of_forces(p, total);
  }

  void
  GlobalUnknowns::add_stiffness_of_forces(const unsigned int p,
                                          const Vector      &total)
  {
    constexpr double    step = 1e-5; // of angles
    std::vector<double> moments;
    for (const Unknown &of_entry : basis[p])
      moments.push_back(of_entry.at_nodes * total);
    const RigidPart &part = parts[p];
    const auto       work = [&](const Motion &motion, const Motion &direction) {
      const AffineField field = part.change(motion, direction);
      double            sum   = part.work(motion, direction);
      for (unsigned int k = 0; k < moments.size(); ++k)
        sum += moments[k] *
               (k < dim ?
                        field.value[k] :
                        part.where.size * field.gradient[(k - dim) / dim][k % dim]);
      return sum;
    };
    for (unsigned int i = indices.size(); i < all.size(); ++i)
      for (unsigned int j = indices.size(); j < all.size(); ++j)
        if (all[i].part == p && all[j].part == p)
          {
            Motion ahead = at[p], behind = at[p];
            for (unsigned int k = 0; k < 6; ++k)
              {
                ahead[k] += step * all[j].direction[k];
                behind[k] -= step * all[j].direction[k];
              }
            stiffness_of_forces(i, j) =
              (work(ahead, all[i].direction) - work(behind, all[i].direction)) /
              (2. * step);
          }
  }

  void
  GlobalUnknowns::count_from(const SystemVector &moved)
  {
    for (unsigned int j = indices.size(); j < all.size(); ++j)
      {
        if (!known)
          set_lift(all[j]);
        *forces[j] -= product(j, moved);
      }
  }

  void
  GlobalUnknowns::settle(SceneLoad &load) const
  {
    if (std::all_of(basis.begin(), basis.end(), [](const auto &of_part) {
          return of_part.empty();
        }))
      return;
    load.prescribed          = others.prescribed;
    Vector before            = load.prescribed_at_nodes;
    load.prescribed_at_nodes = others.at_nodes;
    for (unsigned int p = 0; p < parts.size(); ++p)
      {
        const Unknown moved = lift(p, parts[p].displacement(at[p]));
        load.prescribed_at_nodes += moved.at_nodes;
        for (const auto &[dof, value] : moved.prescribed)
          load.prescribed[dof] += value;
      }
    before -= load.prescribed_at_nodes;
    if (load.rhs.multiplier.size() == 0)
      return;
    Vector gaps(load.rhs.multiplier);
    discretisation.linear_system().constraint.vmult_free(gaps, before);
    load.rhs.multiplier += gaps;
  }

  void
  GlobalUnknowns::add_to_load(const Unknown &unknown,
                              const double   d,
                              SceneLoad     &load) const
  {
    if (d == 0.)
      return;
    if (load.rhs.multiplier.size() > 0)
      load.rhs.multiplier.add(d, unknown.rhs.multiplier);
    if (!unknown.is_motion())
      return;
    for (const auto &[dof, value] : unknown.prescribed)
      load.prescribed[dof] += d * value;
    if (discretisation.linear_system().bulk->is_nonlinear())
      {
        load.prescribed_at_nodes.add(d, unknown.at_nodes);
        return;
      }
    load.rhs.displacement.add(d, unknown.rhs.displacement);
    if (load.rhs.pressure.size() > 0)
      load.rhs.pressure.add(d, unknown.rhs.pressure);
  }

  void
  GlobalUnknowns::change(const unsigned int j,
                         const double       d,
                         SceneLoad         &load,
                         SystemVector      *x)
  {
    values[j] += d;
    add_to_load(all[j], d, load);
    if (all[j].is_motion())
      {
        set_motions();
        for (unsigned int i = indices.size(); i < all.size(); ++i)
          *forces[i] -= d * stiffness_of(i, j);
      }
    if (x != nullptr)
      add_scaled(*x, d, all[j].x);
  }

  double
  GlobalUnknowns::stiffness_of(const unsigned int i, const unsigned int j) const
  {
    if (!all[i].is_motion() || !all[j].is_motion())
      return 0.;
    const double of_forces =
      stiffness_of_forces.empty() ? 0. : stiffness_of_forces(i, j);
    return all[i].at_nodes * all[j].borne - of_forces;
  }

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
  GlobalUnknowns::relative(const dealii::Vector<double> &lacks,
                           const SystemVector           &x) const
  {
    double preload = 0., motion = 0., result = 0.;
    for (unsigned int j = 0; j < all.size(); ++j)
      if (all[j].is_motion())
        motion =
          std::max({motion, std::fabs(*forces[j]), size_of_product(j, x)});
      else
        preload = std::max(preload, std::fabs(forces[j].value_or(0.)));
    for (unsigned int j = 0; j < all.size(); ++j)
      if (const double size = all[j].is_motion() ? motion : preload; size > 0.)
        result = std::max(result, std::fabs(lacks(j)) / size);
    return result;
  }

  void
  GlobalUnknowns::solve_units(SolveReport &report)
  {
    const auto &now = discretisation.linear_system().active;
    if (known && Utilities::MPI::max(now == active ? 0 : 1, run.comm) == 0)
      return;
    for (Unknown &unknown : all)
      {
        if (unknown.is_motion() && !known)
          set_lift(unknown);
        const SolveReport of_one = have_units ?
                                     solver.solve_from(unknown.rhs, unknown.x) :
                                     solver.solve(unknown.rhs, unknown.x);
        report.iterations += of_one.iterations;
        report.add_seconds(of_one);
        report.converged = report.converged && of_one.converged;
      }
    active     = now;
    have_units = known = true;
  }

  dealii::Vector<double>
  GlobalUnknowns::changes_for(const dealii::Vector<double> &lacks) const
  {
    const unsigned int n = all.size();
    FullMatrix<double> stiffness(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        stiffness(i, j) = !forces[i] || !forces[j] ?
                            (i == j ? 1. : 0.) :
                            force(i, all[j].x) + stiffness_of(i, j);
    stiffness.gauss_jordan();
    dealii::Vector<double> result(n);
    stiffness.vmult(result, lacks);
    return result;
  }

  std::vector<double>
  GlobalUnknowns::on_motions(const Functional &functional) const
  {
    std::vector<double> result(all.size(), 0.);
    for (unsigned int j = indices.size(); j < all.size(); ++j)
      result[j] = functional(all[j].prescribed, all[j].borne);
    return result;
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
    const dealii::Vector<double> d = changes_for(missed);
    for (unsigned int j = 0; j < all.size(); ++j)
      {
        add_scaled(load.rhs, d(j), all[j].rhs);
        add_scaled(z, d(j), all[j].x);
        for (const auto &[dof, value] : all[j].prescribed)
          load.prescribed[dof] += d(j) * value;
      }
    const SolveReport again = solver.solve_from(load.rhs, z);
    report.iterations += again.iterations;
    report.solve_seconds += again.solve_seconds;
    report.relative_residual = again.relative_residual;
    report.attainable        = again.attainable;
    report.converged         = again.converged;
  }

  bool
  GlobalUnknowns::has_force() const
  {
    return std::any_of(forces.begin(), forces.end(), [](const auto &given) {
      return given.has_value();
    });
  }

  double
  GlobalUnknowns::lack(const SystemVector &x, const double reference) const
  {
    double result = 0., largest = 0.;
    for (unsigned int j = 0; j < indices.size(); ++j)
      if (forces[j])
        {
          largest = std::max(largest, std::fabs(*forces[j]));
          result  = std::max(result, std::fabs(*forces[j] - force(j, x)));
        }
    if (result > 0.)
      result /= largest;
    const double size =
      sizes.empty() ? 0. : *std::max_element(sizes.begin(), sizes.end());
    for (unsigned int j = indices.size(); j < all.size(); ++j)
      // bodies that turn as a whole bear nothing but rounding
      if (const double stiffness = all[j].at_nodes * all[j].borne,
          scale =
            std::max(size, std::sqrt(std::max(0., stiffness)) * reference);
          scale > 0.)
        result = std::max(result, std::fabs(lacks[j]) / scale);
    return result;
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
    for (unsigned int j = indices.size(); j < all.size(); ++j)
      missed(j) = lacks[j] - force(j, dx) - all[j].borne * rest;
    const dealii::Vector<double> d = changes_for(missed);
    for (unsigned int j = 0; j < all.size(); ++j)
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
      add_scaled(others, -values[j], all[j].rhs);
    SolveReport report = solver.solve(others, x);
    if (report.converged)
      solve_units(report);
    if (report.converged)
      for (unsigned int j = 0; j < all.size(); ++j)
        add_scaled(x, values[j], all[j].x);
    return report;
  }

  SolveReport
  GlobalUnknowns::solve(const bool goes_on, SceneLoad &load, SystemVector &x)
  {
    if (all.empty())
      return goes_on ? solver.solve_from(load.rhs, x) :
                       solver.solve(load.rhs, x);
    const bool is_new =
      std::all_of(values.begin(), values.end(), [](const double value) {
        return value == 0.;
      });
    SolveReport report      = goes_on ? solver.solve_from(load.rhs, x) :
                              is_new  ? solver.solve(load.rhs, x) :
                                        solve_other_loads(load, x);
    bool        solves_load = goes_on || is_new; // not only about
    for (unsigned int k = 0; k < max_corrections && report.converged; ++k)
      {
        const dealii::Vector<double> lacks = missing(x);
        if (solves_load &&
            !(relative(lacks, x) > run.parameters.solver.tolerance))
          break;
        solves_load = true;
        solve_units(report);
        if (!report.converged)
          break;
        const dealii::Vector<double> d = changes_for(lacks);
        for (unsigned int j = 0; j < all.size(); ++j)
          change(j, d(j), load, &x);
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
