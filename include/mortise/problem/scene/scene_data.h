// What the parameters of a scene mean as functions at one time: exact solution,
// loads, prescribed displacements.
#pragma once

#include <mortise/base/field_checks.h>
#include <mortise/body/boundary_conditions.h>
#include <mortise/material/exact_solution.h>
#include <mortise/operators/scene_system.h>
#include <mortise/problem/input/parameters.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace mortise
{
  /// Material of each body.
  std::vector<Material>
  materials(const Parameters &parameters);

  /// Is there a load or anything else that moves bodies, at any time? The
  /// meshes of contact are no part of it, which may overlap.
  bool
  anything_acts(const Parameters &parameters);

  /// May meshes that overlap press?
  bool
  have_real_gaps(const Parameters &parameters);

  /// What acts on a scene at one time. Both arguments of the constructor must
  /// live on; @p checks is told of values that no run can use.
  class SceneData
  {
  public:
    /// Throws InputError if the bodies are not what a named exact solution is
    /// for.
    SceneData(const Parameters &parameters, double time, FieldChecks &checks);

    /// The exact solution that the parameters name; null if there is none. The
    /// named ones take radii, pressures, materials and the motion of the scene
    /// from the bodies.
    const std::shared_ptr<const ExactSolution> &
    exact() const
    {
      return solution;
    }

    /// Body force and tractions of @p body.
    Loads
    loads(const Body &body) const;

    /// The strain, the same in all directions, that @p body has from its temperature; null without.
    std::function<double(const dealii::Point<dim> &)>
    thermal_strain(const BodyParameters &body) const;

    /// The gap that @p interface leaves between the bodies; null where it is zero at all times.
    std::function<double(const dealii::Point<dim> &)>
    offset(const InterfaceParameters &interface) const;

    /// The force of the Preload of @p interface; nothing where its shortening is kept by now.
    std::optional<double>
    preload(const InterfaceParameters &interface) const;

    /// Prescribed displacements of @p body; a condition without a value is zero at all times.
    std::vector<DirichletCondition>
    dirichlet(const Body &body) const;

  private:
    const Parameters                    &parameters;
    const double                         time;
    FieldChecks                         &checks;
    std::shared_ptr<const ExactSolution> solution;
  };
} // namespace mortise
