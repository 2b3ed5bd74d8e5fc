// The matrix-free operator of all bodies with values at nodes: multigrid
// levels, products with the stiffness, loads, and the transfer to hierarchical
// coefficients.
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/operators/cell_functional.h>
#include <mortise/operators/cells/cell_histories.h>
#include <mortise/operators/levels/dirichlet_cell_pressures.h>
#include <mortise/operators/levels/independent_displacements.h>
#include <mortise/operators/levels/nodal_pressure.h>
#include <mortise/operators/prescribed_values.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mortise
{
  class FollowerPressures;
  struct Loads;
  using ThermalStrain = std::function<double(const dealii::Point<dim> &)>;
  struct SceneLoad;
  struct SystemVector;

  class BulkSystem
  {
  public:
    /// Arguments of the constructor, not kept.
    struct Scene
    {
      const FieldNumbering                    &numbering;
      const dealii::AffineConstraints<double> &constraints; ///< of the scene
      bool preconditioned = true; ///< by multigrid with penalties of interfaces
      /// Is something nonlinear besides the laws of bodies?
      bool nonlinear = false;
    };

    /// @p pressures may be null. Collective; throws InputError for tangled cells.
    BulkSystem(const NodalSpaces                &spaces,
               std::shared_ptr<const NodalSpace> pressures,
               const Scene                      &scene,
               MPI_Comm                          comm);
    ~BulkSystem();

    /// Replace the interfaces by @p couplings, whose traces have the nodes of
    /// the levels, and update independent_displacements() and the penalties.
    /// Collective.
    void
    couple(const std::vector<Coupling> &couplings);

    /// Update the penalties of coarse levels to the active set, see
    /// LocalCoupling::active_fraction. Collective.
    void
    update_penalties(const std::vector<Coupling> &couplings);

    /// The finest first.
    const std::vector<MultigridLevel> &
    levels() const
    {
      return all_levels;
    }

    /// Vectors of displacements and pressures on the layouts of the finest
    /// level. Unless stated otherwise they are zero at constrained components
    /// and hanging nodes.
    void
    initialize(Vector &displacement) const
    {
      stiffness->initialize(displacement);
    }
    void
    initialize_pressure(Vector &pressure) const
    {
      pressures->initialize(pressure);
    }

    /// dst = K src. Collective.
    void
    apply_stiffness(Vector &dst, const Vector &src) const
    {
      stiffness->vmult(dst, src);
      add_following_forces(dst, src);
    }

    /// dst_u = K u + G^T p, dst_p = G u - C p, see BlockSystem. Collective.
    void
    apply_mixed(Vector       &dst_u,
                Vector       &dst_p,
                const Vector &u,
                const Vector &p) const
    {
      apply_free(dst_u, dst_p, u, p);
      stiffness->clear_constrained(dst_u);
    }

    /// dst += G^T p. Collective.
    void
    add_pressure_force(Vector &dst, const Vector &p) const;

    /// dst = P p, see BlockSystem. Collective.
    void
    apply_pressure_norm(Vector &dst, const Vector &p) const;

    /// dst_k = int p q_k times pressure_norm() of the material. Collective.
    void
    apply_pressure_mass(Vector &dst, const Vector &p) const;

    /// Set @p p to 1 at the nodes of @p body that do not hang.
    void
    set_constant_pressure(const Body &body, Vector &p) const;

    /// diag(P), 1 where nodes hang.
    const Vector &
    pressure_norm_diagonal() const
    {
      return norm_diagonal;
    }

    /// diag(K), 1 where constrained.
    const Vector &
    diagonal() const
    {
      return stiffness_diagonal;
    }

    /// diag(K), averaged over the free components of each node.
    Vector
    node_diagonal() const
    {
      Vector mean(stiffness_diagonal);
      stiffness->average_components(mean);
      return mean;
    }

    /// The products of this rank's cells on the finest level.
    const MatrixFreeElasticity<double> &
    elasticity() const
    {
      return stiffness->elasticity();
    }

    /// Null without bodies in mixed form.
    const NodalPressure *
    pressure() const
    {
      return pressures.get();
    }

    const std::vector<IndependentDisplacement> &
    independent_displacements() const
    {
      return independent;
    }

    /// A hierarchical coefficient, by body and dof.
    using Coefficients =
      std::function<double(unsigned int, dealii::types::global_dof_index)>;

    /// The values at nodes, prescribed ones included, of the function with
    /// these coefficients. Collective.
    Vector
    values_at_nodes(const Coefficients &coefficient) const;

    /// Has any body a law that is not linear, or is the scene? K and the
    /// products in mixed form are those of its tangent at the last linearise().
    bool
    is_nonlinear() const;

    /// History of points that nothing happened to.
    PointHistory
    no_history() const
    {
      return stiffness->elasticity().no_history();
    }

    /// @p history by body and cell.
    std::vector<CellHistories>
    by_cell(const PointHistory &history) const;

    /// The inverse of by_cell().
    PointHistory
    by_point(const std::vector<CellHistories> &histories) const;

    /// What bodies do against a displacement.
    struct Response
    {
      /// By node, also at constrained components: internal forces int P : Grad
      /// v with the nominal stress P, and in mixed form what keeps the
      /// dilatation of pressures, see BlockSystem.
      Vector       forces, dilatation;
      PointHistory history; ///< up to here
      /// The least determinant of deformation gradients.
      double        least_jacobian = 1.;
      LeastJacobian least_of_rank; ///< with its cell
    };

    /// To the displacement @p u, values at nodes with those prescribed, and
    /// @p p, which is not read without bodies in mixed form, after @p before,
    /// nothing if it is empty. Collective.
    Response
    respond(const Vector       &u,
            const Vector       &p,
            const PointHistory &before,
            const PointHistory &thermal_strains) const;

    /// The thermal strains of bodies whose law is not linear at their points,
    /// by body; nothing if none has any.
    PointHistory
    thermal_strains(const std::vector<ThermalStrain> &by_body) const;

    /// Has K, diagonal() and what preconditioners are made of as derivatives at
    /// @p x after @p before, as for respond(); the former ones of
    /// preconditioners alone if @p preconditioners is false. Collective.
    /// @p pressures: those whose forces depend on u, or null. @p previous: see
    /// MatrixFreeElasticity::linearise(), or null.
    void
    linearise(const SystemVector      &x,
              const SystemVector      *previous,
              const PointHistory      &before,
              const PointHistory      &thermal_strains,
              const FollowerPressures *pressures,
              bool                     preconditioners);

    /// Let preconditioners see the tangent, without its initial stress if
    /// @p initial_stress is false. Collective.
    void
    show_tangent(bool initial_stress);

    /// May K be symmetric and positive definite? It is not symmetric with
    /// pressures on deformed faces that have a free rim.
    bool
    may_be_positive() const
    {
      return positive;
    }

    /// To be called where K was found to have negative directions; until it is
    /// linearised again.
    void
    note_negative_direction()
    {
      positive = false;
    }

    /// Add the stiffness of the forces of interfaces to K, until the next
    /// linearise(). @p is_symmetric: is that?
    void
    add_to_stiffness(SparseMatrix &&stiffness_of_interfaces,
                     const bool     is_symmetric)
    {
      of_interfaces = std::move(stiffness_of_interfaces);
      positive      = positive && is_symmetric;
    }

    /// What add_to_stiffness() was given; without rows after linearise().
    const SparseMatrix &
    stiffness_of_interfaces() const
    {
      return of_interfaces;
    }

    /// Forces by node, also at constrained components, of @p pressures at @p u,
    /// as for respond(); on @p boundary of body @p body alone, if that is
    /// given. Collective.
    Vector
    forces_of(const FollowerPressures   &pressures,
              const Vector              &u,
              const Body                *body     = nullptr,
              dealii::types::boundary_id boundary = 0) const;

    /// Where the least Jacobian of @p response is, in words. Collective.
    std::string
    place_of_least_jacobian(const Response &response) const;

    /// Set displacements and pressures of @p rhs to K u, zero at constrained
    /// components, and G u, for @p u that need not be zero there; @p forces, if they are
    /// not null, to K u, also at constrained components. Collective.
    void
    apply_to_constrained(const Vector &u,
                         SystemVector &rhs,
                         Vector       *forces = nullptr) const;

    /// int b.v + int t.v - int sigma_0 : grad v by node, also at constrained
    /// components, see for_each_loaded_cell(). @p loads: by body. Collective.
    Vector
    external_forces(const std::vector<Loads> &loads) const;

    /// The @p functionals on cells of @p body by node, also at constrained
    /// components. Collective.
    Vector
    by_node(const Body &body, const CellFunctionals &functionals) const;

    /// Set external forces of @p load, and add them at free components, and the
    /// thermal strains of pressures, to its right hand side. Collective.
    void
    add_loads(const std::vector<Loads> &loads, SceneLoad &load) const;

    /// Add the thermal strains to the right hand side of the pressures.
    void
    add_expansion(const std::vector<Loads> &loads, Vector &pressure_load) const;

    /// Set @p rhs to the sum of @p functionals on cells of @p body, zero at
    /// constrained components. Collective.
    void
    assemble_functional(const Body            &body,
                        const CellFunctionals &functionals,
                        SystemVector          &rhs) const;

    /// The inverse of for_each_coefficient(): values at nodes, zero at
    /// constrained components. Collective.
    void
    set_displacement(const Coefficients &coefficient,
                     Vector             &displacement) const
    {
      displacement = values_at_nodes(coefficient);
      stiffness->clear_constrained(displacement);
    }

    /// The inverse of for_each_pressure_coefficient(); zero at hanging nodes.
    /// Collective.
    void
    set_pressure(const Coefficients &coefficient, Vector &pressure) const;

    /// Calls set(body, dof, value) with the hierarchical coefficient of each
    /// dof of owned cells that is not prescribed. @p displacement: values at
    /// nodes. Collective.
    void
    for_each_coefficient(
      const Vector                            &displacement,
      const std::function<void(unsigned int                    body,
                               dealii::types::global_dof_index dof,
                               double value)> &set) const;

    /// The same for the PressureSpace of bodies in mixed form.
    void
    for_each_pressure_coefficient(
      const Vector                            &pressure,
      const std::function<void(unsigned int                    body,
                               dealii::types::global_dof_index dof,
                               double value)> &set) const;

  private:
    /// Those of pressures on deformed faces and of contact that follows the
    /// bodies, which products with a tangent take.
    bool
    has_following_forces() const
    {
      return follower || of_interfaces.m() > 0;
    }
    /// Nothing without.
    void
    add_following_forces(Vector &dst, const Vector &src) const;
    /// The same with constrained components.
    void
    add_following_forces_free(Vector &dst, const Vector &src) const;
    bool
    follower_is_symmetric() const;
    void
    linearise_undeformed();
    /// [K G^T; G -C] (u, p) with constrained components; @p dst_p and @p p are
    /// not used without bodies in mixed form.
    void
    apply_free(Vector       &dst_u,
               Vector       &dst_p,
               const Vector &u,
               const Vector &p) const;

    const bool                             preconditioned, nonlinear;
    std::vector<MultigridLevel>            all_levels;
    std::unique_ptr<LevelOperator<double>> stiffness;
    Vector                                 stiffness_diagonal;
    std::vector<IndependentDisplacement>   independent;
    std::unique_ptr<NodalPressure>         pressures; ///< in mixed form
    DirichletCellPressures                 dirichlet_cell_pressures;
    Vector                                 norm_diagonal;
    std::unique_ptr<FollowerPressures>     follower;      ///< in K, or null
    SparseMatrix                           of_interfaces; ///< likewise
    bool                                   positive = true;
  };
} // namespace mortise
