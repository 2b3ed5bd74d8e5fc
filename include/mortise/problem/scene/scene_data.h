// The parameters of a scene as functions at one time: exact solution, loads,
// prescribed displacements.
#pragma once

#include <mortise/base/field_checks.h>
#include <mortise/body/boundary_conditions.h>
#include <mortise/contact/friction.h>
#include <mortise/material/exact_solution.h>
#include <mortise/operators/scene_system.h>
#include <mortise/problem/input/parameters.h>
#include <mortise/problem/support/rigid_part.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace mortise
{
  /// Material of each body.
  std::vector<Material>
  materials(const Parameters &parameters);

  /// Has any body a law of finite strain, so that rigid ones may turn far?
  bool
  have_finite_strain(const Parameters &parameters);

  /// Are there loads, prescribed displacements, offsets or temperatures at any
  /// time? Penetration of meshes does not count.
  bool
  anything_acts(const Parameters &parameters);

  /// Does contact count the gaps between meshes?
  bool
  have_real_gaps(const Parameters &parameters);

  /// Loads, offsets and prescribed displacements at one time. References of the
  /// constructor must live on; @p checks notes values that are not finite.
  class SceneData
  {
  public:
    /// Throws InputError if the bodies do not fit a named exact solution.
    SceneData(const Parameters &parameters, double time, FieldChecks &checks);

    double
    at_time() const
    {
      return time;
    }

    /// The exact solution of the parameters; null without. Named ones take
    /// radii, pressures, materials and rigid motion from the bodies.
    const std::shared_ptr<const ExactSolution> &
    exact() const
    {
      return solution;
    }

    /// Body force and tractions of @p body.
    Loads
    loads(const Body &body) const;

    /// The thermal strain of @p body; null without.
    std::function<double(const dealii::Point<dim> &)>
    thermal_strain(const BodyParameters &body) const;

    /// The offset of @p interface; null if it is zero at all times.
    std::function<double(const dealii::Point<dim> &)>
    offset(const InterfaceParameters &interface) const;

    /// The force of the Preload of @p interface; nothing once its shortening is
    /// kept.
    std::optional<double>
    preload(const InterfaceParameters &interface) const;

    /// A component of the Mean strain, see unit_strain(); nothing if it is
    /// free.
    std::optional<double>
    mean_strain(unsigned int component) const;

    /// The Mean stress.
    double
    mean_stress(unsigned int component) const;

    /// The bound of tangential tractions of @p interface, which has friction.
    /// Throws InputError where a coefficient is negative.
    std::function<FrictionBound(const dealii::Point<dim> &)>
    friction(const InterfaceParameters &interface) const;

    /// Prescribed displacements of @p body; a condition without a value is zero at all times.
    std::vector<DirichletCondition>
    dirichlet(const Body &body) const;

    /// The rigid parts of @p bodies. Collective; throws InputError for displacements
    /// that are no rigid motion.
    std::vector<RigidPart>
    rigid_parts(const Bodies &bodies) const;

  private:
    /// That of @p boundary, which is @p id of @p body. Collective.
    static dealii::Point<dim>
    reference_point(const Body                &body,
                    const BoundaryParameters  &boundary,
                    dealii::types::boundary_id id);

    /// The components @p texts at @p path, not a number where they are free or
    /// not given, without the factor of all that acts.
    std::vector<double>
    given_components(const std::optional<Components> &texts,
                     const std::string               &path) const;

    /// The force, moment or rotation @p texts at @p path; zero if it is not
    /// given.
    dealii::Tensor<1, dim>
    total(const std::optional<Components> &texts,
          const std::string               &path) const;

    /// Of @p body. Collective.
    std::vector<RigidPart>
    rigid_parts_without_motions(const Body &body) const;

    /// Set the free and the given motion of @p part of @p body. Collective; throws
    /// InputError.
    void
    set_motion(const Body                            &body,
               const std::vector<DirichletCondition> &dirichlet,
               RigidPart                             &part) const;

    /// The displacement of @p boundary, which is @p id of @p body and the section @p where, by its Rotation; null if
    /// that is zero at all times.
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>
    rotation(const Body                &body,
             const BoundaryParameters  &boundary,
             dealii::types::boundary_id id,
             const std::string         &where) const;

    /// The pressure @p text on boundary @p id joins @p loads.
    void
    add_pressure(dealii::types::boundary_id id,
                 const std::string         &text,
                 const std::string         &where,
                 bool                       follows,
                 Loads                     &loads) const;

    const Parameters                    &parameters;
    const double                         factor; ///< of all that acts
    const double                         time;
    FieldChecks                         &checks;
    std::shared_ptr<const ExactSolution> solution;
  };
} // namespace mortise
