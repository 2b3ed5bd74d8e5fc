// The cycles of a run with a target: which meshes and degrees come next, from
// what adapt/ has for the error.
#pragma once

#include <mortise/adapt/cycle_errors.h>
#include <mortise/adapt/mesh_plan.h>
#include <mortise/output/summary.h>
#include <mortise/problem/adaptive/kept_cycles.h>
#include <mortise/problem/input/quantity.h>
#include <mortise/problem/input/run_context.h>
#include <mortise/problem/scene/scene_spaces.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  class Adaptivity
  {
  public:
    /// @p run must live on; it has a target.
    explicit Adaptivity(const RunContext &run)
      : run(run)
      , goal(given_quantity(run.parameters))
      , of_cycle(run.parameters.solver.tolerance, run.comm)
    {}

    /// Cut the meshes of @p bodies, or make new ones, as chosen by the last add(), if there was one; those bodies lose
    /// their spaces. Collective; throws InputError where gmsh cannot.
    void
    refine(Bodies &bodies);

    /// Of the next cycle; empty for the first one.
    CellDegrees
    degrees() const;

    /// The solution of the cycle before in the spaces that @p bodies have now; empty in
    /// the first cycle and on a new mesh. Collective.
    const std::vector<BodySolution> &
    start(const Bodies &bodies)
    {
      return of_cycle.start(bodies, goes_on());
    }

    /// Likewise, of the dual problem of quantity(). Collective.
    const std::vector<BodySolution> &
    dual_start(const Bodies &bodies)
    {
      return of_cycle.dual_start(bodies, goes_on());
    }

    /// That were added.
    unsigned int
    n_cycles() const
    {
      return of_cycle.memory.n_cycles;
    }

    double
    target() const
    {
      return *run.parameters.adaptivity.target_error;
    }

    /// That the target is of; nothing: the energy norm.
    const std::optional<Quantity> &
    quantity() const
    {
      return goal;
    }

    /// The next cycle has been solved, see CycleErrors::add(). Collective.
    void
    add(const Bodies                      &bodies,
        const std::vector<BodySolution>   &solutions,
        const std::optional<DualSolution> &dual,
        std::vector<InterfaceViolation>    violations,
        const Residuals                   &residuals);

    /// Of the last cycle.
    const CycleErrors &
    errors() const
    {
      return of_cycle;
    }

    /// The estimate that meets the target.
    double
    met_at() const
    {
      return least_effectivity * target();
    }

    bool
    reached() const
    {
      const auto &at_most = of_cycle.memory.at_most;
      return at_most && *at_most <= met_at();
    }

    /// Why there is no next cycle, although the target is not reached, in
    /// words; else empty.
    std::string
    limit() const;

    /// What a checkpoint needs beside the solution of the last cycle; of a run
    /// that writes none empty.
    const KeptCycles &
    checkpoint() const
    {
      return kept;
    }

    /// Go on after the cycle of which checkpoint() is @p given. Throws InputError if it is of another quantity(),
    /// std::out_of_range if it cannot be.
    void
    resume(KeptCycles given);

    /// After resume(): the meshes of that cycle from those of the first, before
    /// there are spaces. Collective; throws InputError where gmsh cannot, and
    /// if they are other ones.
    void
    restore_meshes(Bodies &bodies);

    /// After both, in the spaces of degrees(): the solution of that cycle.
    /// Collective.
    void
    restore(const Bodies &bodies, const std::vector<BodySolution> &solutions);

  private:
    /// Last estimates are at least so much of the error, about
    /// (doc/guide/adaptivity.md).
    static constexpr double least_effectivity = 0.9;

    /// Do spaces of the next cycle contain those of the last one?
    bool
    goes_on() const
    {
      return n_cycles() > 0 && next.meshes.empty();
    }

    /// The next degrees, splits and meshes, unless the target is reached.
    /// Collective.
    void
    plan(const Bodies &bodies);
    /// Set what checkpoint() gives. Collective.
    void
    keep(const Bodies &bodies);

    const RunContext             &run;
    const std::optional<Quantity> goal;
    CycleErrors                   of_cycle;
    MeshPlan                      next;
    unsigned int n_meshes = 0; ///< how often there were new ones
    /// By body, those of the mesh; null: the file's.
    std::vector<std::shared_ptr<const SizeField>> sizes;
    KeptCycles                                    kept;
  };

  /// The last cycle; @p exact may be null, @p errors are those of the whole solution. Collective.
  AdaptivitySummary
  summary_of(const Adaptivity                  &adaptivity,
             const Bodies                      &bodies,
             const ExactSolution               *exact,
             const std::optional<ErrorSummary> &errors);

  /// Estimate and target, in words.
  std::string
  found(const Adaptivity &adaptivity, const Bodies &bodies);

  /// That the target is not reached, why, and what was.
  std::string
  missed(const Adaptivity &adaptivity);
} // namespace mortise
