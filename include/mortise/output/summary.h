// The summary of a run, `summary.json`, as plain data: what scripts read.
// Members that a run has no value for are absent in the file, not zero.
#pragma once

#include <mortise/base/timers.h>
#include <mpi.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mortise
{
  struct ProgramInfo
  {
    std::string  name = "mortise";
    std::string  version;
    std::string  dealii;
    unsigned int ranks = 1;
    std::string  build_type;
  };

  /// Name, versions and build type of this program on @p n_ranks ranks.
  ProgramInfo
  program_info(unsigned int n_ranks);

  /// The largest value of a field, and where a body has it.
  struct PeakSummary
  {
    double              value = 0.;
    std::vector<double> at; ///< x, y, z
  };

  /// Of the von Mises stress. Cells that meet do not agree on the stress: by
  /// how much tells how good it is.
  struct StressPeakSummary : PeakSummary
  {
    double averaged = 0.; ///< at that place, of the mean of its cells' stresses
    /// The most by which two cells differ there or at a corner of the cells
    /// that have that place, as a von Mises stress; absent where no cells meet.
    std::optional<double> jump;
  };

  struct BodySummary
  {
    std::string                      name;
    std::string                      shape; ///< "hexahedra" or "tetrahedra"
    std::uint64_t                    cells      = 0;
    unsigned int                     degree_min = 0;
    unsigned int                     degree_max = 0;
    std::uint64_t                    dofs       = 0;
    std::string                      material;         ///< the name of its law
    double                           volume = 0.;      ///< of its mesh
    std::optional<double>            mass;             ///< if it has a density
    std::optional<PeakSummary>       displacement_max; ///< absent until solved
    std::optional<StressPeakSummary> von_mises_max;    ///< likewise
    std::optional<PeakSummary> plastic_strain_max; ///< of laws that have one
  };

  struct DofSummary
  {
    std::uint64_t                displacement = 0;
    std::optional<std::uint64_t> pressure;
    std::optional<std::uint64_t> multiplier;
    std::uint64_t                total = 0;
  };

  /// Friction of contact since the beginning of the run.
  struct FrictionSummary
  {
    std::uint64_t       stick = 0, slip = 0; ///< nodes
    std::vector<double> force; ///< tangential part of that of the contact
    double              slip_max          = 0.; ///< a length
    double              dissipated_energy = 0.;
  };

  /// Results of contact at the nodes of the slave.
  struct ContactSummary
  {
    double              area = 0.;     ///< in contact
    std::vector<double> force, moment; ///< on the slave; as those of interfaces
    double              pressure_mean = 0.; ///< over that area, positive
    double              pressure_max  = 0.;
    double              gap_min       = 0.; ///< of all nodes
    double        penetration_max     = 0.; ///< at quadrature points, a length
    double        motion_max = 0.; ///< of one side against the other, a length
    std::uint64_t active = 0, inactive = 0;
    std::uint64_t undecided = 0; ///< among these: neither pressure nor gap
    std::optional<FrictionSummary> friction;
  };

  /// Results of a tie with a given force, in consistent units.
  struct PreloadSummary
  {
    double force      = 0.; ///< normal, positive in tension
    double shortening = 0.; ///< by how much the sides approach
  };

  /// Of the cell that periodic ties repeat: components xx, yy, zz, yz, zx, xy
  /// of the mean strain, shears halves of the angle, and of the mean stress,
  /// force per area.
  struct PeriodicCellSummary
  {
    double              volume = 0.;
    std::vector<double> mean_strain, mean_stress;
  };

  struct InterfaceSummary
  {
    std::string   name;
    std::uint64_t slave_faces       = 0;
    std::uint64_t master_faces      = 0;
    std::uint64_t candidate_pairs   = 0;
    std::uint64_t pairs             = 0;
    std::uint64_t integration_cells = 0;
    std::uint64_t quadrature_points = 0;
    double        slave_area        = 0.;
    double        covered_area      = 0.;
    /// Resultants from the slave on the master, the moment about Output/Moments
    /// about; empty until solved.
    std::vector<double> force, moment;
    /// Between the meshes along the slave's normal, over the covered area, see
    /// InterfaceReport; lengths.
    double gap_mean = 0., distance_mean = 0., distance_max = 0.,
           sagitta_mean = 0.;
    std::optional<double>         worst_face_coverage_error;
    std::optional<double>         partition_of_unity_error;
    std::optional<double>         force_residual;
    std::optional<double>         moment_residual;
    std::optional<double>         linear_completeness_error;
    std::optional<ContactSummary> contact; ///< with that law
    std::optional<PreloadSummary> preload; ///< if it has one
  };

  /// The motion of a rigid part.
  struct RigidPartSummary
  {
    std::string         name;
    std::vector<double> point;        ///< of reference
    std::vector<double> displacement; ///< of the point, a length
    std::vector<double> rotation;     ///< about it, degrees
  };

  /// Forces on all bodies together.
  struct EquilibriumSummary
  {
    std::vector<double> applied;   ///< loads
    std::vector<double> reactions; ///< of supports
    std::vector<double> sum; ///< of both, zero but for the solver's tolerance
  };

  struct SolverSummary
  {
    std::string method; ///< "saddle point", "condensed", "direct"
    std::optional<std::string>   preconditioner;
    std::optional<std::uint64_t> iterations;
    double                       relative_residual = 0.;
    std::optional<std::uint64_t> active_sets;       ///< with contact
    std::optional<std::uint64_t> newton_iterations; ///< of nonlinear materials
    std::optional<std::uint64_t> linear_iterations; ///< of all of these
  };

  /// Relative errors against the exact solution.
  struct ErrorSummary
  {
    std::optional<double> displacement_l2;
    std::optional<double> energy;
    std::optional<double> multiplier_l2;
    std::optional<double> displacement_h1;
    std::optional<double> pressure_l2; ///< with bodies in mixed form
  };

  /// Relative errors in the energy norm, or of a quantity.
  struct AdaptivitySummary
  {
    std::optional<std::string> quantity; ///< "tip, z"; absent: energy norm
    std::optional<double>      value;    ///< of the quantity
    double                     target = 0.;
    std::optional<double>      estimate; ///< absent in the first cycle
    /// Parts of the estimate from cells and from interfaces, whose squares add
    /// up; absent with a quantity.
    std::optional<double> estimate_bulk, estimate_interface;
    std::optional<double>
      correction; ///< what is to be added to it, as far as the sign is known
    std::optional<double>
      effectivity; ///< over the error, with an exact solution
  };

  struct StepSummary
  {
    unsigned int step  = 0; ///< from 1 on, or 0 in a scene without steps
    unsigned int cycle = 0;
    std::optional<double>              time; ///< in a scene with steps
    std::vector<BodySummary>           bodies;
    DofSummary                         dofs;
    std::vector<InterfaceSummary>      interfaces;
    std::vector<RigidPartSummary>      rigid_parts;
    std::optional<SolverSummary>       solver;        ///< absent until solved
    std::optional<EquilibriumSummary>  equilibrium;   ///< absent until solved
    std::optional<PeriodicCellSummary> periodic_cell; ///< if there is one
    std::optional<ErrorSummary> errors; ///< absent without an exact solution
    std::optional<AdaptivitySummary> adaptivity; ///< with a target
    /// User-requested functionals in the order of the request: point values,
    /// resultants.
    std::vector<std::pair<std::string, std::vector<double>>> quantities;
  };

  /// How evenly the ranks share an interface.
  struct BalanceSummary
  {
    std::string   interface;
    std::uint64_t largest = 0;  ///< integration cells of the busiest rank
    double        mean    = 0.; ///< over all ranks
  };

  struct Summary
  {
    ProgramInfo program;
    std::string title;
    std::string status; ///< "done", "not converged", ...
    std::string file;   ///< the parameter file
    /// What it and --set set: paths ("Body inner/Degree") and values.
    std::vector<std::pair<std::string, std::string>> parameters;
    std::vector<std::string>                         warnings;
    std::vector<StepSummary>                         steps;
    std::vector<std::pair<std::string, double>>
                                timings; ///< Timers::walls(), seconds
    PeakMemory                  memory;
    std::vector<BalanceSummary> balance; ///< written with several ranks
  };

  /// The text of summary.json. Numbers are written with the digits that read
  /// back to the same double (17 at most); one that is not finite is written as
  /// null.
  std::string
  to_json(const Summary &summary);

  /// The entries of "steps" in it, on one line.
  std::string
  steps_to_json(const std::vector<StepSummary> &steps);

  /// The inverse of steps_to_json(). Throws std::out_of_range or an exception
  /// of nlohmann::json for other input.
  std::vector<StepSummary>
  steps_from_json(const std::string &text);

  /// Write @p directory /summary.json as write_whole_file() does. Collective.
  void
  write_summary(const Summary     &summary,
                const std::string &directory,
                MPI_Comm           comm);
} // namespace mortise
