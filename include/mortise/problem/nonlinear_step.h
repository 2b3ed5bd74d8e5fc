// One load step of a scene with laws of material that are not linear, as
// Newton's method sees it. Prescribed displacements are a part of the unknowns:
// what is left of them to the end of the step is lifted into the bodies by the
// tangent, since cells beside boundaries that move alone would invert.
#pragma once

#include <mortise/problem/acceleration.h>
#include <mortise/problem/arc_length.h>
#include <mortise/problem/contact/contact_step.h>
#include <mortise/problem/input/run_context.h>
#include <mortise/problem/scene/discretisation.h>
#include <mortise/problem/state.h>
#include <mortise/solvers/linear_solver.h>
#include <mortise/solvers/newton.h>
#include <mortise/solvers/scaled_residual.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  /// A step with arc-length control.
  struct PathStep
  {
    double length; ///< see ArcLength
    double end;    ///< the step ends at this time at the latest
    /// Loads at a time. Collective.
    std::function<SceneLoad(double)> load_at;
  };

  class NonlinearStep : private NonlinearProblem
  {
  public:
    /// References must live on.
    NonlinearStep(const RunContext &run,
                  Discretisation   &discretisation,
                  LinearSolver     &solver,
                  GlobalUnknowns   &unknowns);

    /// Solve for @p load from @p last on and set the solution, displacement and
    /// history of @p next; those of the best iterate if the report says that
    /// Newton's method did not converge. Linear solves are as loose as the next
    /// residual allows (Eisenstat, Walker 1996). The forces of pressures on
    /// deformed faces become part of the external ones of @p load, and so do
    /// changes of the global unknowns. Collective.
    /// @p data: of the time of @p load. @p contact: null, or that of the scene,
    /// without friction; each linear problem is then one of contact. Where
    /// interfaces follow the bodies it is made again with each pairing.
    SolveReport
    solve(const SceneData              &data,
          std::unique_ptr<ContactStep> &contact,
          SceneLoad                    &load,
          const State                  &last,
          State                        &next);

    /// The same with arc-length control, without contact; sets the time and
    /// path of @p next, too. @p load becomes that of this time. Collective;
    /// throws InputError where nothing depends on time.
    SolveReport
    solve(const PathStep &step,
          SceneLoad      &load,
          const State    &last,
          State          &next);

    /// Set the displacement and history of @p state to those of @p solutions, by
    /// body, whose system vector it has and @p load belongs to, and its path to
    /// that of @p increments, see SceneValues. Collective.
    void
    resume(const SceneLoad                 &load,
           const std::vector<BodySolution> &solutions,
           const std::vector<BodySolution> &increments,
           State                           &state) const;

    /// Take the tangent at @p state, the result of the last solve(), for the linear
    /// solver, which then solves to the tolerance. Collective.
    void
    linearise_at(const State &state);

    /// Of the last solve().
    const NewtonReport &
    report() const
    {
      return newton;
    }

    /// Why the last solve() did not converge, in words.
    const std::string &
    reason() const
    {
      return why;
    }

    /// Did it end at a state that has no answer, as bodies that nothing holds?
    bool
    has_no_answer() const
    {
      return is_wrong;
    }

  private:
    double
    residual(const SystemVector &x) override;
    void
    linearise(const SystemVector &x) override;
    SolveReport
    solve(SystemVector &x) override;
    SolveReport
    solve_linear(SystemVector &x);
    SolveReport
    solve_contact(SystemVector &x);
    /// Set @p dx to the increments of displacements and time for arc-length
    /// control at @p x, whose prescribed displacements lack @p rest.
    SolveReport
    solve_bordered(const SystemVector &x, const Vector &rest, SystemVector &dx);
    /// The same forces as in solve_bordered(), per time.
    SystemVector
    rate_of_forces(const SystemVector &x);
    /// Where the tangent with its initial stress has no preconditioner.
    void
    show_without_stress();
    /// Of linear solves.
    void
    set_tolerance(double eta);
    SolveReport
    solve_tangent(const SystemVector &forces, SystemVector &dx);
    /// Newton's method from @p x, the last state or its start.
    SolveReport
    iterate(const State &last, SystemVector &x);
    /// At most @p most iterations with the present pairs.
    NewtonReport
    improve(unsigned int most, SystemVector &x);
    /// Do interfaces of the scene follow the bodies?
    bool
    follows() const
    {
      return discretisation.interfaces().follow();
    }
    void
    begin_iterations();
    /// improve_with_pairs(); where it does not converge again from the last
    /// state, and then without the stiffness of contact forces: where edges
    /// press into the other side this is not positive, and iterations without
    /// it end that go astray with it.
    NewtonReport
    follow(const State &last, SystemVector &x);
    /// Iterations of which each has the pairs of the bodies at its start; that
    /// of the first is where the last states lead if @p extrapolates.
    NewtonReport
    improve_with_pairs(const State &last, bool extrapolates, SystemVector &x);
    /// Pair the bodies where they are at @p displacement. Collective.
    void
    pair_at(const Vector &displacement);
    /// With the present pairs, contact as @p known. Collective.
    void
    begin_contact(const std::optional<ContactRecords> &known);
    /// The same at the iterate @p x of a step from @p last on, where pairs were
    /// those of @p origin. Collective.
    void
    go_on(const ContactRecords &known,
          const State          &last,
          const SlipOrigin     &origin,
          const SystemVector   &x);
    /// The same at the state @p x = @p last, which contact need not have seen.
    void
    begin_contact_of(const State        &last,
                     const SlipOrigin   &origin,
                     const SystemVector &x);
    /// Let @p x be @p given, with pairs there; @p reached: records of contact with
    /// the pairs before, or none. Collective; throws InputError where bodies
    /// cannot be paired.
    void
    pair_again(const Iterate                       &given,
               const std::optional<ContactRecords> &reached,
               const State                         &last,
               const SlipOrigin                    &origin,
               SystemVector                        &x);
    /// With the present pairs. Collective.
    Iterate
    without_pairs(const SystemVector &x) const;
    std::optional<ContactRecords>
    records(const SystemVector &x) const;
    /// Without prescribed displacements.
    SystemVector
    free_part(const SystemVector &x) const;
    /// Set @p next and the forces of the load to those of the last iterate.
    void
    finish(const SystemVector &x, State &next);
    SystemVector
    first_iterate(const State &last) const;
    /// Let @p x, the last state, go on as the states before it did, where this
    /// leaves a much smaller residual.
    void
    extrapolate(SystemVector &x);
    /// The same with the pairs of where @p x goes on to. @p origin: as go_on().
    void
    extrapolate_pairs(const State      &last,
                      const SlipOrigin &origin,
                      SystemVector     &x);
    /// Set the response to @p x and r without what prescribed displacements
    /// lack; false if a cell inverts.
    bool
    balance(const SystemVector &x);
    /// @p forces less those of what is left of prescribed displacements.
    SystemVector
    lifted(const SystemVector &forces, const Vector &rest) const;
    /// Let global unknowns have the forces at @p x.
    void
    take_forces(const SystemVector &x);
    /// The load has the motions of rigid parts, and @p x, too, up to what turns.
    void
    settle(SystemVector &x);
    /// Add forces of multipliers to r, and set its gaps.
    void
    add_interfaces(const SystemVector &x);
    /// Of residual().
    double
    tolerance() const;
    /// What rounding leaves of the residual of @p x.
    double
    attainable(SystemVector x) const;
    /// What is left of prescribed displacements.
    Vector
    rest_of_prescribed(const SystemVector &x) const;
    /// Of the next problem of contact; forces are this @p part of its right
    /// hand side.
    double
    accuracy_of_contact(double part) const;
    double
    allowed_violation() const;
    /// Without what rounding leaves of the rest.
    void
    set_prescribed(SystemVector &x) const;
    /// With arc-length control: let the load be that at @p time.
    void
    set_time(double time);
    void
    print(unsigned int iteration, double residual) const;

    const RunContext &run;
    Discretisation   &discretisation;
    LinearSolver     &solver;
    GlobalUnknowns   &unknowns;
    const bool        may_yield; ///< one of the bodies
    Vector            paired_at; ///< displacement; empty: not yet
    Vector            begin;     ///< likewise, of the step
    /// Indices of owned components that are prescribed.
    std::vector<unsigned int>       prescribed, hanging;
    std::unique_ptr<ScaledResidual> norm;
    std::optional<ArcLength>        arc;      ///< with arc-length control
    Extrapolation                   accepted; ///< the last states

    // of the present step
    SceneLoad                    *load     = nullptr;
    const SceneData              *data     = nullptr;
    ContactStep                  *contact  = nullptr; ///< or none
    std::unique_ptr<ContactStep> *of_scene = nullptr; ///< which has it
    const PathStep               *along = nullptr; ///< without: time is given
    PointHistory                  before;
    BulkSystem::Response          response;    ///< to the last iterate
    SystemVector                  r;           ///< forces that are left at it
    std::optional<SystemVector> linearised_at; ///< of this step, or nothing yet
    double                      reference = 0.; ///< size of forces
    double       size = 0., size_before = 0.;   ///< of iterates' residuals
    bool         has_force_stiffness = true;    ///< the tangent, of contact
    unsigned int n_without_stiffness = 0;       ///< last steps without it
    double       contraction  = 0.;    ///< of the last iteration; 0: none yet
    double       time_of_load = 0.;    ///< with arc-length control
    bool         balanced     = false; ///< the iterate, but for its distance
    bool         stays    = false; ///< linear solves do not improve the iterate
    bool         violates = false; ///< the last solve friction, see ContactStep
    unsigned int last_iterations = 0;
    /// Iterations of linear solves per digit: of the last, and the least since
    /// preconditioners were made; 0: not yet known.
    double last_cost = 0., least_cost = 0.;
    /// The step starts from the last state, at which tangents are elastic.
    bool         at_last_state = true;
    bool         shows_flow    = false; ///< preconditioners, not elastic ones
    NewtonReport newton;
    std::string  why;
    bool         is_wrong = false;
  };
} // namespace mortise
