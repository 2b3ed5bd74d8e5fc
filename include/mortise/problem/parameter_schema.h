// Which parameters exist, with default, unit, meaning and what is allowed. It
// never interprets values beyond their type.
#pragma once

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <mortise/problem/parameter_file.h>

#include <memory>
#include <string>
#include <vector>

namespace mortise
{
  /// The names that make the subsections of a scene.
  struct SceneNames
  {
    std::vector<std::string> bodies;
    std::vector<std::vector<std::string>>
      boundaries; ///< of each body, those that the file names
    std::vector<std::string> interfaces;
  };

  struct ParameterDeclaration
  {
    std::vector<std::string> sections;
    std::string              name;
    std::string              default_value;
    std::string              meaning; ///< with the unit
    std::string              allowed; ///< in words
    std::vector<std::string> choices; ///< of a selection, for the nearest name
    std::shared_ptr<const dealii::Patterns::PatternBase> pattern;
  };

  /// All parameters of a scene with these names, section by section.
  std::vector<ParameterDeclaration>
  declare_parameters(const SceneNames &names);

  /// The declared parameters of one scene and the values they got.
  class ParameterSchema
  {
  public:
    explicit ParameterSchema(const SceneNames &names);

    /// Check that the parameter exists and that the value has its type, then
    /// store it. Throws InputError with what, where, what was got, and what is
    /// allowed or nearest.
    void
    assign(const Assignment &assignment);

    /// The value of a parameter.
    std::string
    get(const std::vector<std::string> &sections,
        const std::string              &name) const;

    const std::vector<ParameterDeclaration> &
    declarations() const;

  private:
    void
    check_sections(const Assignment &assignment) const;
    const ParameterDeclaration &
    find(const Assignment &assignment) const;

    SceneNames                        names;
    std::vector<ParameterDeclaration> declared;
    dealii::ParameterHandler          handler;
  };

  /// A parameter file with every parameter at its default, each with its unit,
  /// meaning and what is allowed as a comment: what --parameters prints.
  std::string
  parameter_reference();
} // namespace mortise
