// The parameter texts that the tests of whole scenes share. It never runs anything.
#pragma once

#include <string>

namespace mortise::testing
{
  /// A body that is a box; boundaries in @p dirichlet get the exact displacement, those in
  /// @p traction the exact traction.
  inline std::string
  box(const std::string &name,
      const std::string &extent,
      const std::string &dirichlet,
      const std::string &traction)
  {
    std::string text = "subsection Body " + name + "\n  subsection Mesh\n    set Source = box\n" +
                       "    set Extent = " + extent + "\n  end\n" +
                       "  subsection Material\n    set Young modulus = 900\n" +
                       "    set Poisson ratio = 0.25\n  end\n";
    const auto boundaries = [&](const std::string &names, const std::string &what) {
      std::size_t begin = 0;
      while (begin < names.size())
        {
          const std::size_t end = std::min(names.find(' ', begin), names.size());
          text += "  subsection Boundary " + names.substr(begin, end - begin) + "\n    set " + what +
                  " = exact\n  end\n";
          begin = end + 1;
        }
    };
    boundaries(dirichlet, "Displacement");
    boundaries(traction, "Traction");
    return text + "end\n";
  }

  /// Two boxes on top of each other, tied at z = 0.5: a clamped rim on three sides, tractions on
  /// the others. The displacement is set by Exact solution/Displacement.
  inline std::string
  two_boxes()
  {
    return "set Bodies = lower, upper\nset Interfaces = glue\n" +
           box("lower", "0, 0, 0, 1, 1, 0.5", "zmin xmin ymin ymax", "xmax") +
           box("upper", "0, 0, 0.5, 1, 1, 1", "xmin ymin ymax", "xmax zmax") +
           "subsection Interface glue\n  set Slave = lower: zmax\n  set Master = upper: zmin\nend\n"
           "subsection Output\n  set Directory = unused\n  set Fields =\nend\n";
  }

  /// A layer of a thick sphere or cylinder with symmetry conditions, under pressure inside if asked.
  inline std::string
  layer(const std::string &name, const std::string &radii, const bool sphere, const bool pressure)
  {
    std::string text = "subsection Body " + name + "\n  subsection Mesh\n    set Source = " +
                       (sphere ? "shell octant" : "cylinder sector") + "\n    set Extent = " + radii +
                       (sphere ? "" : ", 0.5") + "\n  end\n" +
                       "  subsection Material\n    set Young modulus = 10\n  end\n"
                       "  subsection Boundary xmin\n    set Displacement = 0, -, -\n  end\n"
                       "  subsection Boundary ymin\n    set Displacement = -, 0, -\n  end\n"
                       "  subsection Boundary zmin\n    set Displacement = -, -, 0\n  end\n";
    if (!sphere)
      text += "  subsection Boundary zmax\n    set Displacement = -, -, 0\n  end\n";
    if (pressure)
      text += "  subsection Boundary inside\n    set Pressure = 1\n  end\n";
    return text + "end\n";
  }

  /// A thick sphere or cylinder of two layers under pressure inside.
  inline std::string
  two_layers(const bool sphere)
  {
    return "set Bodies = inner, outer\nset Interfaces = glue\n" +
           layer("inner", "1, 1.5", sphere, true) + layer("outer", "1.5, 2", sphere, false) +
           "subsection Interface glue\n  set Slave = inner: outside\n  set Master = outer: inside\n"
           "end\nsubsection Exact solution\n  set Displacement = thick " +
           (sphere ? "sphere" : "cylinder") +
           "\nend\nsubsection Output\n  set Directory = unused\n  set Fields =\nend\n";
  }
} // namespace mortise::testing
