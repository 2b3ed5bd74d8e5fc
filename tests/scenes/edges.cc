// Proves that bodies slide along surfaces with sharp edges: a part pressed into
// a corner of three oblique planes has the exact displacements and the same
// pressure on all three, whichever body is the slave; what meets nothing is
// left out with a warning.
#include <filesystem>

#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  constexpr double pressure = 3.;

  struct Elasticity
  {
    double E, nu;

    /// Of the length under the pressure from all sides.
    double
    shortening() const
    {
      return pressure * (1. - 2. * nu) / E;
    }
  };

  std::string
  body(const std::string &name,
       const std::string &mesh,
       const Elasticity  &material,
       const std::string &outside)
  {
    return "subsection Body " + name +
           "\n  subsection Mesh\n    set Source = file\n    set File = " +
           (std::filesystem::path(__FILE__).parent_path() / "../../meshes" /
            mesh)
             .string() +
           "\n  end\n  subsection Material\n    set Young modulus = " +
           number(material.E) +
           "\n    set Poisson ratio = " + number(material.nu) +
           "\n  end\n  subsection Boundary outside\n    set " + outside +
           "\n  end\nend\n";
  }

  std::string
  shortened(const Elasticity &material)
  {
    const std::string a = "-" + number(material.shortening());
    return a + "*x; " + a + "*y; " + a + "*z";
  }

  std::string
  scene(const std::string &slave,
        const std::string &master,
        const Elasticity  &part,
        const Elasticity  &corner)
  {
    return tied("part, corner", slave + ": seat", master + ": seat") +
           body("part",
                "corner_hex.geo",
                part,
                "Pressure = " + number(pressure)) +
           body("corner",
                "corner_tet.geo",
                corner,
                "Displacement = " + shortened(corner)) +
           "subsection Interface glue\n  set Law = slide\nend\n"
           "subsection Solver\n  set Tolerance = 1e-13\nend\n";
  }

  Settings
  of_degree(const unsigned int p)
  {
    return {"Body part/Degree=" + std::to_string(p),
            "Body corner/Degree=" + std::to_string(p)};
  }

  double
  distance(const std::vector<double> &got,
           const std::vector<double> &x,
           const Elasticity          &material)
  {
    double sum = 0.;
    for (unsigned int c = 0; c < 3; ++c)
      sum += std::pow(got[c] + material.shortening() * x[c], 2);
    return std::sqrt(sum) / material.shortening();
  }

  void
  check(const std::string &slave,
        const std::string &master,
        const Settings    &settings,
        const std::string &what)
  {
    const std::string name = "slave " + slave + ", " + what;
    const Elasticity  one{10., 0.3}, other{40., 0.1};
    exact_verdicts(name,
                   *run_scene(scene(slave, master, one, one),
                              settings +
                                Settings{"Exact solution/Displacement=" +
                                         shortened(one)})
                      .steps.back()
                      .errors);
    const Summary summary = run_scene(
      scene(slave, master, one, other),
      settings +
        Settings{
          "Output/Points=a: part: 1.5, 0.6, 1; b: corner: -0.5, -0.5, -0.5"});
    const auto &q = summary.steps.back().quantities;
    verdict(name + ": two materials, part 1e-10",
            distance(q[0].second, {1.5, 0.6, 1.}, one),
            1e-10);
    verdict(name + ": two materials, corner 1e-10",
            distance(q[1].second, {-0.5, -0.5, -0.5}, other),
            1e-10);
  }

  /// The part on a plate, which one of the three planes touches: what meets
  /// nothing is told and is no reason for a warning.
  void
  check_what_meets_nothing()
  {
    const Elasticity         one{10., 0.3};
    std::vector<std::string> warnings;
    run_scene(
      tied("part, plate", "part: seat", "plate: zmax") +
        body("part", "corner_hex.geo", one, "Displacement = 0, 0, -0.1") +
        "subsection Body plate\n  subsection Mesh\n    set Source = box\n"
        "    set Extent = -1, -1, -1, 2, 2, 0\n    set Subdivisions = 3, 3, 1\n  end\n"
        "  subsection Material\n    set Young modulus = 10\n  end\n"
        "  subsection Boundary zmin\n    set Displacement = 0, 0, 0\n  end\nend\n"
        "subsection Interface glue\n  set Law = slide\nend\n",
      {},
      MPI_COMM_WORLD,
      &warnings);
    verdict("patches that meet nothing bring no warning", warnings.size(), 0.);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const auto &[slave, master] :
       {std::pair<std::string, std::string>("part", "corner"),
        {"corner", "part"}})
    {
      for (const unsigned int p : {1, 2, 4})
        check(slave, master, of_degree(p), "degree " + std::to_string(p));
      check(slave,
            master,
            of_degree(2) + Settings{"Interface glue/Multiplier=standard"},
            "standard multipliers");
      check(slave,
            master,
            of_degree(2) + Settings{"Solver/Method=direct"},
            "direct");
      check(slave,
            master,
            of_degree(2) +
              Settings{"Body part/Mesh/Refine near=0, 0, 0, 0.6, 1"},
            "hanging nodes");
    }
  check_what_meets_nothing();
}
