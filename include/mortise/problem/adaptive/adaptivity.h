// How accurate a solution is, and which meshes and degrees to take next: from
// how much it has changed, cell by cell, when they were refined.
#pragma once

#include <mortise/adapt/error_by_residual.h>
#include <mortise/adapt/error_estimate.h>
#include <mortise/adapt/remeshing.h>
#include <mortise/output/checkpoint_scene.h>
#include <mortise/problem/adaptive/quantity.h>
#include <mortise/problem/input/run_context.h>
#include <mortise/problem/results/step_results.h>
#include <mortise/problem/scene/scene_spaces.h>

#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  /// Throws InputError where a target goes together with what it cannot.
  void
  check_adaptivity(const Parameters &parameters);

  /// With a target linear solves need no more digits than leave it what it is.
  Parameters
  with_tolerance(Parameters parameters);

  class Adaptivity
  {
  public:
    /// @p run must live on; it has a target.
    explicit Adaptivity(const RunContext &run);

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
    start(const Bodies &bodies);

    /// Likewise, of the dual problem of quantity(). Collective.
    const std::vector<BodySolution> &
    dual_start(const Bodies &bodies);

    /// That were added.
    unsigned int
    n_cycles() const
    {
      return cycle;
    }

    /// That the target is of; nothing: the energy norm.
    const std::optional<Quantity> &
    quantity() const
    {
      return goal;
    }

    /// The next cycle has been solved on @p bodies, which still have its spaces; @p dual: with a
    /// quantity(), @p violations and @p residuals: without. Collective.
    void
    add(const Bodies                          &bodies,
        const std::vector<BodySolution>       &solutions,
        const std::optional<DualSolution>     &dual,
        const std::vector<InterfaceViolation> &violations,
        const Residuals                       &residuals);

    /// Error of the quantity beside its value, or in the energy norm beside
    /// that of the solution; nothing in the first cycle and on a new mesh.
    const std::optional<double> &
    estimate() const
    {
      return estimated;
    }

    /// The part of each cell in the error, beside the same as estimate(),
    /// by body and active cell; empty where estimate() is nothing.
    std::vector<std::vector<double>>
    cell_estimates() const;

    /// The last cycle; @p exact may be null, @p errors are those of the whole solution. Collective.
    AdaptivitySummary
    summary(const Bodies                      &bodies,
            const ExactSolution               *exact,
            const std::optional<ErrorSummary> &errors) const;

    /// What a checkpoint needs beside the solution of the last cycle, as bytes;
    /// empty where none is to be written.
    const std::string &
    checkpoint() const
    {
      return kept;
    }

    /// Go on after the cycle of which checkpoint() is @p bytes. Throws InputError if it is of another quantity(),
    /// std::out_of_range if they are no such bytes.
    void
    resume(const std::string &bytes);

    /// After resume(): the meshes of that cycle from those of the first, before
    /// there are spaces. Collective; throws InputError where gmsh cannot, and
    /// if they are other ones.
    void
    restore_meshes(Bodies &bodies);

    /// After both, in the spaces of degrees(): the solution of that cycle.
    /// Collective.
    void
    restore(const Bodies &bodies, const std::vector<BodySolution> &solutions);

    /// Estimate and target, in words.
    std::string
    found() const;

    /// The estimate that meets the target.
    double
    met_at() const
    {
      return least_effectivity * *run.parameters.adaptivity.target_error;
    }

    bool
    reached() const
    {
      return at_most && *at_most <= met_at();
    }

    /// Why there is no next cycle, although the target is not reached, in
    /// words; else empty.
    const std::string &
    limit() const
    {
      return stopped_by;
    }

    /// That the target is not reached, why, and what was.
    std::string
    missed() const;

  private:
    /// Last estimates are at least so much of the error, about
    /// (doc/guide/adaptivity.md).
    static constexpr double least_effectivity = 0.9;

    /// Relative, and in cells that have slave faces.
    void
    set_violations(const std::vector<InterfaceViolation> &violations,
                   double                                 norm);
    /// The error from @p residuals, or of a quantity from what the last refinement changed, beside @p norm. Collective.
    void
    estimate(const Bodies                      &bodies,
             const std::vector<BodySolution>   &solutions,
             const std::optional<DualSolution> &dual,
             const Residuals                   &residuals,
             double                             norm);
    /// Of all interfaces. A solution is at least as far from the exact one as
    /// from those whose sides are not apart; under contact it is an estimate.
    double
    interface_error() const;
    /// What estimate() has beyond it.
    double
    square_of_bulk() const;
    /// That it may be larger, in words.
    std::string
    doubt() const;
    /// Body or interface with most of the error, in words.
    std::string
    worst_part() const;
    /// Histories from the change that the refinement before this cycle made;
    /// its squares by body. Collective.
    std::vector<double>
    learn(const Bodies                      &bodies,
          const std::vector<BodySolution>   &solutions,
          const std::optional<DualSolution> &dual);
    /// The next degrees, splits and meshes, unless the target is reached.
    /// Collective.
    void
    choose(const Bodies &bodies);
    /// Set what checkpoint() gives. Collective.
    void
    keep(const Bodies &bodies);
    /// New meshes for tetrahedra that @p choices split, as small as unknowns allow; false if they allow none. Collective.
    bool
    plan_meshes(const Bodies      &bodies,
                const Refinements &choices,
                double             allowed);
    /// Unknowns of the next cycle, about. Collective.
    double
    next_unknowns(const Bodies &bodies, const Refinements &choices) const;

    const RunContext              &run;
    const std::optional<Quantity>  goal;
    unsigned int                   cycle = 0;
    CellStates                     states;
    std::vector<std::vector<bool>> splits;
    std::vector<Remeshing>         meshes;  ///< by body; empty: none is new
    unsigned int              n_meshes = 0; ///< how often there were new ones
    std::vector<BodySolution> earlier, earlier_dual;
    ErrorSums                 sums;
    std::vector<double>
      residual; ///< by body, square, of the equations in the last cycle
    unsigned int n_estimates = 0;               ///< since there was a new mesh
    std::vector<InterfaceViolation> interfaces; ///< relative
    double                          last_value = 0.; ///< of the quantity
    /// How much the last refinement changed the quantity beyond what cells have
    /// in it, since prescribed values, loads and ties are others on other
    /// meshes, and what is left of that.
    struct
    {
      double change = 0., error = 0.;
    } rest;
    std::optional<double> estimated;
    /// What the errors of cells may be together for each unit of the target:
    /// the square of an energy norm, or of a quantity itself.
    double allowed = 0.;
    /// What it may be, since errors by residuals differ from cell to cell.
    std::optional<double> at_most;
    std::optional<double> signed_error; ///< AdaptivitySummary::correction
    std::string           stopped_by;
    /// By body, those of the mesh; null: the file's.
    std::vector<std::shared_ptr<const SizeField>> sizes;
    std::string                                   kept;
    /// After resume(): by body, the cells of the mesh.
    std::vector<std::vector<std::pair<CellNumber, CellState>>> restored;
  };
} // namespace mortise
