// A scene and checks of messages for the tests of parameter files.
#pragma once

#include <mortise/base/error.h>
#include <mortise/problem/input/parameter_schema.h>
#include <mortise/problem/input/parameters.h>
#include <verdict.h>

#include <string>
#include <vector>

namespace parameter_checks
{
  using namespace mortise;

  const std::string scene = R"(
set Title      = Two cubes = one
set Bodies     = inner, outer
set Interfaces = glue
subsection Body inner
  set Degree = 2                        # 1..8
  set Degree by region = 3: 4; 5: 1
  subsection Mesh
    set Source       = shell octant
    set Extent       = 1, 1.5
    set Subdivisions = 4, 2
    set Rotate       = 0, 0, 30
  end
  subsection Material
    set Young modulus = 10
    set Poisson ratio = 0.25
  end
  set Body force = 0; pow(x, 2); max(y, z)
  subsection Boundary inside
    set Pressure     = 1 + x
  end
  subsection Boundary zmin
    set Traction     = exact
  end
  subsection Boundary xmin
    set Displacement = 0, -, pow(x, 2)
  end
end
subsection Body outer
  subsection Mesh
    set Source       = shell octant
    set Extent       = 1.5, \
                       2
    set Subdivisions = 6, 3
  end
  subsection Material
    set Young modulus = 1
  end
end
subsection Interface glue
  set Slave  = inner: outside
  set Master = outer: inside
end
subsection Exact solution
  set Displacement = thick sphere
end
subsection Solver
  set Method    = saddle point
end
subsection Output
  set Fields     = displacement, traction
  set Points     = corner: outer: 2, 0, 0; other: inner: 0, 1e0, 0
  set Resultants = push: inner: inside
end
)";

  /// The scene with @p from replaced by @p to.
  inline std::string
  edited(const std::string &from, const std::string &to)
  {
    std::string       text     = scene;
    const std::size_t position = text.find(from);
    if (position == std::string::npos)
      {
        verdict(false, "the scene of this test", "no \"" + from + "\" in it");
        return text;
      }
    return text.replace(position, from.size(), to);
  }

  /// Parsing and validating the edited scene gives a message with all @p parts.
  inline void
  check_edit(const std::string              &what,
             const std::string              &from,
             const std::string              &to,
             const std::vector<std::string> &parts)
  {
    check_message(
      what,
      [&] { validate(parse_parameters(edited(from, to), "a.prm")); },
      parts);
  }

  /// The same with a setting of the command line.
  inline void
  check_setting(const std::string              &what,
                const std::string              &setting,
                const std::vector<std::string> &parts)
  {
    check_message(
      what,
      [&] { validate(parse_parameters(scene, "a.prm", {setting})); },
      parts);
  }
} // namespace parameter_checks
