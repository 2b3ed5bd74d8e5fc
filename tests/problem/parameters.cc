// Proves that parameter files are read as written, that printed defaults are
// those of the structs, that --set reaches everything, and that output
// directories are checked without being made.
#include <deal.II/base/mpi.h>

#include <temporary_file.h>

#include <filesystem>
#include <fstream>

#include "parameter_checks.h"

using namespace parameter_checks;

namespace
{
  void
  test_values()
  {
    const Parameters p = parse_parameters(scene, "dir/two_cubes.prm");
    validate(p);
    const BodyParameters &inner = p.bodies[0], &outer = p.bodies[1];
    verdict(p.title == "Two cubes = one" && p.file == "dir/two_cubes.prm",
            "title and file",
            p.title);
    verdict(p.bodies.size() == 2 && inner.name == "inner" &&
              outer.name == "outer",
            "bodies");
    verdict(inner.degree == 2 && outer.degree == 1,
            "degree, given and default");
    verdict(inner.degree_by_region ==
              std::map<unsigned int, unsigned int>{{3, 4}, {5, 1}},
            "degree by region");
    verdict(inner.mesh.source == "shell octant" &&
              inner.mesh.extent == std::vector<double>{1, 1.5} &&
              inner.mesh.subdivisions == std::vector<unsigned int>{4, 2} &&
              inner.mesh.rotate[2] == 30.,
            "mesh");
    verdict(outer.mesh.extent == std::vector<double>{1.5, 2},
            "a continued line");
    verdict(inner.material.young_modulus == 10. &&
              outer.material.young_modulus == 1.,
            "material");
    verdict(inner.body_force == Components{{"0", "pow(x, 2)", "max(y, z)"}} &&
              !outer.body_force,
            "body force, given and auto");
    const BoundaryParameters &inside = inner.boundaries.at("inside");
    verdict(inside.pressure == "1 + x" && !inside.traction &&
              !inside.displacement &&
              inner.boundaries.at("zmin").traction ==
                Components{{"exact", "exact", "exact"}},
            "pressure and traction");
    verdict(inner.boundaries.at("xmin").displacement ==
              Components{{"0", "-", "pow(x, 2)"}},
            "displacement with commas within and between");
    verdict(p.interfaces.size() == 1 && p.interfaces[0].slave.body == 0 &&
              p.interfaces[0].slave.boundaries ==
                std::vector<std::string>{"outside"} &&
              p.interfaces[0].master.body == 1,
            "interface");
    verdict(p.exact_solution.kind == ExactKind::thick_sphere, "exact solution");
    verdict(p.solver.method == SolverMethod::saddle_point &&
              p.solver.tolerance == 1e-10,
            "solver");
    verdict(p.output.directory == "results/two_cubes",
            "default directory",
            p.output.directory);
    verdict(p.output.points.size() == 2 && p.output.points[1].name == "other" &&
              p.output.points[1].point == dealii::Point<3>(0, 1, 0) &&
              p.output.points[0].body == 1,
            "points");
    verdict(p.output.resultants.size() == 1 &&
              p.output.resultants[0].boundary == "inside",
            "resultants");
    verdict(p.where("Body inner/Degree") ==
              "Body inner/Degree (line 6 of dir/two_cubes.prm)",
            "origin of a value",
            p.where("Body inner/Degree"));
  }

  void
  test_defaults()
  {
    const Parameters p = parse_parameters(parameter_reference(),
                                          "reference.prm",
                                          {"Interface NAME/Slave=NAME: a",
                                           "Interface NAME/Master=NAME: b"});
    const Parameters q =
      parse_parameters("set Bodies = NAME\nset Interfaces = NAME\n",
                       "reference.prm",
                       {"Interface NAME/Slave=NAME: a",
                        "Interface NAME/Master=NAME: b"});
    const BodyParameters     &a = p.bodies[0], b, &c = q.bodies[0];
    const InterfaceParameters d;
    verdict(a.degree == b.degree && a.degree_by_region.empty() && !a.body_force,
            "printed defaults of a body are those of the struct");
    verdict(a.mesh.source == b.mesh.source && a.mesh.rotate == b.mesh.rotate &&
              a.mesh.half == b.mesh.half && a.mesh.surface == b.mesh.surface &&
              a.mesh.middle == b.mesh.middle &&
              a.mesh.amplitude == b.mesh.amplitude,
            "printed defaults of a mesh are those of the struct");
    verdict(a.material.young_modulus == b.material.young_modulus &&
              a.material.poisson_ratio == b.material.poisson_ratio &&
              a.material.law == b.material.law &&
              a.material.orthotropic.young_moduli ==
                b.material.orthotropic.young_moduli &&
              a.material.orthotropic.poisson_ratios ==
                b.material.orthotropic.poisson_ratios &&
              a.material.orthotropic.shear_moduli ==
                b.material.orthotropic.shear_moduli &&
              a.material.orthotropic.axes == b.material.orthotropic.axes,
            "printed defaults of a material are those of the struct");
    verdict(!a.boundaries.at("NAME").pressure &&
              !a.boundaries.at("NAME").traction &&
              !a.boundaries.at("NAME").displacement,
            "printed defaults of a boundary leave it free");
    verdict(p.interfaces[0].law == d.law &&
              p.interfaces[0].search_distance.by_size ==
                d.search_distance.by_size &&
              p.interfaces[0].quadrature_points == d.quadrature_points,
            "printed defaults of an interface are those of the struct");
    verdict(p.solver.method == SolverParameters().method &&
              p.solver.tolerance == SolverParameters().tolerance &&
              p.solver.max_iterations == SolverParameters().max_iterations,
            "printed defaults of the solver are those of the struct");
    verdict(p.output.fields.empty() && p.exact_solution.kind == ExactKind::none,
            "printed defaults ask for no fields and no errors");
    verdict(a.mesh.source == c.mesh.source &&
              q.origins.count("Body NAME/Degree") == 0,
            "an absent subsection has the defaults");
    const std::string all = parameter_reference();
    unsigned int      n = 0, found = 0;
    Parameters        named = p;
    for (const ParameterEntry &entry : declare_parameters(named))
      {
        ++n;
        found += all.find("set " + entry.name + " =") != std::string::npos;
      }
    verdict(n == found && n > 40, "every parameter is printed");
  }

