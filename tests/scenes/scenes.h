// The parameter texts that the tests of whole scenes share. It never runs
// anything.
#pragma once

#include <sstream>
#include <string>

namespace mortise::testing
{
  /// All digits of @p value.
  inline std::string
  number(const double value)
  {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
  }

  /// A body from a generator; boundaries in @p dirichlet get the exact displacement, those in
  /// @p traction the exact traction.
  inline std::string
  body(const std::string &name,
       const std::string &source,
       const std::string &extent,
       const std::string &dirichlet,
       const std::string &traction)
  {
    std::string text = "subsection Body " + name +
                       "\n  subsection Mesh\n    set Source = " + source +
                       "\n    set Extent = " + extent + "\n  end\n" +
                       "  subsection Material\n    set Young modulus = 900\n" +
                       "    set Poisson ratio = 0.25\n  end\n";
    const auto boundaries = [&](const std::string &names,
                                const std::string &what) {
      std::size_t begin = 0;
      while (begin < names.size())
        {
          const std::size_t end =
            std::min(names.find(' ', begin), names.size());
          text += "  subsection Boundary " + names.substr(begin, end - begin) +
                  "\n    set " + what + " = exact\n  end\n";
          begin = end + 1;
        }
    };
    boundaries(dirichlet, "Displacement");
    boundaries(traction, "Traction");
    return text + "end\n";
  }

  inline std::string
  box(const std::string &name,
      const std::string &extent,
      const std::string &dirichlet,
      const std::string &traction)
  {
    return body(name, "box", extent, dirichlet, traction);
  }

  /// What a scene of two bodies tied at "body: boundary" needs besides them.
  inline std::string
  tied(const std::string &bodies,
       const std::string &slave,
       const std::string &master)
  {
    return "set Bodies = " + bodies +
           "\nset Interfaces = glue\nsubsection Interface glue\n" +
           "  set Slave = " + slave + "\n  set Master = " + master + "\nend\n" +
           "subsection Output\n  set Directory = unused\n  set Fields =\nend\n";
  }

  /// Two boxes on top of each other, tied at z = 0.5: a clamped rim on three
  /// sides, tractions on the others. The displacement is set by Exact
  /// solution/Displacement.
  inline std::string
  two_boxes()
  {
    return tied("lower, upper", "lower: zmax", "upper: zmin") +
           box("lower", "0, 0, 0, 1, 1, 0.5", "zmin xmin ymin ymax", "xmax") +
           box("upper", "0, 0, 0.5, 1, 1, 1", "xmin ymin ymax", "xmax zmax");
  }

  /// A layer of a thick sphere or cylinder with symmetry conditions, under
  /// pressure inside if asked.
  inline std::string
  layer(const std::string &name,
        const std::string &radii,
        const bool         sphere,
        const bool         pressure)
  {
    std::string text =
      "subsection Body " + name + "\n  subsection Mesh\n    set Source = " +
      (sphere ? "shell octant" : "cylinder sector") +
      "\n    set Extent = " + radii + (sphere ? "" : ", 0.5") + "\n  end\n" +
      "  subsection Material\n    set Young modulus = 10\n  end\n"
      "  subsection Boundary xmin\n    set Displacement = 0, -, -\n  end\n"
      "  subsection Boundary ymin\n    set Displacement = -, 0, -\n  end\n"
      "  subsection Boundary zmin\n    set Displacement = -, -, 0\n  end\n";
    if (!sphere)
      text +=
        "  subsection Boundary zmax\n    set Displacement = -, -, 0\n  end\n";
    if (pressure)
      text += "  subsection Boundary inside\n    set Pressure = 1\n  end\n";
    return text + "end\n";
  }

  /// A thick sphere or cylinder of two layers under pressure inside.
  inline std::string
  two_layers(const bool sphere)
  {
    return tied("inner, outer", "inner: outside", "outer: inside") +
           layer("inner", "1, 1.5", sphere, true) +
           layer("outer", "1.5, 2", sphere, false) +
           "subsection Exact solution\n  set Displacement = thick " +
           (sphere ? "sphere" : "cylinder") + "\nend\n";
  }
} // namespace mortise::testing
