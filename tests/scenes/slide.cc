// Proves Law = slide: blocks of different materials whose sides are free, and
// which a tie would hold, come together with the exact pressure; a bending
// patch is exact from degree 2 on; a rotation of one part of a press fit about
// its axis moves the other ever less; what slides freely is named.
#include <mortise/base/error.h>

#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  struct Elasticity
  {
    double E, nu;
  };

  std::string
  block(const std::string &name,
        const std::string &extent,
        const Elasticity  &material,
        const std::string &boundaries)
  {
    return "subsection Body " + name +
           "\n  subsection Mesh\n    set Source = box\n    set Extent = " +
           extent + "\n  end\n  subsection Material\n    set Young modulus = " +
           number(material.E) +
           "\n    set Poisson ratio = " + number(material.nu) + "\n  end\n" +
           boundaries + "end\n";
  }

  std::string
  prescribed(const std::string &boundary, const std::string &displacement)
  {
    return "  subsection Boundary " + boundary +
           "\n    set Displacement = " + displacement + "\n  end\n";
  }

  std::string
  sliding(const std::string &bodies)
  {
    return tied("lower, upper", "lower: zmax", "upper: zmin") + bodies +
           "subsection Interface glue\n  set Law = slide\nend\n"
           "subsection Solver\n  set Tolerance = 1e-12\nend\n";
  }

  /// Largest difference over the largest of the exact values.
  double
  difference(const std::vector<double> &got, const std::vector<double> &exact)
  {
    double largest = 0., size = 0.;
    for (unsigned int i = 0; i < exact.size(); ++i)
      {
        largest = std::max(largest, std::fabs(got[i] - exact[i]));
        size    = std::max(size, std::fabs(exact[i]));
      }
    return largest / size;
  }

  const std::vector<Elasticity> lower_and_upper = {{1000., 0.4}, {300., 0.1}};

  /// Blocks of height 1 and 2, each free at two sides, and what they are at
  /// "corner" under a shortening.
  void
  check_blocks(const std::string &what, const Settings &settings)
  {
    const double      shortening = 0.05, offset = 0.02;
    const std::string symmetry =
      prescribed("xmin", "0, -, -") + prescribed("ymin", "-, 0, -");
    const std::string text = sliding(
      block("lower",
            "0, 0, 0, 1, 1, 1",
            lower_and_upper[0],
            symmetry + prescribed("zmin", "-, -, 0")) +
      block("upper",
            "0, 0, 1, 1, 1, 3",
            lower_and_upper[1],
            symmetry + prescribed("zmax", "-, -, " + number(-shortening))));
    const Summary summary = run_scene(
      text,
      Settings{"Interface glue/Offset=" + number(offset),
               "Output/Points=below: lower: 1, 1, 1; above: upper: 1, 1, 1",
               "Output/Resultants=force: lower: zmin"} +
        settings);
    const auto  &q = summary.steps.back().quantities;
    const double p = (shortening - offset) /
                     (1. / lower_and_upper[0].E + 2. / lower_and_upper[1].E);
    const auto corner = [&](const Elasticity &m, const double u_z) {
      return std::vector<double>{m.nu * p / m.E, m.nu * p / m.E, u_z};
    };
    verdict(what + ": below 1e-9",
            difference(q[0].second,
                       corner(lower_and_upper[0], -p / lower_and_upper[0].E)),
            1e-9);
    verdict(what + ": above 1e-9",
            difference(q[1].second,
                       corner(lower_and_upper[1],
                              -shortening + 2. * p / lower_and_upper[1].E)),
            1e-9);
    verdict(what + ": force 1e-9", difference(q[2].second, {0., 0., p}), 1e-9);
  }

  void
  check_all_blocks()
  {
    for (const std::string method : {"condensed", "saddle point", "direct"})
      for (const std::string multiplier : {"standard", "dual"})
        for (const unsigned int p : {1, 2, 5})
          check_blocks(method + ", " + multiplier + ", degree " +
                         std::to_string(p),
                       both("Degree=" + std::to_string(p)) +
                         Settings{"Solver/Method=" + method,
                                  "Interface glue/Multiplier=" + multiplier,
                                  "Body lower/Mesh/Subdivisions=3, 2, 1",
                                  "Body upper/Mesh/Subdivisions=2, 3, 2"});
    check_blocks("exchanged",
                 both("Degree=2") +
                   Settings{"Interface glue/Slave=upper: zmin",
                            "Interface glue/Master=lower: zmax",
                            "Body lower/Mesh/Subdivisions=4, 4, 2",
                            "Body upper/Mesh/Subdivisions=3, 3, 2"});
    check_blocks("tetrahedra on hexahedra, degree 3",
                 both("Degree=3") +
                   Settings{"Body lower/Mesh/Cells=tetrahedra",
                            "Body lower/Mesh/Subdivisions=2, 2, 2",
                            "Body upper/Mesh/Subdivisions=3, 3, 2"});
    check_blocks("hanging nodes",
                 both("Degree=2") +
                   Settings{"Body lower/Mesh/Subdivisions=3, 3, 2",
                            "Body upper/Mesh/Subdivisions=2, 2, 2",
                            "Body lower/Mesh/Refine near=1, 1, 1, 0.4, 1",
                            "Body upper/Mesh/Refine near=0, 1, 1, 0.4, 1"});
    check_blocks("mixed degrees",
                 both("Degree=2") +
                   Settings{"Body lower/Mesh/Subdivisions=2, 2, 2",
                            "Body upper/Mesh/Subdivisions=3, 3, 2",
                            "Body lower/Degree by region=4: 3; 5: 2; 6: 4",
                            "Solver/Method=condensed"});
  }

  /// u_c for sigma_zz = -(c0 + c1 x), the only stress.
  std::string
  bending(const Elasticity &m)
  {
    const double      c0 = 3., c1 = 2.;
    const std::string E = number(m.E), nu = number(m.nu), a = number(c0),
                      b = number(c1);
    return nu + "*" + a + "*x/" + E + " + " + b + "*(z^2 + " + nu +
           "*(x^2 - y^2))/(2*" + E + "), " + nu + "*" + a + "*y/" + E + " + " +
           nu + "*" + b + "*x*y/" + E + ", -(" + a + "*z + " + b + "*x*z)/" + E;
  }

  void
  check_bending()
  {
    const std::vector<double> x = {0.7, 0.3};
    for (const std::string sides : {"free", "clamped"})
      for (const unsigned int p : {2, 3, 4})
        {
          std::string bodies;
          for (const std::string name : {"lower", "upper"})
            {
              const bool        lower = name == "lower";
              const Elasticity &m     = lower_and_upper[lower ? 0 : 1];
              std::string       boundaries =
                prescribed(lower ? "zmin" : "zmax", bending(m));
              if (sides == "clamped")
                for (const std::string side : {"xmin", "xmax", "ymin", "ymax"})
                  boundaries += prescribed(side, bending(m));
              bodies += block(name,
                              lower ? "0, 0, -1, 1, 1, 0" : "0, 0, 0, 1, 1, 1",
                              m,
                              boundaries);
            }
          const Summary summary = run_scene(
            sliding(bodies),
            both("Degree=" + std::to_string(p)) +
              Settings{"Output/Points=below: lower: 0.7, 0.3, 0; above: upper: "
                       "0.7, 0.3, 0",
                       "Body lower/Mesh/Subdivisions=3, 3, 2",
                       "Body upper/Mesh/Subdivisions=2, 2, 2"});
          for (unsigned int i = 0; i < 2; ++i)
            {
              const Elasticity &m = lower_and_upper[i];
              verdict("bending, sides " + sides + ", degree " +
                        std::to_string(p) + (i == 0 ? ", below" : ", above") +
                        " 1e-10",
                      difference(summary.steps.back().quantities[i].second,
                                 {m.nu / m.E *
                                    (3. * x[0] + x[0] * x[0] - x[1] * x[1]),
                                  m.nu / m.E * (3. * x[1] + 2. * x[0] * x[1]),
                                  0.}),
                      1e-10);
            }
        }
  }

  /// The outer part of a press fit turned about the axis by @p angle.
  std::vector<double>
  turned(const double angle, const unsigned int p)
  {
    const std::string w = number(angle);
    const std::string radial =
      "0.01*x/(x^2 + y^2) - " + w + "*y, 0.01*y/(x^2 + y^2) + " + w + "*x, -";
    const std::string text =
      tied("inner, outer", "inner: outside", "outer: inside") +
      layer("inner", "1, 2", false, false) +
      layer("outer", "2, 3", false, false) +
      "subsection Interface glue\n  set Law = slide\n  set Offset = -0.02\nend\n"
      "subsection Solver\n  set Tolerance = 1e-13\nend\n";
    return run_scene(text,
                     Settings{"Body inner/Mesh/Subdivisions=2, 1, 1",
                              "Body outer/Mesh/Subdivisions=3, 1, 1",
                              "Body inner/Degree=" + std::to_string(p),
                              "Body outer/Degree=" + std::to_string(p),
                              "Body outer/Boundary xmin/Displacement=" + radial,
                              "Body outer/Boundary ymin/Displacement=" + radial,
                              "Output/Points=a: inner: 1.2, 0.5, 0.3"})
      .steps.back()
      .quantities[0]
      .second;
  }

  void
  check_rotation()
  {
    double before = 0.;
    for (const unsigned int p : {4, 6, 8})
      {
        const double change = difference(turned(0.001, p), turned(0., p));
        if (p == 8)
          verdict("a rotation of the outer part leaves the inner one 1e-9",
                  change,
                  1e-9);
        else if (before > 0.)
          verdict("two degrees more, a hundredth of the change",
                  change,
                  0.01 * before);
        before = change;
      }
  }

  void
  check_free()
  {
    const std::string text = sliding(block("lower",
                                           "0, 0, 0, 1, 1, 1",
                                           lower_and_upper[0],
                                           prescribed("zmin", "0, 0, 0")) +
                                     block("upper",
                                           "0, 0, 1, 1, 1, 2",
                                           lower_and_upper[1],
                                           prescribed("ymin", "-, 0, -")));
    std::string       message;
    try
      {
        run_scene(text, both("Mesh/Subdivisions=1, 1, 1"));
      }
    catch (const InputError &error)
      {
        message = error.what();
      }
    verdict("a body that slides along x is named",
            message.find("upper") != std::string::npos &&
                message.find("translation along x") != std::string::npos &&
                message.find("rotation") == std::string::npos ?
              0. :
              1.,
            0.);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_all_blocks();
  check_bending();
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    check_rotation();
  check_free();
}
