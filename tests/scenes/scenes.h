// The parameter texts that the tests of whole scenes share.
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

  /// The interface of a scene of two bodies tied at "body: boundary".
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

  /// Two halves of a block that meet in a curved surface, clamped where it
  /// comes out at the sides, with a smooth displacement and what balances it.
  inline std::string
  manufactured()
  {
    const std::string sides  = "xmin xmax ymin ymax";
    const std::string extent = "0, 0, 0, 1, 1, 1";
    std::string       text =
      tied("lower, upper", "lower: interface", "upper: interface") +
      body("lower", "curved block", extent, sides + " zmin", "") +
      body("upper", "curved block", extent, sides, "zmax");
    for (const std::string half : {"lower", "upper"})
      text += "subsection Body " + half + "\n  set Body force = auto\n" +
              "  subsection Mesh\n    set Half = " + half +
              "\n    set Amplitude = 0.1\n  end\nend\n";
    return text +
           "subsection Exact solution\n  set Displacement = 0.1*sin(x + "
           "2*y)*cos(z); 0.1*cos(2*x)*sin(y + z); 0.1*exp(x/2)*sin(y)*cos(z)\n"
           "end\n";
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
