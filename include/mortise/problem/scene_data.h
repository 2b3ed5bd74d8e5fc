// What the parameters of a scene mean as functions: exact solution, loads,
// prescribed displacements. It never touches a mesh beyond the ids of its
// boundaries.
#pragma once

#include <mortise/base/field_checks.h>
#include <mortise/body/boundary_conditions.h>
#include <mortise/material/exact_solution.h>
#include <mortise/operators/scene_system.h>
#include <mortise/problem/parameters.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// Material of each body.
  std::vector<Material>
  materials(const Parameters &parameters);

  /// The exact solution that the parameters name; null if there is none. The
  /// named ones take radii, pressures, materials and the motion of the scene
  /// from the bodies. Throws InputError if the bodies are not what the named
  /// solution is for. What these three return tells @p checks, which must live
  /// on, of values that no run can use.
  std::shared_ptr<const ExactSolution>
  make_exact_solution(const Parameters &parameters, FieldChecks &checks);

  /// Body force and tractions of @p body. The result refers to @p exact.
  Loads
  make_loads(const Parameters                           &parameters,
             const Body                                 &body,
             const std::shared_ptr<const ExactSolution> &exact,
             FieldChecks                                &checks);

  /// Prescribed displacements of @p body.
  std::vector<DirichletCondition>
  make_dirichlet(const Parameters                           &parameters,
                 const Body                                 &body,
                 const std::shared_ptr<const ExactSolution> &exact,
                 FieldChecks                                &checks);
} // namespace mortise
