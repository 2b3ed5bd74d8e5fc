// The composition root: one run of a scene, from parameters to results. Its
// members stand in the order of the data flow. It never computes anything
// itself.
#pragma once

#include <mortise/base/field_checks.h>
#include <mortise/base/run_log.h>
#include <mortise/base/timers.h>
#include <mortise/material/exact_solution.h>
#include <mortise/mortar/coupling.h>
#include <mortise/operators/scene_system.h>
#include <mortise/output/errors.h>
#include <mortise/output/summary.h>
#include <mortise/output/whole_file.h>
#include <mortise/problem/parameters.h>
#include <mortise/problem/rigid_support.h>
#include <mortise/solvers/solve.h>
#include <mortise/solvers/solve_report.h>

#include <memory>
#include <vector>

namespace mortise
{
  class Simulation
  {
  public:
    Simulation(const Parameters &parameters, RunLog &log, MPI_Comm comm);

    /// Open the meshes and check what depends on them; builds no spaces.
    /// Collective; throws InputError.
    void
    create_meshes();

    /// Everything up to errors and functionals; writes nothing. Collective;
    /// throws InputError.
    void
    compute();

    /// The whole run. Collective; throws InputError before anything is written,
    /// or after all that can be written has been if something could not be, and
    /// ConvergenceError after what was reached has been written.
    void
    run();

    /// Valid after compute().
    const Summary &
    result() const
    {
      return summary;
    }

  private:
    void
    create_spaces();
    /// Choose the method, and the nodal spaces if it works without a matrix.
    void
    choose_method(unsigned int max_degree);
    void
    find_pairs();
    void
    couple();
    Coupling
    make_coupling(const InterfaceParameters &given) const;
    void
    integrate(Coupling &coupling) const;
    /// The multipliers, with slave and master exchanged where other interfaces
    /// and prescribed displacements leave too few to hold the bodies together.
    /// Throws InputError where a body can move.
    void
    choose_multipliers();
    void
    number_multipliers();
    std::vector<TieSupport>
    tie_supports() const;
    /// Throws InputError where constant tractions do not pass interface @p i, though its master
    /// could follow. @p states: of its slave faces.
    void
    check_constants(unsigned int i, const std::vector<PartnerState> &states);
    void
    assemble();
    /// Which constants of the pressure nothing determines; throws InputError
    /// where prescribed displacements change the volume of an incompressible
    /// body.
    void
    find_free_pressures();
    void
    solve();
    /// Throws InputError where multipliers depend on each other.
    void
    check_multipliers();
    void
    postprocess();
    /// Write what was asked for; what could not be written.
    std::vector<OutputError>
    write_fields();
    std::vector<OutputError>
    write_results();
    void
    summarise_interface(unsigned int i);
    void
    print_table();

    /// Owned displacement dofs of body @p b that are prescribed or among @p taken, those of the scene.
    std::vector<bool>
    blocked_dofs(unsigned int b, const std::vector<bool> &taken) const;

    const Parameters                &parameters;
    RunLog                          &log;
    const MPI_Comm                   comm;
    Timers                           timers;
    Summary                          summary;
    std::vector<InterfaceParameters> interfaces; ///< sides as they are solved

    FieldChecks                          field_checks; ///< of what is given
    std::shared_ptr<const ExactSolution> exact;
    Bodies                               bodies;
    std::vector<std::vector<DirichletCondition>>   dirichlet;
    std::vector<dealii::AffineConstraints<double>> body_constraints;
    SceneField                                     displacement_field;
    SceneField                                     pressure_field;
    SolverChoice choice{SolverMethod::automatic, ""};
    NodalSpaces  nodal_spaces; ///< for a bulk without a matrix, until assembly
    std::unique_ptr<NodalSpace> nodal_pressures; ///< likewise, in mixed form
    std::vector<Coupling>       couplings;
    BlockSystem                 system;
    std::vector<CondensedInteriors> interiors; ///< by body
    SystemSolution                  solution;
    SolveReport                     solve_report;
    std::vector<BodySolution>       solutions; ///< by body
    std::vector<std::vector<std::vector<double>>>
      tractions; ///< by interface and face
  };
} // namespace mortise
