// The error of the solution of one cycle: from its residuals, or of a quantity
// from how much the last refinement has changed the solution and that of the
// dual problem. It knows no parameters.
#pragma once

#include <mortise/adapt/error_estimate.h>
#include <mortise/solvers/solve_report.h>

#include <optional>
#include <vector>

namespace mortise
{
  /// The quantity and its dual solution in one cycle.
  struct DualSolution
  {
    double value = 0.;
    double size  = 0.; ///< of all components of the quantity
    /// By body; less the function that the quantity is the energy product with,
    /// see LinearFunctional.
    std::vector<BodySolution> solutions;
    SolveReport               report;
  };

  /// Data of earlier cycles for estimates, except those of cells.
  struct EstimateMemory
  {
    unsigned int n_cycles    = 0;  ///< that were added
    unsigned int n_estimates = 0;  ///< since there was a new mesh
    double       value       = 0.; ///< of the quantity
    /// Change of the quantity by the last refinement without the contributions
    /// of cells, since prescribed values, loads and ties depend on the mesh;
    /// and the error that is left of it.
    double change_of_rest = 0., error_of_rest = 0.;
    /// Error allowed to all cells together per unit of the target: the square
    /// of an energy norm, or a quantity itself.
    double allowed_error = 0.;
    /// Of the quantity beside its value, or in the energy norm beside that of
    /// the solution; absent in the first cycle and on a new mesh.
    std::optional<double> estimate;
    /// The estimate times a factor for its uncertainty, which the target is
    /// compared with.
    std::optional<double> upper_estimate;
    /// By body, square, of the equations.
    std::vector<double> residual;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &n_cycles &n_estimates &value &change_of_rest &error_of_rest
        &allowed_error &estimate &upper_estimate &residual;
    }
  };

  class CycleErrors
  {
  public:
    /// @p accuracy: of linear solves, relative.
    CycleErrors(const double accuracy, const MPI_Comm comm)
      : accuracy(accuracy)
      , comm(comm)
    {}

    /// The solution of the cycle before in the spaces that @p bodies have now,
    /// if these go on from its spaces (@p go_on), and that of its
    /// dual problem; else empty. Collective.
    const std::vector<BodySolution> &
    start(const Bodies &bodies, bool go_on);
    const std::vector<BodySolution> &
    dual_start(const Bodies &bodies, bool go_on);

    /// The next cycle has been solved on @p bodies, which still have its spaces; @p dual: of a
    /// quantity; @p broken, by interface: without one. Collective.
    void
    add(const Bodies                      &bodies,
        const std::vector<BodySolution>   &solutions,
        const std::optional<DualSolution> &dual,
        std::vector<InterfaceResidual>     broken,
        const Residuals                   &residuals);

    /// The next cycle is the first one of another load step, on cells of which
    /// something is known already or, like at the beginning, nothing.
    void
    begin_step();

    /// Of all interfaces, relative. A solution is at least as far from the
    /// exact one as from those whose sides are not apart; under contact it is
    /// an estimate.
    double
    of_interfaces() const
    {
      double square = 0.;
      for (const InterfaceResidual &of : interface_residuals)
        square += of.size * of.size;
      return std::sqrt(square);
    }

    /// The rest of the estimate.
    double
    of_bulk() const
    {
      return std::sqrt(
        std::max(0.,
                 std::pow(*memory.estimate, 2) - std::pow(of_interfaces(), 2)));
    }

    /// The part of each cell in the error, beside the same as the estimate,
    /// by body and active cell; empty where there is no estimate.
    NumbersByCell
    by_cell() const;

    /// Part of a checkpoint.
    EstimateMemory memory;
    CellStates     cells;

    // of the last cycle; empty after a run was continued
    ErrorSums                      sums;
    std::vector<InterfaceResidual> interface_residuals; ///< with relative sizes
    std::optional<double>
      correction; ///< what the quantity lacks, with its sign
    /// Is the quantity rounding beside its other components?
    bool quantity_is_zero = false;

  private:
    /// Relative, and in cells that have slave faces.
    void
    set_interface_residuals(double norm);
    /// From @p residuals, or of a quantity from what the last refinement changed, beside @p norm. Collective.
    void
    estimate(const Bodies                      &bodies,
             const std::vector<BodySolution>   &solutions,
             const std::optional<DualSolution> &dual,
             const Residuals                   &residuals,
             double                             norm);
    void
    forget_estimate();
    /// Histories from the change that the refinement before this cycle made;
    /// its squares in the energy norm. Collective.
    NumbersByCell
    update_history(const Bodies                      &bodies,
                   const std::vector<BodySolution>   &solutions,
                   const std::optional<DualSolution> &dual);

    const double              accuracy;
    const MPI_Comm            comm;
    bool                      of_quantity = false;
    std::vector<BodySolution> earlier, earlier_dual;
  };
} // namespace mortise
