#include <mortise/problem/nonlinear_step.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_newton_iterations = 50, most_rises = 20;

    /// Residuals that are larger are no rounding.
    constexpr double largest_rounding = 1e-6;

    void
    warn_of_kept_normals(const RunContext     &run,
                         const Discretisation &discretisation)
    {
      std::set<std::string> named;
      for (const InterfaceParameters &interface :
           discretisation.interfaces().sides())
        if (!interface.is_support && !interface.follows_bodies &&
            (interface.law != Law::tie || interface.preload) &&
            is_finite(run.parameters.bodies[interface.slave.body].material) &&
            named.insert(interface.name).second)
          run.log.warning(
            "interface " + interface.name + ": " +
            (interface.preload ?
               "Preload pulls along the normals of the undeformed bodies, and is wrong where they turn" :
               "Law = " + name_of(interface.law) +
                 " keeps the pairs and normals of the undeformed bodies, and is wrong where they turn or slide far"));
    }

    /// Relative to the forces of a step.
    constexpr double largest_residual = 1e3;

    /// A step starts from an extrapolation that leaves less than this part of
    /// the residual of the last state: bodies that bend are stretched by it,
    /// and then an iteration of Newton's method from there is worse.
    constexpr double extrapolated_residual = 0.1;
  } // namespace

  NonlinearStep::NonlinearStep(const RunContext &run,
                               Discretisation   &discretisation,
                               LinearSolver     &solver,
                               GlobalUnknowns   &unknowns)
    : run(run)
    , discretisation(discretisation)
    , solver(solver)
    , unknowns(unknowns)
    , may_yield(
        std::any_of(discretisation.bodies().begin(),
                    discretisation.bodies().end(),
                    [](const auto &body) { return has_history(*body); }))
  {
    const MultigridLevel &level =
      discretisation.linear_system().bulk->levels().front();
    for (const unsigned int i : level.constrained)
      (level.space->hanging_nodes().is_constrained(
         level.layout->local_to_global(i) / dim) ?
         hanging :
         prescribed)
        .push_back(i);
    if (run.parameters.steps.by_arc_length)
      arc.emplace(discretisation.linear_system().bulk->diagonal(),
                  level.constrained);
    warn_of_kept_normals(run, discretisation);
  }

  Vector
  NonlinearStep::rest_of_prescribed(const SystemVector &x) const
  {
    Vector rest;
    discretisation.linear_system().bulk->initialize(rest);
    for (const unsigned int i : prescribed)
      rest.local_element(i) = load->prescribed_at_nodes.local_element(i) -
                              x.displacement.local_element(i);
    return rest;
  }

  void
  NonlinearStep::set_prescribed(SystemVector &x) const
  {
    for (const unsigned int i : prescribed)
      x.displacement.local_element(i) =
        load->prescribed_at_nodes.local_element(i);
  }

  void
  NonlinearStep::settle(SystemVector &x)
  {
    /// Of displacements: boundaries that move so little alone do not spoil
    /// cells.
    constexpr double small = 1e-6;
    for (const unsigned int i : hanging)
      x.displacement.local_element(i) = 0.;
    unknowns.settle(*load);
    if (rest_of_prescribed(x).linfty_norm() <
        small * x.displacement.linfty_norm())
      set_prescribed(x);
  }

  SystemVector
  NonlinearStep::lifted(const SystemVector &given, const Vector &rest) const
  {
    SystemVector result = given;
    if (rest.linfty_norm() == 0.)
      return result;
    SystemVector forces = discretisation.linear_system().zero_vector();
    discretisation.linear_system().apply_to_constrained(rest, forces);
    add_scaled(result, -1., forces);
    if (contact != nullptr)
      result.multiplier = 0.;
    return result;
  }

  void
  NonlinearStep::resume(const SceneLoad                 &given,
                        const std::vector<BodySolution> &solutions,
                        const std::vector<BodySolution> &increments,
                        State                           &state) const
  {
    const BulkSystem &bulk = *discretisation.linear_system().bulk;
    state.displacement     = state.solution.displacement;
    state.displacement += given.prescribed_at_nodes;
    for (const unsigned int i : hanging)
      state.displacement.local_element(i) = 0.;
    std::vector<CellHistories> histories;
    for (const BodySolution &of_body : solutions)
      histories.push_back(of_body.history);
    state.history = bulk.by_point(histories);
    if (!increments.empty())
      bulk.set_displacement(
        [&](const auto body, const auto dof) {
          return increments[body].displacement(dof);
        },
        state.path.increment);
  }

  void
  NonlinearStep::add_interfaces(const SystemVector &x)
  {
    const BlockSystem &system = discretisation.linear_system();
    Vector             forces(r.displacement);
    forces = 0.;
    // iterates have multipliers in their own directions, not in those of slip
    system.constraint.Tvmult_add(forces, x.multiplier);
    r.displacement -= forces;
    if (contact != nullptr)
      return; // which sees to gaps itself
    Vector moved(x.displacement);
    moved -= load->prescribed_at_nodes;
    system.constraint.vmult_free(r.multiplier, moved);
    system.subtract_spring_opening(r.multiplier, x.multiplier);
    r.multiplier.sadd(-1., 1., load->rhs.multiplier);
  }

  bool
  NonlinearStep::balance(const SystemVector &x)
  {
    const BlockSystem &system = discretisation.linear_system();
    response                  = system.bulk->respond(x.displacement,
                                    x.pressure,
                                    before,
                                    load->thermal_strains_at_points);
    if (!(response.least_jacobian > 0.))
      {
        why =
          "a cell inverts: " + system.bulk->place_of_least_jacobian(response);
        return false;
      }
    r              = system.zero_vector();
    r.displacement = load->external;
    r.displacement -= response.forces;
    if (load->follower_pressures)
      r.displacement +=
        system.bulk->forces_of(*load->follower_pressures, x.displacement);
    if (system.mixed())
      {
        r.pressure = load->rhs.pressure;
        r.pressure -= response.dilatation;
        system.free_pressures.project_residual(r.pressure);
      }
    if (r.multiplier.size() > 0)
      add_interfaces(x);
    if (unknowns.has_motions())
      take_forces(x);
    for (const unsigned int i : system.bulk->levels().front().constrained)
      r.displacement.local_element(i) = 0.;
    return true;
  }

  void
  NonlinearStep::take_forces(const SystemVector &x)
  {
    const BulkSystem           &bulk = *discretisation.linear_system().bulk;
    GlobalUnknowns::NodalForces forces{load->external,
                                       response.forces,
                                       response.forces};
    if (load->follower_pressures)
      forces.external +=
        bulk.forces_of(*load->follower_pressures, x.displacement);
    forces.of_multipliers = 0.;
    if (r.multiplier.size() > 0)
      discretisation.linear_system().constraint.Tvmult_add_free(
        forces.of_multipliers, x.multiplier);
    unknowns.take_forces(forces);
  }

  double
  NonlinearStep::residual(const SystemVector &x)
  {
    if (along != nullptr)
      set_time(x.time);
    if (!balance(x))
      return std::numeric_limits<double>::infinity();
    const Vector rest     = rest_of_prescribed(x);
    const double reached  = norm->norm(lifted(r, rest));
    const bool   is_first = reference == 0.;
    if (is_first)
      {
        const double energy = std::fabs(response.forces * x.displacement);
        reference           = std::max(reached, std::sqrt(energy));
      }
    size                   = reached == 0. ? 0. : reached / reference;
    const double tolerance = this->tolerance();
    if (size > tolerance && (is_first || size < largest_rounding) &&
        !follows() && (stays || reached <= attainable(x)))
      size = tolerance;
    // a body that is prescribed as a whole has no forces that could be left
    // and the laws of contact are those of the last solve
    if (rest.linfty_norm() > 0. || violates ||
        (!linearised_at && contact != nullptr))
      size = std::max(size, 2. * tolerance);
    if (along == nullptr)
      size = std::max(size, unknowns.lack(x, reference));
    balanced = size <= tolerance;
    if (along != nullptr)
      size = std::max(size, arc->rest(x.displacement));
    return size;
  }

  double
  NonlinearStep::attainable(SystemVector x) const
  {
    SystemVector rhs = discretisation.linear_system().zero_vector();
    rhs.displacement = load->external;
    for (const unsigned int i :
         discretisation.linear_system().bulk->levels().front().constrained)
      rhs.displacement.local_element(i) = x.displacement.local_element(i) = 0.;
    return norm->attainable(rhs, x);
  }

  void
  NonlinearStep::print(const unsigned int iteration, const double reached) const
  {
    run.log.line("    Newton " + std::to_string(iteration) + "  residual " +
                 RunLog::number(reached) + "  linear iterations " +
                 std::to_string(last_iterations));
  }

  SystemVector
  NonlinearStep::first_iterate(const State &last) const
  {
    SystemVector x = discretisation.linear_system().zero_vector();
    if (last.displacement.size() > 0)
      {
        x              = last.solution;
        x.displacement = last.displacement;
      }
    x.time = last.time;
    return x;
  }

  void
  NonlinearStep::extrapolate(SystemVector &x)
  {
    accepted.add({x, {}});
    if (accepted.n_states() == 1)
      return;
    double smallest = extrapolated_residual * residual(x);
    for (unsigned int n = 2; n <= accepted.n_states(); ++n)
      {
        const SystemVector ahead = accepted.at(data->at_time(), n).x;
        const double       there = residual(ahead);
        if (there < smallest)
          {
            x             = ahead;
            smallest      = there;
            at_last_state = false;
          }
      }
  }

  void
  NonlinearStep::begin_iterations()
  {
    reference = size = size_before = contraction = 0.;
    stays = violates = false;
    at_last_state    = true;
    linearised_at.reset();
    why      = "Newton's method stagnates";
    is_wrong = false;
  }

  SolveReport
  NonlinearStep::iterate(const State &last, SystemVector &x)
  {
    const BlockSystem &system = discretisation.linear_system();
    before = last.history.empty() ? system.bulk->no_history() : last.history;
    begin_iterations();
    if (!norm)
      norm = std::make_unique<ScaledResidual>(system);
    if (along == nullptr && contact == nullptr && !follows())
      extrapolate(x);
    newton = follows() ? follow(last, x) : improve(most_newton_iterations, x);
    if (!newton.converged)
      least_cost = 0.; // preconditioners are of a state that is left

    SolveReport report       = newton.linear;
    report.iterations        = newton.linear_iterations;
    report.relative_residual = newton.residual;
    report.attainable        = 0.;
    report.tolerance         = tolerance();
    report.converged         = newton.converged;
    return report;
  }

  double
  NonlinearStep::tolerance() const
  {
    // problems of contact are solved to the tolerance beside all forces
    return (contact != nullptr ? 10. : 1.) * run.parameters.solver.tolerance;
  }

  NewtonReport
  NonlinearStep::improve(const unsigned int most, SystemVector &x)
  {
    NewtonOptions options;
    options.tolerance      = tolerance();
    options.max_iterations = most;
    options.accepted       = largest_residual;
    options.patience       = most_rises;
    if (most > 1)
      options.monitor = [this](const unsigned int k, const double reached) {
        print(k, reached);
      };
    return solve_newton(*this, options, x);
  }

  SystemVector
  NonlinearStep::free_part(const SystemVector &x) const
  {
    SystemVector result = x;
    result.displacement -= load->prescribed_at_nodes;
    for (const unsigned int i :
         discretisation.linear_system().bulk->levels().front().constrained)
      result.displacement.local_element(i) = 0.;
    return result;
  }

  void
  NonlinearStep::finish(const SystemVector &x, State &next)
  {
    const BulkSystem &bulk = *discretisation.linear_system().bulk;
    if (load->follower_pressures)
      load->external +=
        bulk.forces_of(*load->follower_pressures, x.displacement);
    next.displacement = x.displacement;
    next.history      = response.history;
    next.solution     = free_part(x);
    if (contact == nullptr)
      return;
    if (newton.converged)
      contact->accept(*load, next.solution);
    else
      contact->go_back();
  }

  SolveReport
  NonlinearStep::solve(const SceneData              &of_step,
                       std::unique_ptr<ContactStep> &of_contact,
                       SceneLoad                    &given,
                       const State                  &last,
                       State                        &next)
  {
    load                     = &given;
    data                     = &of_step;
    of_scene                 = &of_contact;
    contact                  = of_contact.get();
    SystemVector      x      = first_iterate(last);
    const SolveReport report = iterate(last, x);
    finish(x, next);
    return report;
  }
} // namespace mortise
