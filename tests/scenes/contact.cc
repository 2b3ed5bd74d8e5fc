// Proves contact without friction: what presses is exact where it is constant
// or linear, parts in press fits come apart and gaps close at the loads of
// Lame, a part of a face opens without a trace of pull, and what is lost or
// cannot be done is said. The same on any number of ranks.
#include "contact_scene.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  /// No node pulls, none overlaps, and all that is known of the set.
  void
  check_signs(const std::string &what, const StepSummary &step)
  {
    const ContactSummary &of = contact_of(step);
    verdict(what + ": nothing overlaps", -of.gap_min, 1e-10);
    verdict(what + ": active sets", *step.solver->active_sets, 8);
  }

  void
  check_blocks()
  {
    const double pressure = (0.011 - 0.001) / (1. / 900. + 0.5 / 300.);
    for (const unsigned int p : {1, 2, 3, 5})
      for (const std::string gap : {"of the meshes", "by Offset"})
        {
          Settings settings = contact + degrees("lower", "upper", p);
          if (gap == "by Offset")
            settings = settings + Settings{"Interface glue/Mesh gap=ignored",
                                           "Interface glue/Offset=0.001"};
          const StepSummary step =
            run_scene(two_blocks(), settings).steps.back();
          const std::string what =
            "blocks, gap " + gap + ", degree " + std::to_string(p);
          verdict(what + ": mean pressure",
                  std::fabs(contact_of(step).pressure_mean / pressure - 1.),
                  1e-9);
          verdict(what + ": largest pressure",
                  std::fabs(contact_of(step).pressure_max / pressure - 1.),
                  1e-8);
          verdict(what + ": area",
                  std::fabs(contact_of(step).area - 1.),
                  1e-12);
          verdict(what + ": active sets", *step.solver->active_sets, 2);
        }
    const StepSummary open =
      run_scene(two_blocks(), contact + Settings{"Interface glue/Offset=0.02"})
        .steps.back();
    verdict("blocks that do not touch: active", contact_of(open).active, 0);
    verdict("blocks that do not touch: gap",
            std::fabs(contact_of(open).gap_min - 0.01),
            1e-10);
  }

  /// Inner part 1..2, outer 2..3, E = 1000 and 500, nu = 0.3 and 0.25.
  std::string
  fit(const bool sphere)
  {
    return tied("inner, outer", "inner: outside", "outer: inside") +
           layer("inner", "1, 2", sphere, true) +
           layer("outer", "2, 3", sphere, false) +
           "subsection Body inner\n  subsection Material\n"
           "    set Young modulus = 1000\n    set Poisson ratio = 0.3\n  end\nend\n"
           "subsection Body outer\n  subsection Material\n"
           "    set Young modulus = 500\n    set Poisson ratio = 0.25\n  end\n"
           "  subsection Boundary outside\n    set Pressure = 0\n  end\nend\n"
           "subsection Interface glue\n  set Mesh gap = ignored\nend\n"
           "subsection Exact solution\n  set Displacement = " +
           (sphere ? "thick sphere" : "thick cylinder") + "\nend\n";
  }

  void
  check_fits()
  {
    for (const bool sphere : {false, true})
      {
        const std::string subdivisions = sphere ? "3, 2" : "5, 2, 1";
        const Settings    common =
          contact + degrees("inner", "outer", 4) +
          Settings{"Body inner/Mesh/Subdivisions=" + subdivisions,
                   std::string("Body outer/Mesh/Subdivisions=") +
                     (sphere ? "4, 2" : "7, 2, 1")};
        const auto check = [&](const std::string &what,
                               const Settings    &loads,
                               const double       pressure) {
          const std::string name =
            (sphere ? "spheres, " : "cylinders, ") + what;
          const StepSummary step =
            run_scene(fit(sphere), common + loads).steps.back();
          const ContactSummary &of = contact_of(step);
          if (pressure > 0.)
            {
              verdict(name + ": pressure",
                      std::fabs(of.pressure_mean / pressure - 1.),
                      1e-4);
              verdict(name + ": all press", of.inactive, 0);
            }
          else
            verdict(name + ": nothing presses", of.active, 0);
          verdict(name + ": energy", *step.errors->energy, 2e-3);
          check_signs(name, step);
        };
        const std::string none    = "Body inner/Boundary inside/Pressure=0";
        const std::string fits    = "Interface glue/Offset=-0.01";
        const double      opens   = sphere ? 1.563786008 : 0.7407407407;
        const auto        tension = [&](const double share) {
          return "Body outer/Boundary outside/Pressure=" +
                 number(-share * opens);
        };
        const double pressure = sphere ? 1.819923372 : 0.7545271630;
        check("press fit", {none, fits}, pressure);
        check("pulled by half", {none, fits, tension(0.5)}, 0.5 * pressure);
        check("pulled nearly open",
              {none, fits, tension(0.99)},
              0.01 * pressure);
        check("pulled open", {none, fits, tension(1.01)}, 0.);
        const std::string gap      = "Interface glue/Offset=0.01";
        const double      closes   = sphere ? 33.33333333 : 8.241758242;
        const auto        inflated = [](const double by) {
          return "Body inner/Boundary inside/Pressure=" + number(by);
        };
        check("inflated to 60",
              {inflated(60.), gap},
              sphere ? 1.455938697 : 4.738430584);
        check("inflated too little", {inflated(0.99 * closes), gap}, 0.);
      }
  }

  /// The upper block is pushed on one half and pulled on the other.
  void
  check_part()
  {
    for (const unsigned int p : {1, 2, 4})
      {
        const Settings settings =
          contact + degrees("lower", "upper", p) +
          Settings{"Body upper/Mesh/Extent=0, 0, 1, 1, 1, 1.5",
                   "Body upper/Boundary zmax/Displacement=-, -, 0.01*(x - 0.6)",
                   "Body lower/Mesh/Subdivisions=6, 3, 4",
                   "Body upper/Mesh/Subdivisions=8, 4, 2"};
        const StepSummary step = run_scene(two_blocks(), settings).steps.back();
        const std::string what = "a part opens, degree " + std::to_string(p);
        const auto       &of   = contact_of(step);
        verdict(what + ": some press", of.active > 0 ? 0. : 1., 0.);
        verdict(what + ": some do not", of.inactive > 0 ? 0. : 1., 0.);
        verdict(what + ": forces balance",
                *step.interfaces.front().force_residual,
                1e-10);
        check_signs(what, step);
      }
  }

  /// Where the edge of the contact is far from the first guess lower degrees
  /// find it, steps under loads that grow know where they go, and a low degree
  /// at the edge does.
  void
  check_starts()
  {
    const Settings tipped = {
      "Body upper/Mesh/Extent=0, 0, 1, 1, 1, 1.5",
      "Body upper/Boundary zmax/Displacement=-, -, 0.01*t*(x - 0.6)",
      "Body lower/Mesh/Subdivisions=8, 2, 4",
      "Body upper/Mesh/Subdivisions=7, 3, 2",
      "Steps/End time=1"};
    for (const unsigned int p : {2, 4, 7})
      {
        const std::string of    = ", degree " + std::to_string(p);
        const auto        steps = run_scene(two_blocks(),
                                     contact + degrees("lower", "upper", p) +
                                       tipped + Settings{"Steps/Step=0.25"})
                             .steps;
        verdict("tipped" + of + ": active sets",
                *steps[0].solver->active_sets,
                4);
        for (unsigned int k = 1; k < steps.size(); ++k)
          verdict("tipped further" + of + ": iterations of all",
                  *steps[k].solver->linear_iterations,
                  1);
        verdict("tipped further" + of + ": pressure",
                std::fabs(contact_of(steps[3]).pressure_max /
                            (4. * contact_of(steps[0]).pressure_max) -
                          1.),
                1e-8);
      }
    const auto low =
      run_scene(
        two_blocks(),
        contact + degrees("lower", "upper", 5) + tipped +
          Settings{
            "Steps/Step=1",
            "Body lower/Degree near=0.6, 0.5, 1, 0.2, 2; 0.6, 0, 0.9, 0.2, 1",
            "Body upper/Degree near=0.6, 0.5, 1, 0.2, 2"})
        .steps.back();
    verdict("tipped, low degrees at the edge: lowest",
            std::fabs(double(low.bodies[0].degree_min) - 1.) +
              std::fabs(double(low.bodies[1].degree_min) - 2.),
            0.);
    check_signs("tipped, low degrees at the edge", low);
  }

  /// Blocks whose meshes overlap by a tenth of a face, with nothing else that
  /// presses.
  void
  check_overlap()
  {
    for (const unsigned int p : {1, 2, 4})
      {
        const double      overlap = 0.1 / 3.;
        const StepSummary step =
          run_scene(two_blocks(),
                    contact + degrees("lower", "upper", p) +
                      Settings{"Body upper/Mesh/Extent=0, 0, " +
                                 number(1. - overlap) + ", 1, 1, " +
                                 number(1.5 - overlap),
                               "Body upper/Boundary zmax/Displacement=-, -, 0"})
            .steps.back();
        verdict("meshes that overlap, degree " + std::to_string(p),
                std::fabs(contact_of(step).pressure_max /
                            (overlap / (1. / 900. + 0.5 / 300.)) -
                          1.),
                1e-8);
      }
  }

  /// An edge that the middle of a face cannot see.
  void
  check_edge()
  {
    const auto settings = [](const unsigned int n) {
      return contact + degrees("lower", "upper", 2) +
             Settings{"Body upper/Mesh/Extent=-0.3, -0.3, -0.3, 0.3, 0.3, 0.3",
                      "Body upper/Mesh/Rotate=45, 0, 0",
                      "Body upper/Mesh/Translate=0.5, 0.5, 1.4242",
                      "Body upper/Mesh/Subdivisions=4, 4, 4",
                      "Body upper/Boundary zmax/Displacement=0, 0, -0.01",
                      "Body upper/Boundary xmin/Displacement=",
                      "Body upper/Boundary ymin/Displacement=",
                      "Body lower/Mesh/Subdivisions=3, " + std::to_string(n) +
                        ", 2"};
    };
    std::vector<std::string> warnings;
    const Summary            coarse =
      run_scene(two_blocks(), settings(3), MPI_COMM_WORLD, &warnings);
    verdict("an edge on a face: nothing presses",
            contact_of(coarse.steps.back()).active,
            0);
    bool told = false;
    for (const std::string &warning : warnings)
      told = told || warning.find("overlap by up to") != std::string::npos;
    verdict("an edge on a face: told", told ? 0. : 1., 0.);
    const Summary fine = run_scene(two_blocks(), settings(32));
    verdict("an edge on finer faces: presses",
            contact_of(fine.steps.back()).active > 0 ? 0. : 1.,
            0.);
  }

  /// Pushed, pulled apart and pushed again: nothing remembers.
  void
  check_steps()
  {
    const Settings settings =
      contact + degrees("lower", "upper", 2) +
      Settings{"Steps/End time=100",
               "Steps/Step=1",
               "Body upper/Boundary zmax/Displacement=-, -, "
               "-0.011*sin(t*pi/8)*(1 + sin(t*pi/8)*x)"};
    const auto   steps = run_scene(two_blocks(), settings).steps;
    const auto  &first = contact_of(steps[2]), &open = contact_of(steps[11]);
    unsigned int most = 0;
    for (unsigned int k = 1; k < steps.size(); ++k)
      most = std::max<unsigned int>(most, *steps[k].solver->active_sets);
    verdict("steps: number", std::fabs(double(steps.size()) - 100.), 0.);
    verdict("steps: active sets", most, 4);
    verdict("steps: apart on the way", open.active, 0);
    double force = 0., area = 0.;
    for (unsigned int k = 18; k < steps.size(); k += 16)
      {
        force =
          std::max(force,
                   std::fabs(contact_of(steps[k]).force[2] / first.force[2] -
                             1.));
        area = std::max(area,
                        std::fabs(contact_of(steps[k]).area / first.area - 1.));
      }
    verdict("steps: back again", force, 1e-8);
    verdict("steps: the same area", area, 1e-12);
  }

  /// The blocks turned in space, ends held in all directions.
  void
  check_rotation()
  {
    constexpr double ex = 20., ey = 35., ez = 50.; // degrees about x, y, z
    const auto       turned = [&](dealii::Tensor<1, dim> v) {
      const double angles[] = {ex, ey, ez};
      for (unsigned int a = 0; a < dim; ++a)
        {
          const double angle = angles[a] * dealii::numbers::PI / 180.;
          const double p = v[(a + 1) % 3], q = v[(a + 2) % 3];
          v[(a + 1) % 3] = std::cos(angle) * p - std::sin(angle) * q;
          v[(a + 2) % 3] = std::sin(angle) * p + std::cos(angle) * q;
        }
      return v;
    };
    const auto solve = [&](const bool turn) {
      dealii::Tensor<1, dim> along, up;
      along[0] = up[2] = 1.;
      if (turn)
        {
          along = turned(along);
          up    = turned(up);
        }
      std::string pushed;
      for (unsigned int c = 0; c < dim; ++c)
        pushed += (c > 0 ? ", " : "") + number(0.01 * up[c]) + "*(" +
                  number(along[0]) + "*x + " + number(along[1]) + "*y + " +
                  number(along[2]) + "*z - 0.6)";
      Settings settings =
        contact + degrees("lower", "upper", 3) +
        Settings{"Body upper/Mesh/Extent=0, 0, 1, 1, 1, 1.5",
                 "Body lower/Boundary zmin/Displacement=0, 0, 0",
                 "Body upper/Boundary zmax/Displacement=" + pushed};
      for (const std::string body : {"lower", "upper"})
        {
          for (const std::string side : {"xmin", "ymin"})
            settings = settings + Settings{"Body " + body + "/Boundary " +
                                           side + "/Displacement="};
          if (turn)
            settings = settings +
                       Settings{"Body " + body + "/Mesh/Rotate=" + number(ex) +
                                ", " + number(ey) + ", " + number(ez)};
        }
      return run_scene(two_blocks(), settings).steps.back();
    };
    const StepSummary     straight = solve(false), tilted = solve(true);
    const ContactSummary &one   = contact_of(straight),
                         &other = contact_of(tilted);
    const auto size             = [](const std::vector<double> &v) {
      return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    };
    verdict("turned: active",
            std::fabs(double(one.active) - double(other.active)),
            0.);
    verdict("turned: some do not press", one.inactive > 0 ? 0. : 1., 0.);
    verdict("turned: force",
            std::fabs(size(other.force) / size(one.force) - 1.),
            1e-8);
    verdict("turned: largest pressure",
            std::fabs(other.pressure_max / one.pressure_max - 1.),
            1e-8);
  }

  void
  check_units(const double unit, const double modulus)
  {
    const auto part = [](const double unit, const double modulus) {
      const auto box = [&](const std::vector<double> &corners) {
        std::string text;
        for (const double x : corners)
          text += (text.empty() ? "" : ", ") + number(unit * x);
        return text;
      };
      return contact_of(
        run_scene(
          two_blocks(),
          contact + degrees("lower", "upper", 3) +
            Settings{
              "Body lower/Mesh/Extent=" + box({0, 0, 0, 1, 1, 1}),
              "Body upper/Mesh/Extent=" + box({0, 0, 1, 1, 1, 1.5}),
              "Body lower/Material/Young modulus=" + number(900. * modulus),
              "Body upper/Material/Young modulus=" + number(300. * modulus),
              "Body upper/Boundary zmax/Displacement=-, -, 0.01*(x - " +
                number(0.6 * unit) + ")"})
          .steps.back());
    };
    const ContactSummary one = part(1., 1.), other = part(unit, modulus);
    const std::string    what =
      "lengths by " + number(unit) + ", moduli by " + number(modulus);
    verdict(what + ": force",
            std::fabs(other.force[2] / (unit * unit * modulus * one.force[2]) -
                      1.),
            1e-8);
    verdict(what + ": active",
            std::fabs(double(one.active) - double(other.active)),
            0.);
    verdict(what + ": largest pressure",
            std::fabs(other.pressure_max / (modulus * one.pressure_max) - 1.),
            1e-8);
  }

  /// Faces of all sizes, sides that are held, hanging nodes, degrees,
  /// triangles.
  void
  check_pairings()
  {
    const auto divide = [](const std::string &a, const std::string &b) {
      return Settings{"Body lower/Mesh/Subdivisions=" + a,
                      "Body upper/Mesh/Subdivisions=" + b};
    };
    for (const unsigned int p : {1, 2, 3, 5})
      {
        const Settings    equal = degrees("lower", "upper", p);
        const std::string of    = ", degree " + std::to_string(p);
        check_constant("sides held" + of, equal + sides_held);
        check_constant(
          "hanging nodes" + of,
          equal + Settings{"Body lower/Mesh/Refine near=0, 0, 1, 0.4, 1"});
      }
    for (const unsigned int p : {1, 2})
      check_triangles(p);
    const Settings linear = degrees("lower", "upper", 1),
                   square = degrees("lower", "upper", 2);
    check_constant("degree 1 on 5", linear + Settings{"Body upper/Degree=5"});
    check_constant("degree 5 on 1", linear + Settings{"Body lower/Degree=5"});
    check_constant("7 on 11", square + divide("7, 7, 1", "11, 11, 1"));
    check_constant("1 on 20", square + divide("1, 1, 1", "20, 20, 1"));
    check_constant("20 on 1", square + divide("20, 20, 1", "1, 1, 1"));
    for (const std::string slave : {"lower", "upper"})
      {
        for (const unsigned int p : {2, 3, 5})
          check_bending("hexahedra", slave, p);
        check_bending("tetrahedra", slave, 2);
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_blocks();
  check_fits();
  check_part();
  check_steps();
  check_starts();
  check_overlap();
  check_edge();
  check_units(1e-3, 1e9);
  check_units(1e6, 1.);
  check_rotation();
  check_pairings();
  check_message("contact that is lost",
                two_blocks(),
                contact + Settings{"Body upper/Boundary zmax/Displacement=",
                                   "Body upper/Boundary zmax/Traction=0, 0, 1"},
                "Contact is lost");
  check_message("partners out of sight",
                two_blocks(),
                contact +
                  Settings{"Body upper/Mesh/Extent=0, 0, 1.01, 1.2, 1, 1.5",
                           "Body lower/Mesh/Extent=0, 0, 0, 1.4, 1, 1",
                           "Body upper/Boundary zmax/Displacement=-, -, -0.02",
                           "Interface glue/Search distance=0.02"},
                "would go unseen");
}
