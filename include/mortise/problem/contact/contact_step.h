// One load step of a scene with contact, as Newton's method sees it: an
// evaluation chooses the active set and which of its nodes slip, a
// linearisation is the system of that set.
#pragma once

#include <mortise/contact/active_set.h>
#include <mortise/contact/contact_edge.h>
#include <mortise/contact/contact_records.h>
#include <mortise/mortar/slip_origin.h>
#include <mortise/problem/contact/friction_set.h>
#include <mortise/problem/contact/global_unknowns.h>
#include <mortise/problem/contact/solved_contact.h>
#include <mortise/problem/input/run_context.h>
#include <mortise/problem/scene/discretisation.h>
#include <mortise/solvers/linear_solver.h>
#include <mortise/solvers/newton.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  class ContactStep : private NonlinearProblem
  {
  public:
    /// References must live on. @p known: a guess for the first step, or what
    /// resume() continues from. Collective.
    ContactStep(const RunContext                    &run,
                Discretisation                      &discretisation,
                LinearSolver                        &solver,
                GlobalUnknowns                      &unknowns,
                const std::optional<ContactRecords> &known);

    /// Solve for @p load, that of @p data, of which global unknowns
    /// become a part. The first set is extrapolated from the last steps; in the
    /// first step it is that of the constructor, or the closed gaps of the
    /// undeformed meshes; all nodes if it leaves a rigid motion free. Before
    /// the last set linear solves are as loose as the choice of the next set
    /// allows. The report is that of the last one, its seconds those of all;
    /// not converged after 1000 sets, 60 with friction. Throws InputError with
    /// body and motion if contact is lost, or friction does not hold a body
    /// that nothing else does. Collective.
    /// @p accuracy: of the last linear solve. @p part: of the right hand side
    /// that forces are. @p violation_allowed: of the law of friction, beside the
    /// largest traction.
    SolveReport
    solve(const SceneData &data,
          SceneLoad       &load,
          SystemVector    &x,
          double           accuracy,
          double           part              = 1.,
          double           violation_allowed = 0.);

    /// Did the last solve() end without the set of its solution, since sets
    /// recur or are too many? That is so only where contact follows the
    /// bodies, and other pairs are next.
    bool
    lacks_set() const
    {
      return no_set;
    }

    /// Did the last solve() end with a violation of friction that is larger
    /// than its accuracy?
    bool
    violates_friction() const
    {
      return is_loose;
    }

    /// Go on with the preconditioner of @p other, of other pairs. Its system
    /// must have changed with the pairs alone, and little besides.
    void
    take_preconditioner(const ContactStep &other);

    /// The step ends with @p x, the solution of the last solve() for @p load:
    /// slip counts from here on. Collective.
    void
    accept(const SceneLoad &load, const SystemVector &x);

    /// Let the next solve() begin with the contact of the last accept(), not of
    /// the last solve().
    void
    go_back();

    /// Continue from @p x, an earlier solution for @p load, with the contact
    /// of the constructor. Collective.
    void
    resume(const SceneLoad &load, const SystemVector &x);

    /// Continue within a step with other pairs, with @p x for @p load,
    /// that of @p data, from @p accepted, the contact of the last step, if there is one, in which the
    /// pairs were those of @p origin. The contact of the constructor is a guess.
    /// Collective.
    void
    follow(const std::optional<ContactRecords> &accepted,
           const SlipOrigin                    &origin,
           const SceneData                     &data,
           const SceneLoad                     &load,
           const SystemVector                  &x);

    /// The present contact, as of the last step. Collective.
    ContactRecords
    records() const;

    /// The present contact with the iterate @p x for @p load. Collective.
    ContactRecords
    records_of_iterate(const SceneLoad &load, const SystemVector &x) const;

    /// Of the last solve().
    unsigned int
    n_sets() const
    {
      return sets;
    }

    /// Of the last solve(): did the active sets converge?
    bool
    converged() const
    {
      return report.converged || !report.linear.converged;
    }

    /// Of the last solve().
    SolvedContact
    solved() const
    {
      return {set.undecided(),
              statuses(),
              friction.slips(),
              friction.dissipated(),
              friction.dissipated_apart()};
    }

    /// Of the last solve(), of all sets.
    unsigned int
    linear_iterations() const
    {
      return report.linear_iterations;
    }

  private:
    /// Signs are not known any better.
    static constexpr double least_accuracy = 1e-10;

    /// The last solved step.
    struct Solved
    {
      SystemVector            rhs, x;
      std::vector<NodeStatus> statuses;
    };

    /// Extrapolate @p x to @p load from the last steps; returns the first set
    /// of the step, and chooses the nodes that slip.
    std::vector<bool>
    predict(const SceneLoad &load, SystemVector &x);
    /// Choose the set that follows from @p x, and how exactly it is to be
    /// solved; returns the fraction of multipliers that change.
    double
    residual(const SystemVector &x) override;
    void
    linearise(const SystemVector &x) override;
    SolveReport
    solve(SystemVector &x) override;
    SolveReport
    solve_set(unsigned int max_iterations, SystemVector &x);
    SolveReport
    solve_with_friction(SystemVector &x);
    /// Let nodes beside those that begin to slip slip as well, if @p next holds
    /// the bodies then, and count them in @p change.
    void
    extend_slip(const std::vector<bool>     &next,
                const std::vector<Friction> &before,
                const SystemVector          &x,
                const Vector                &weighted_gaps,
                FrictionSet::Change         &change);
    /// Is the next set that opens to be extended?
    void
    learn_extension(const ActiveSet::Change &change, bool cycles);
    /// If @p next, which follows from @p x, leaves rigid motions free, move the
    /// bodies along their loads until gaps close. Throws InputError if none
    /// does.
    void
    catch_bodies(const SystemVector &x, ActiveSet &next);
    /// Throws InputError if all nodes of @p next that would hold the bodies slip,
    /// and the loads do more work on their motion than friction can.
    void
    check_hold(const std::vector<bool> &next);
    /// If the nodes of @p next do not hold the bodies, let some of those that
    /// stuck @p before stick for once more.
    void
    hold_bodies(const std::vector<bool>     &next,
                const std::vector<Friction> &before);
    /// Say once what friction alone holds.
    void
    report_held() const;
    /// Keep the solution for the prediction of the next step.
    void
    remember(Solved now);
    std::vector<NodeStatus>
    statuses() const
    {
      std::vector<NodeStatus> result;
      for (const Friction &law : friction.laws(set.active()))
        result.push_back(law.status);
      return result;
    }
    /// The free rigid motions in words; empty without.
    std::string
    free_motions(const std::vector<Friction> &laws) const;
    std::vector<double>
    pressures(const SystemVector &x) const;
    void
    print(const ActiveSet::Change     &change,
          const std::vector<Friction> &before,
          const FrictionSet::Change   &of_friction) const;
    /// Directions in which nodes hold, along the normal and tangentially.
    std::uint64_t
    n_holding(const std::vector<NodeStatus> &statuses) const;
    /// Update the penalties of preconditioners to the set.
    void
    show();

    const RunContext &run;
    Discretisation   &discretisation;
    LinearSolver     &solver;
    GlobalUnknowns   &unknowns;
    ActiveSet         set;
    FrictionSet       friction;
    NodePositions     positions;
    ContactEdge       edge;
    std::uint64_t     n_contact; ///< nodes of contact

    /// By node: the guess for the first step, and after go_back().
    std::optional<std::vector<ContactRecord>> first;
    std::optional<Solved>                     last; ///< with steps
    SuccessiveSolutions
         increments; ///< from step to step, with the set of the last one
    bool mixed_increment =
      false; ///< did the last two steps have different sets?
    std::unique_ptr<ScaledResidual> scaled; ///< for the product of increments

    SceneLoad   *load = nullptr; ///< of solve()
    NewtonReport report;
    double       asked     = 0.; ///< the last tolerance
    double       tolerance = 0.; ///< of the next linear solve, or the last
    double       reduction =
      0.; ///< of the residual, with friction; 0: to the tolerance
    /// Work of friction at most beside that of the loads, see check_hold().
    std::optional<double> used_strength;
    std::string           lost; ///< what that says against the present set
    unsigned int          sets       = 0;
    unsigned int          iterations = 0; ///< of the last set
    /// Nodes that hold in the penalties of coarse levels.
    std::optional<std::uint64_t> n_shown;
    bool                    shows = false; ///< is the next one to be in these?
    std::vector<NodeStatus> prepared;      ///< of which the solver knows
    bool                    other_pairs = false; ///< has the preconditioner
    /// The most of a set that needed it to be so.
    unsigned int iterations_when_shown = 0;
    bool         cold = true; ///< is the first set of the step a poor guess?
    /// Are sets that open extended to the predicted edge of the contact?
    bool         extends    = false;
    bool         extended   = false; ///< did one open?
    unsigned int overshoots = 0;     ///< sets that closed again
    /// Likewise of slip.
    bool   slip_extends = true, slip_extended = false;
    bool   no_set            = false;
    bool   is_loose          = false; ///< see violates_friction()
    double allowed_violation = 0.;
    double violation         = 0.; ///< of friction by the last set
  };
} // namespace mortise
