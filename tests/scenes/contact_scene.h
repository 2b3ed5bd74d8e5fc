// Two blocks in contact, and checks of pressures that are exact on any mesh.
#pragma once

#include "scene.h"
#include "scenes.h"

namespace mortise::testing
{
  const Settings contact = {"Interface glue/Law=contact"};

  inline const ContactSummary &
  contact_of(const StepSummary &step)
  {
    return *step.interfaces.front().contact;
  }

  inline Settings
  degrees(const std::string &a, const std::string &b, const unsigned int p)
  {
    return {"Body " + a + "/Degree=" + std::to_string(p),
            "Body " + b + "/Degree=" + std::to_string(p)};
  }

  /// Two blocks of 1 x 1, heights 1 and 0.5, sides free, a gap between them,
  /// the upper one pushed down.
  inline std::string
  two_blocks()
  {
    return tied("lower, upper", "lower: zmax", "upper: zmin") +
           "subsection Body lower\n  subsection Mesh\n    set Extent = 0, 0, 0, 1, 1, 1\n"
           "    set Subdivisions = 3, 3, 2\n  end\n"
           "  subsection Material\n    set Young modulus = 900\n    set Poisson ratio = 0.3\n  end\n"
           "  subsection Boundary zmin\n    set Displacement = -, -, 0\n  end\n"
           "  subsection Boundary xmin\n    set Displacement = 0, -, -\n  end\n"
           "  subsection Boundary ymin\n    set Displacement = -, 0, -\n  end\nend\n"
           "subsection Body upper\n  subsection Mesh\n    set Extent = 0, 0, 1.001, 1, 1, 1.501\n"
           "    set Subdivisions = 4, 4, 1\n  end\n"
           "  subsection Material\n    set Young modulus = 300\n    set Poisson ratio = 0.1\n  end\n"
           "  subsection Boundary zmax\n    set Displacement = -, -, -0.011\n  end\n"
           "  subsection Boundary xmin\n    set Displacement = 0, -, -\n  end\n"
           "  subsection Boundary ymin\n    set Displacement = -, 0, -\n  end\nend\n";
  }

  /// The motion of the lower block is prescribed at two of its sides.
  const Settings sides_held = {
    "Body lower/Boundary xmin/Displacement=0, 0, -0.004*z",
    "Body lower/Boundary ymax/Displacement=0, 0, -0.004*z"};

  /// Both blocks move along z alone: the pressure is constant.
  inline void
  check_constant(const std::string &what, const Settings &settings)
  {
    const StepSummary step =
      run_scene(two_blocks(),
                contact +
                  Settings{"Body lower/Material/Poisson ratio=0",
                           "Body upper/Material/Poisson ratio=0"} +
                  settings)
        .steps.back();
    const double pressure = (0.011 - 0.001) / (1. / 900. + 0.5 / 300.);
    const auto  &of       = contact_of(step);
    verdict(what + ": mean and largest pressure",
            std::max(std::fabs(of.pressure_max / pressure - 1.),
                     std::fabs(of.pressure_mean / pressure - 1.)),
            1e-8);
    verdict(what + ": the force",
            std::fabs(std::fabs(of.force[2]) / pressure - 1.),
            1e-9);
    verdict(what + ": all press", of.inactive, 0);
    verdict(what + ": no penetration", of.penetration_max, 1e-10);
    verdict(what + ": active sets", *step.solver->active_sets, 3);
  }

  /// Triangles as slave or master, or both, and where sides are held.
  inline void
  check_triangles(const unsigned int p)
  {
    const Settings    equal = degrees("lower", "upper", p);
    const std::string of    = ", degree " + std::to_string(p);
    const auto        cells = [](const std::string &a, const std::string &b) {
      return Settings{"Body lower/Mesh/Cells=" + a,
                      "Body upper/Mesh/Cells=" + b};
    };
    check_constant("triangles on quadrilaterals" + of,
                   equal + cells("tetrahedra", "hexahedra"));
    check_constant("quadrilaterals on triangles" + of,
                   equal + cells("hexahedra", "tetrahedra"));
    check_constant("triangles on triangles" + of,
                   equal + cells("tetrahedra", "tetrahedra") +
                     Settings{"Interface glue/Slave=upper: zmin",
                              "Interface glue/Master=lower: zmax"});
    check_constant("triangles, sides held" + of,
                   equal + cells("tetrahedra", "hexahedra") + sides_held);
  }

  /// sigma_zz = -(3 + 2 x) in both, different materials: sideways the lower
  /// block does not move as the upper one.
  inline void
  check_bending(const std::string &shape,
                const std::string &slave,
                const unsigned int p)
  {
    const auto field = [](const double E, const double nu) {
      const std::string e = number(1. / E), n = number(nu);
      return n + "*3*x*" + e + " + 2*(z*z + " + n + "*(x*x - y*y))/2*" + e +
             ", " + n + "*3*y*" + e + " + " + n + "*2*x*y*" + e +
             ", -(3*z + 2*x*z)*" + e;
    };
    Settings settings =
      contact + degrees("lower", "upper", p) +
      Settings{"Body lower/Mesh/Extent=0, 0, -1, 1, 1, 0",
               "Body upper/Mesh/Extent=0, 0, 0, 1, 1, 0.5",
               "Body " + slave + "/Mesh/Cells=" + shape,
               "Body lower/Boundary xmin/Displacement=",
               "Body lower/Boundary ymin/Displacement=",
               "Body upper/Boundary xmin/Displacement=",
               "Body upper/Boundary ymin/Displacement=",
               "Body lower/Boundary zmin/Displacement=" + field(900., 0.3),
               "Body upper/Boundary zmax/Displacement=" + field(300., 0.1)};
    if (slave == "upper")
      settings = settings + Settings{"Interface glue/Slave=upper: zmin",
                                     "Interface glue/Master=lower: zmax"};
    const StepSummary step = run_scene(two_blocks(), settings).steps.back();
    const auto       &of   = contact_of(step);
    const std::string what = "bending, " + shape + ", slave " + slave +
                             ", degree " + std::to_string(p);
    const double sign = slave == "lower" ? -1. : 1.;
    verdict(what + ": force", std::fabs(of.force[2] * sign - 4.), 1e-9);
    // int y p and -int x p
    verdict(what + ": moments",
            std::max(std::fabs(of.moment[0] * sign - 2.),
                     std::fabs(of.moment[1] * sign + 3. / 2. + 2. / 3.)),
            1e-9);
    verdict(what + ": all press", of.inactive, 0);
    verdict(what + ": no penetration", of.penetration_max, 1e-10);
  }
} // namespace mortise::testing
