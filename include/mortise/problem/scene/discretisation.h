// The linear system of a scene on given meshes: spaces, interfaces and
// operators, independent of loads.
#pragma once

#include <mortise/mortar/interface_points.h>
#include <mortise/output/checkpoint.h>
#include <mortise/problem/scene/pairing.h>
#include <mortise/problem/scene/scene_spaces.h>
#include <mortise/solvers/find_free_pressures.h>

#include <numeric>
#include <ostream>
#include <string>
#include <vector>

namespace mortise
{
  class Discretisation
  {
  public:
    /// @p run and @p bodies, which get their spaces, must live on. @p data: at any time.
    /// Collective; throws InputError.
    Discretisation(const RunContext &run,
                   const SceneData  &data,
                   Bodies           &bodies,
                   const CyclePlan  &cycle = {});

    /// The right hand side at the time of @p data. Collective; throws
    /// InputError if prescribed displacements change the volume of an
    /// incompressible body.
    SceneLoad
    load(const SceneData &data) const;

    /// The sum of @p functionals on cells of @p body as a right hand side
    /// without prescribed values. Collective.
    SceneLoad
    load(const Body &body, const CellFunctionals &functionals) const;

    /// Set the @p active multipliers, by owned one; others are zero.
    /// LinearSolver::update_active() must follow, or update_directions() if
    /// there were other directions. Collective.
    void
    select(const std::vector<bool> &active)
    {
      system.active = active;
      system.directions.reset();
    }

    /// Set the @p active ones of the multipliers in other directions, see
    /// MultiplierDirections. @p turn: Q; @p inverse: Q^{-T}; @p turn_of_forces:
    /// Q', or absent; @p compliance: diagonal of S by owned multiplier, added to that of
    /// springs. LinearSolver::update_directions() must follow. Collective.
    void
    select(const std::vector<bool>    &active,
           SparseMatrix              &&turn,
           SparseMatrix              &&inverse,
           std::optional<SparseMatrix> turn_of_forces,
           const std::vector<double>  &compliance);

    /// Update the penalties of coarse levels to the @p statuses of the nodes of
    /// contact. LinearSolver::update() must follow. Collective.
    void
    update_penalties(const std::vector<NodeStatus> &statuses);

    /// See BulkSystem::linearise(). LinearSolver::update() must follow if
    /// preconditioners are to change. Collective.
    void
    linearise(const SystemVector &x,
              const SystemVector *previous,
              const PointHistory &before,
              const SceneLoad    &load,
              const bool          preconditioners)
    {
      system.bulk->linearise(x,
                             previous,
                             before,
                             load.thermal_strains_at_points,
                             load.follower_pressures.get(),
                             preconditioners);
    }

    /// Add the stiffness of the forces of @p multiplier on interfaces that
    /// follow the bodies to the tangent, see force_stiffness(). Collective.
    void
    add_force_stiffness(const Vector &multiplier);

    /// See BulkSystem::show_tangent(). LinearSolver::update() must follow.
    void
    show_tangent(const bool initial_stress)
    {
      system.bulk->show_tangent(initial_stress);
    }

    /// Where conjugate gradients have stopped at a tangent: it is taken as
    /// indefinite from now on. False if it was, or the law is linear, so that
    /// another solve does not help.
    bool
    try_as_indefinite()
    {
      if (!system.bulk->is_nonlinear() || system.mixed() ||
          !system.suits_conjugate_gradients())
        return false;
      system.bulk->note_negative_direction();
      return true;
    }

    /// By owned multiplier: the weighted gap of @p x, a volume; tangential
    /// components are negative slips. @p load: of the same time. Collective.
    Vector
    weighted_gaps(const SceneLoad &load, const SystemVector &x) const;

    /// By owned node of contact along its kinematic normal, a length, from
    /// weighted_gaps().
    std::vector<double>
    gaps(const Vector &weighted) const;

    /// Motion @p k of @p free as unknowns, exact at vertices and linear between
    /// them. Collective.
    SystemVector
    rigid_motion(const FreeMotions &free, unsigned int k) const;

