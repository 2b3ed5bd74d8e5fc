// Adaptive cycles of a run with a target error: meshes and degrees of the next
// cycle from the estimates of adapt/.
#pragma once

#include <mortise/adapt/cycle_errors.h>
#include <mortise/adapt/mesh_plan.h>
#include <mortise/output/summary.h>
#include <mortise/problem/adaptive/cycle_checkpoint.h>
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
    /// @p run, which has a target, must live on.
    explicit Adaptivity(const RunContext &run)
      : run(run)
      , goal(given_quantity(run.parameters))
      , of_cycle(run.parameters.solver.tolerance, run.comm)
    {}

    /// Change or remake the meshes of @p bodies as planned by the last add()
    /// or begin_step(), if any; these bodies lose their spaces. Collective;
    /// throws InputError if gmsh fails.
    void
    refine(Bodies &bodies);

    /// Of the next cycle; empty for the first one.
    CellDegrees
    degrees() const;

    /// The last solution in the present spaces of @p bodies, in the first cycle of a step about; empty in the
    /// very first cycle and on a new mesh. Collective.
    const std::vector<BodySolution> &
    start(const Bodies &bodies)
    {
      return of_cycle.start(bodies, goes_on());
    }

    /// The same for the dual problem of quantity(). Collective.
    const std::vector<BodySolution> &
    dual_start(const Bodies &bodies)
    {
      return of_cycle.dual_start(bodies, goes_on());
    }

    /// The next cycle is the first one of another load step: it has the meshes
    /// of the last one, coarser where errors are small. For a quantity, and
    /// where points have histories and cells are only cut, it has the first
    /// ones. To be followed by refine(). Collective.
    void
    begin_step(const Bodies &bodies);

    /// Number of cycles of the load step that were added.
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

    /// The goal functional; nothing: the energy norm.
    const std::optional<Quantity> &
    quantity() const
    {
      return goal;
    }

    /// Add a cycle, see CycleErrors::add(). Collective.
    void
    add(const Bodies                      &bodies,
        const std::vector<BodySolution>   &solutions,
        const std::optional<DualSolution> &dual,
        std::vector<InterfaceResidual>     interface_residuals,
        const Residuals                   &residuals);

    /// Of the last cycle.
    const CycleErrors &
    errors() const
    {
      return of_cycle;
    }

    /// The largest estimate that meets the target.
    double
    met_at() const
    {
      return least_effectivity * target();
    }

    bool
    reached() const
    {
      const auto &upper_estimate = of_cycle.memory.upper_estimate;
      return upper_estimate && *upper_estimate <= met_at();
    }

    /// The limit that prevents the next cycle before the target is reached, in
    /// words; else empty.
    std::string
    limit() const;

    /// Data of a checkpoint beside the last solution; empty without
    /// checkpoints.
    const CycleCheckpoint &
    checkpoint() const
    {
      return kept;
    }

    /// Continue after the cycle whose checkpoint() is @p given. Throws
    /// InputError for another quantity(), std::out_of_range for impossible
    /// data.
    void
    resume(CycleCheckpoint given);

    /// After resume(), before there are spaces: make the meshes of that cycle
    /// from the first ones. Collective; throws InputError if gmsh fails or
    /// makes other meshes.
    void
    restore_meshes(Bodies &bodies);

    /// After both, in the spaces of degrees(): set the solution of that cycle.
    /// Collective.
    void
    restore(const Bodies &bodies, const std::vector<BodySolution> &solutions);

  private:
    /// Lower bound of the effectivity of final estimates
    /// (doc/guide/adaptivity.md).
    static constexpr double least_effectivity = 0.9;

    /// Do the spaces of the next cycle go on from those of the last one?
    bool
    goes_on() const
    {
      return !of_cycle.cells.empty() && next.meshes.empty();
    }

    /// Of all cells together, in squares for the energy norm.
    double
    allowed_error() const;
    /// Plan degrees, splits and meshes unless the target is reached.
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
    unsigned int                  n_meshes = 0;     ///< number of remeshings
    bool begins_anew                       = false; ///< with the first meshes
    /// By body, sizes of the mesh; null: those of the file.
    std::vector<std::shared_ptr<const SizeField>> sizes;
    CycleCheckpoint                               kept;
  };

  /// Summary of the last cycle. @p exact may be null; @p errors: of the whole
  /// solution. Collective.
  AdaptivitySummary
  summary_of(const Adaptivity                  &adaptivity,
             const Bodies                      &bodies,
             const ExactSolution               *exact,
             const std::optional<ErrorSummary> &errors);

  /// Estimate and target, in words.
  std::string
  found(const Adaptivity &adaptivity, const Bodies &bodies);

  /// The message that the target is not reached, with reason and estimate.
  std::string
  missed(const Adaptivity &adaptivity);
} // namespace mortise