  void
  test_settings()
  {
    const Parameters p = parse_parameters(
      scene,
      "a.prm",
      {"Title=a = b / c",
       "Body inner/Mesh/Subdivisions=8, 4",
       "Solver/Method=direct",
       "Body outer/Boundary outside/Pressure=2",
       "Body outer/Degree = 3",
       "Body outer/Degree=4",
       "Output/Directory=some/where",
       "Body inner/Boundary xmin/Displacement=-; exact; if(x < 0, 1, 2)"});
    verdict(p.title == "a = b / c", "--set of the title", p.title);
    verdict(p.bodies[0].mesh.subdivisions == std::vector<unsigned int>{8, 4},
            "--set replaces the file's value");
    verdict(p.solver.method == SolverMethod::direct, "--set of a choice");
    verdict(p.bodies[1].boundaries.at("outside").pressure == "2",
            "--set makes a boundary subsection");
    verdict(p.bodies[1].degree == 4, "the last --set wins");
    verdict(p.output.directory == "some/where", "--set of the directory");
    verdict(p.bodies[0].boundaries.at("xmin").displacement ==
              Components{{"-", "exact", "if(x < 0, 1, 2)"}},
            "--set of a displacement");
    check_setting("--set of an unknown parameter",
                  "Body inner/Degre=3",
                  {"--set \"Body inner/Degre=3\"", "did you mean \"Degree\""});
    check_setting("--set in an unknown subsection",
                  "Body iner/Degree=3",
                  {"--set \"Body iner/Degree=3\"",
                   "did you mean \"Body inner\""});
    check_setting("--set of a subsection",
                  "Body inner/Mesh=3",
                  {"unknown parameter \"Mesh\"", "is a subsection"});
    check_setting("--set without a value",
                  "Body inner/Degree",
                  {"--set \"Body inner/Degree\"", "NAME=VALUE"});
    check_setting("--set without a name", "=3", {"--set \"=3\"", "NAME=VALUE"});
    check_setting("--set with an empty section",
                  "Body inner//Degree=3",
                  {"NAME=VALUE"});
    unsigned int n     = 0,
                 found = 0; // every parameter of the scene by its own path
    Parameters named   = p;
    for (const ParameterEntry &entry : declare_parameters(named))
      {
        if (entry.name == "Bodies" || entry.name == "Interfaces")
          continue; // they make subsections
        const std::string path    = path_of(entry.sections, entry.name);
        const std::string message = message_of(
          [&] { parse_parameters(scene, "a.prm", {path + "=\x01"}); });
        ++n;
        const bool known =
          message.find("unknown parameter") == std::string::npos &&
          message.find("unknown subsection") == std::string::npos;
        if (!known)
          verdict(false, path, message);
        found += known;
      }
    verdict(n == found && n > 60,
            "--set reaches every parameter of a subsection");
    const Parameters q = parse_parameters(
      "",
      "a.prm",
      {"Bodies=b", "Body b/Degree=3", "Interfaces=", "Title=none"});
    verdict(q.bodies.size() == 1 && q.bodies[0].degree == 3,
            "--set makes a scene without a file");
  }

  void
  test_directory()
  {
    namespace fs        = std::filesystem;
    const fs::path root = temporary_file("");
    std::ofstream(root / "file") << "text";
    fs::create_symlink("nothing", root / "link");
    std::ofstream(root / "main.prm")
      << "set Bodies = a\ninclude material.prm\n";
    std::ofstream(root / "material.prm")
      << "subsection Body a\n  set Degree = 3\nend\n";
    const auto check = [&](const std::string &directory) {
      check_output_directory(
        parse_parameters(scene, "a.prm", {"Output/Directory=" + directory}),
        MPI_COMM_SELF);
    };
    check_message("a directory that can be made",
                  [&] { check((root / "new/newer").string()); },
                  {"(no error)"});
    verdict(!fs::exists(root / "new"), "the check makes no directory");
    check_message("a directory below a file",
                  [&] { check((root / "file/new").string()); },
                  {"Output/Directory (--set", "file/new", "not a directory"});
    check_message("a directory that is a file",
                  [&] { check((root / "file").string()); },
                  {"not a directory"});
    check_message("a directory below a dangling link",
                  [&] { check((root / "link/new").string()); },
                  {"link to nothing"});
    const std::string main = (root / "main.prm").string();
    const Parameters  p =
      read_parameters(main, {"Body a/Mesh/Refinements=2"}, MPI_COMM_WORLD);
    verdict(p.bodies[0].degree == 3 && p.bodies[0].mesh.refinements == 2,
            "a file with an included file beside it");
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_values();
  test_defaults();
  test_settings();
  test_directory();
  return 0;
}