    /// The solution by body. Collective.
    std::vector<BodySolution>
    solutions(const SceneLoad &load, const SystemVector &solution) const;

    /// The traces of @p solutions, of the time of @p load.
    TraceDisplacement
    trace_displacement(const SceneLoad                 &load,
                       const std::vector<BodySolution> &solutions) const;

    /// @p solutions, by body, as unknowns of the time of @p load, multipliers zero. Collective.
    SystemVector
    system_vector(const std::vector<BodySolution> &solutions,
                  const SceneLoad                 &load) const;

    /// The unknowns of @p values, of the time of @p load. Collective.
    SystemVector
    system_vector(const SceneValues &values, const SceneLoad &load) const;

    /// Throws InputError where multipliers depend on each other. Collective.
    void
    check_multipliers() const;

    /// The part of the summary that is the same in all steps: bodies, unknowns,
    /// interfaces.
    StepSummary
    summary() const;

    /// Of all bodies.
    double
    volume() const
    {
      return std::accumulate(volumes.begin(), volumes.end(), 0.);
    }

    /// Constant pressures of incompressible bodies in the kernel, with the
    /// multipliers that balance them.
    std::vector<SystemVector>
    free_states() const;

    const Bodies &
    bodies() const
    {
      return spaces.bodies;
    }

    /// Prescribed displacements by body.
    const std::vector<std::vector<DirichletCondition>> &
    dirichlet() const
    {
      return spaces.dirichlet;
    }

    const SolverChoice &
    choice() const
    {
      return spaces.choice;
    }

    const Pairing &
    interfaces() const
    {
      return *pairing;
    }

    const BlockSystem &
    linear_system() const
    {
      return system;
    }

    /// The displacements that @p field prescribes on @p part, others zero; the
    /// same at nodes. Collective.
    PrescribedValues
    lift(const RigidPart &part, const AffineField &field) const;
    Vector
    at_nodes(const PrescribedValues &prescribed) const;

    /// Replace the pairing by that of the configuration displaced by the
    /// solutions @p displaced, by body, where interfaces follow the bodies, with
    /// partners within @p least_search at least; the bulk is kept. Their gaps are then linear in displacements about that
    /// configuration. LinearSolver::update_interfaces() and set_gaps() must
    /// follow. Says nothing in the log. Collective; throws InputError as
    /// Pairing.
    void
    pair(const std::vector<BodySolution> &displaced, double least_search = 0.);

    /// Of pair(), the displacement at nodes; empty before.
    const Vector &
    displacement_of_pairing() const
    {
      return paired_at;
    }

    /// Set the gaps of the right hand side of @p load, that of @p data, to
    /// those of the present pairing. Collective.
    void
    set_gaps(const SceneData &data, SceneLoad &load) const;

  private:
    /// A constant pressure of enclosed incompressible bodies.
    struct FreePressure
    {
      Enclosure   enclosure;
      std::string bodies; ///< names
    };

    void
    set_pairing(std::unique_ptr<Pairing> pairing);
    void
    create_bulk();
    /// Let the right hand side of @p load be that of the solution without its
    /// prescribed displacements, but for gaps with nonlinear laws.
    void
    lift(SceneLoad &load) const;
    /// Add offsets and the gaps of meshes.
    void
    add_gaps(const SceneData &data, SceneLoad &load) const;
    void
    find_free_pressures();
    /// Add the weighted gaps of contact without displacements to @p rhs, whose
    /// multipliers they belong to. Collective.
    void
    add_mesh_gaps(Vector &rhs) const;
    /// Prescribed displacements in the numbering of the scene, others zero.
    Vector
    prescribed_vector(const SceneLoad &load) const;

    const RunContext             &run;
    std::ostream                  nowhere{nullptr};
    RunLog                        silent;
    const RunContext              quiet; ///< of pairings that are made again
    SceneSpaces                   spaces;
    std::unique_ptr<Pairing>      pairing;
    Vector                        paired_at; ///< at nodes; empty: undeformed
    BlockSystem                   system;
    std::vector<FreePressure>     free_pressures;
    std::vector<double>           volumes; ///< by body
    std::vector<InterfaceSummary> interface_summaries;
  };
} // namespace mortise
