// All parameters of a scene, the values that they are assigned, and how they
// are printed for people.
#pragma once

#include <mortise/problem/input/parameter_entry.h>
#include <mortise/problem/input/parameter_file.h>

#include <string>
#include <vector>

namespace mortise
{
  /// The entries of all parameters, section by section. They set members of
  /// @p parameters, which must outlive them, and whose bodies, boundaries and interfaces have their
  /// names already.
  std::vector<ParameterEntry>
  declare_parameters(Parameters &parameters);

  /// The part of them in the subsection of a body.
  void
  declare_body(const ParameterSection &section, BodyParameters &body);

  /// The part of those in its subsection Mesh.
  void
  declare_mesh(const ParameterSection &section, MeshParameters &mesh);

  /// The part of those in the subsections of how a scene is solved.
  void
  declare_solver(const ParameterSection &section, SolverParameters &solver);
  void
  declare_adaptivity(const ParameterSection &section,
                     AdaptivityParameters   &adaptivity);
  void
  declare_steps(const ParameterSection &section, StepParameters &steps);

  /// Note the value, and @p where it stands, in the entry that @p assignment names. Throws InputError
  /// if there is none, with the nearest.
  void
  assign(std::vector<ParameterEntry> &entries,
         const Assignment            &assignment,
         const std::string           &where);

  /// A parameter file with every parameter at its default, each with its unit,
  /// meaning and what is allowed as a comment: what --parameters prints.
  std::string
  parameter_reference();
} // namespace mortise
