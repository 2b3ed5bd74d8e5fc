// The composition root: one run of a scene, from parameters to results. Its
// members stand in the order of the data flow. It never computes anything
// itself.
#pragma once

#include <mortise/base/run_log.h>
#include <mortise/base/timers.h>
#include <mortise/material/exact_solution.h>
#include <mortise/mortar/coupling.h>
#include <mortise/operators/scene_system.h>
#include <mortise/output/errors.h>
#include <mortise/output/summary.h>
#include <mortise/output/whole_file.h>
#include <mortise/problem/parameters.h>
#include <mortise/solvers/solve_report.h>
#include <mortise/solvers/solver_options.h>

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
    void
    number_multipliers();
    void
    assemble();
    /// Which constants of the pressure nothing determines; throws InputError
    /// where prescribed displacements change the volume of an incompressible
    /// body.
    void
    find_free_pressures();
    void
    solve();
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

    /// Displacement dofs of body @p b that are prescribed or belong to an earlier interface.
    std::vector<bool>
    blocked_dofs(unsigned int b) const;
    void
    occupy(unsigned int i);

    const Parameters &parameters;
    RunLog           &log;
    const MPI_Comm    comm;
    Timers            timers;
    Summary           summary;

    std::shared_ptr<const ExactSolution>           exact;
    Bodies                                         bodies;
    std::vector<std::vector<DirichletCondition>>   dirichlet;
    std::vector<dealii::AffineConstraints<double>> body_constraints;
    SceneField                                     displacement_field;
    SceneField                                     pressure_field;
    SolverMethod method = SolverMethod::automatic; ///< chosen
    NodalSpaces  nodal_spaces; ///< for a bulk without a matrix, until assembly
    std::unique_ptr<NodalSpace>    nodal_pressures; ///< likewise, in mixed form
    std::vector<Coupling>          couplings;
    std::vector<std::vector<bool>> occupied; ///< by body, owned dofs
    BlockSystem                    system;
    std::vector<CondensedInteriors> interiors; ///< by body
    SystemSolution                  solution;
    SolveReport                     solve_report;
    std::vector<BodySolution>       solutions; ///< by body
    std::vector<std::vector<std::vector<double>>>
      tractions; ///< by interface and face
  };
} // namespace mortise
