// Declaration of all parameters, assignment of values, and the reference that
// --parameters prints.
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

  /// The entries of the subsection of a body.
  void
  declare_body(const ParameterSection &section, BodyParameters &body);

  /// The entries of its subsection Mesh.
  void
  declare_mesh(const ParameterSection &section, MeshParameters &mesh);

  /// The entries of the subsections Solver, Adaptivity and Steps.
  void
  declare_solver(const ParameterSection &section, SolverParameters &solver);
  void
  declare_adaptivity(const ParameterSection &section,
                     AdaptivityParameters   &adaptivity);
  void
  declare_steps(const ParameterSection &section, StepParameters &steps);

  /// Set value and location (@p where) of the entry that @p assignment names.
  /// Throws InputError with the nearest name if there is none.
  void
  assign(std::vector<ParameterEntry> &entries,
         const Assignment            &assignment,
         const std::string           &where);

  /// All entries with NAME for the names of a body, a boundary and an
  /// interface; they set nothing.
  std::vector<ParameterEntry>
  entries_of_reference();

  /// The text of --parameters: a parameter file with all defaults, and unit,
  /// meaning and allowed values as comments.
  std::string
  parameter_reference();

  /// The text of --parameters=json: the same for programs.
  std::string
  parameter_reference_as_json();
} // namespace mortise
