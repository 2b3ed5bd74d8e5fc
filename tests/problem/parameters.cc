// Proves that parameter files are read as written, that every wrong one gives one message with
// what, where, what was got and what is allowed or nearest, and that --set reaches everything.
#include <mortise/base/error.h>
#include <mortise/problem/parameter_file.h>
#include <mortise/problem/parameter_schema.h>
#include <mortise/problem/parameters.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

using namespace mortise;

namespace
{
  void
  verdict(const bool fine, const std::string &what, const std::string &got = "")
  {
    std::cout << (fine ? "OK  " : "FAILED ") << what;
    if (!fine)
      std::cout << ": got: " << got;
    std::cout << std::endl;
  }

  std::string
  message_of(const std::function<void()> &action)
  {
    try
      {
        action();
        return "(no error)";
      }
    catch (const InputError &e)
      {
        return e.what();
      }
  }

  /// The message of @p action contains all @p parts.
  void
  check_message(const std::string              &what,
                const std::function<void()>    &action,
                const std::vector<std::string> &parts)
  {
    const std::string message = message_of(action);
    for (const std::string &part : parts)
      if (message.find(part) == std::string::npos)
        return verdict(false, what, "\"" + message + "\" without \"" + part + "\"");
    verdict(true, what);
  }

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
  std::string
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
  void
  check_edit(const std::string              &what,
             const std::string              &from,
             const std::string              &to,
             const std::vector<std::string> &parts)
  {
    check_message(what, [&] { validate(parse_parameters(edited(from, to), "a.prm")); }, parts);
  }

  /// The same with a setting of the command line.
  void
  check_setting(const std::string              &what,
                const std::string              &setting,
                const std::vector<std::string> &parts)
  {
    check_message(what, [&] { validate(parse_parameters(scene, "a.prm", {setting})); }, parts);
  }

  void
  test_values()
  {
    const Parameters p = parse_parameters(scene, "dir/two_cubes.prm");
    validate(p);
    const BodyParameters &inner = p.bodies[0], &outer = p.bodies[1];
    verdict(p.title == "Two cubes = one" && p.file == "dir/two_cubes.prm", "title and file", p.title);
    verdict(p.bodies.size() == 2 && inner.name == "inner" && outer.name == "outer", "bodies");
    verdict(inner.degree == 2 && outer.degree == 1, "degree, given and default");
    verdict(inner.degree_by_region == std::map<unsigned int, unsigned int>{{3, 4}, {5, 1}},
            "degree by region");
    verdict(inner.mesh.source == "shell octant" && inner.mesh.extent == std::vector<double>{1, 1.5} &&
              inner.mesh.subdivisions == std::vector<unsigned int>{4, 2} && inner.mesh.rotate[2] == 30.,
            "mesh");
    verdict(outer.mesh.extent == std::vector<double>{1.5, 2}, "a continued line");
    verdict(inner.material.young_modulus == 10. && outer.material.young_modulus == 1., "material");
    verdict(inner.body_force == Components{{"0", "pow(x, 2)", "max(y, z)"}} && !outer.body_force,
            "body force, given and auto");
    const BoundaryParameters &inside = inner.boundaries.at("inside");
    verdict(inside.pressure == "1 + x" && inside.traction == Components{{"exact", "exact", "exact"}} &&
              !inside.displacement,
            "pressure and traction");
    verdict(inner.boundaries.at("xmin").displacement == Components{{"0", "-", "pow(x, 2)"}},
            "displacement with commas within and between");
    verdict(p.interfaces.size() == 1 && p.interfaces[0].slave.body == 0 &&
              p.interfaces[0].slave.boundary == "outside" && p.interfaces[0].master.body == 1,
            "interface");
    verdict(p.exact_solution.kind == ExactKind::thick_sphere, "exact solution");
    verdict(p.solver.method == SolverMethod::saddle_point && p.solver.tolerance == 1e-10, "solver");
    verdict(p.output.directory == "results/two_cubes", "default directory", p.output.directory);
    verdict(p.output.points.size() == 2 && p.output.points[1].name == "other" &&
              p.output.points[1].point == dealii::Point<3>(0, 1, 0) && p.output.points[0].body == 1,
            "points");
    verdict(p.output.resultants.size() == 1 && p.output.resultants[0].boundary == "inside",
            "resultants");
    verdict(p.where("Body inner/Degree") == "Body inner / Degree (line 6 of dir/two_cubes.prm)",
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
                       {"Interface NAME/Slave=NAME: a", "Interface NAME/Master=NAME: b"});
    const BodyParameters     &a = p.bodies[0], b, &c = q.bodies[0];
    const InterfaceParameters d;
    verdict(a.degree == b.degree && a.degree_by_region.empty() && !a.body_force,
            "printed defaults of a body are those of the struct");
    verdict(a.mesh.source == b.mesh.source && a.mesh.rotate == b.mesh.rotate &&
              a.mesh.half == b.mesh.half && a.mesh.surface == b.mesh.surface &&
              a.mesh.middle == b.mesh.middle && a.mesh.amplitude == b.mesh.amplitude,
            "printed defaults of a mesh are those of the struct");
    verdict(a.material.young_modulus == b.material.young_modulus &&
              a.material.poisson_ratio == b.material.poisson_ratio && a.material.law == b.material.law,
            "printed defaults of a material are those of the struct");
    verdict(!a.boundaries.at("NAME").pressure && !a.boundaries.at("NAME").traction &&
              !a.boundaries.at("NAME").displacement,
            "printed defaults of a boundary leave it free");
    verdict(p.interfaces[0].law == d.law && p.interfaces[0].search_distance == d.search_distance &&
              p.interfaces[0].quadrature_points == d.quadrature_points,
            "printed defaults of an interface are those of the struct");
    verdict(p.solver.method == SolverParameters().method &&
              p.solver.tolerance == SolverParameters().tolerance &&
              p.solver.max_iterations == SolverParameters().max_iterations,
            "printed defaults of the solver are those of the struct");
    verdict(p.output.fields.empty() && p.exact_solution.kind == ExactKind::none,
            "printed defaults ask for no fields and no errors");
    verdict(a.mesh.source == c.mesh.source && q.origins.count("Body NAME/Degree") == 0,
            "an absent subsection has the defaults");
    const std::string all = parameter_reference();
    unsigned int      n = 0, found = 0;
    for (const auto &declaration : declare_parameters({{"NAME"}, {{"NAME"}}, {"NAME"}}))
      {
        ++n;
        found += all.find("set " + declaration.name + " =") != std::string::npos;
      }
    verdict(n == found && n > 40, "every parameter is printed");
  }

  void
  test_syntax()
  {
    check_edit("a missing end", "  set Slave  = inner: outside\n", "subsection x\n  set Slave = inner: outside\n",
               {"subsection \"Interface glue\"", "\"end\" is missing", "a.prm"});
    check_edit("an end too many", "subsection Solver", "end\nsubsection Solver",
               {"\"end\" without an open subsection", "line"});
    check_edit("an unknown keyword", "set Bodies ", "sett Bodies ",
               {"line 3 of a.prm", "sett Bodies", "set NAME = VALUE", "did you mean \"set\""});
    check_edit("a set without =", "set Degree = 2", "set Degree 2", {"line 6 of a.prm", "set NAME = VALUE"});
    check_edit("a subsection without a name", "subsection Solver", "subsection",
               {"a subsection needs a name"});
    check_message("an included file that is missing",
                  [] { parse_parameters("set Bodies = a\ninclude missing_file.prm\n", "a.prm"); },
                  {"missing_file.prm", "included at line 2 of a.prm", "No such file"});
    check_message("an included directory",
                  [] { parse_parameters("include .\n", "a.prm"); },
                  {"included at line 1 of a.prm", "directory"});
    check_message("a continued last line",
                  [] { parse_parameters("set Bodies = a \\\n", "a.prm"); },
                  {"line 1 of a.prm", "continues"});
    check_message("a missing file",
                  [] { read_parameters("missing_file.prm", {}, MPI_COMM_SELF); },
                  {"missing_file.prm", "cannot be read", "No such file"});
    check_message("a directory instead of a file",
                  [] { read_parameters(".", {}, MPI_COMM_SELF); },
                  {"\".\"", "directory", "name of a file is needed"});
    check_message("an empty file", [] { parse_parameters("", "a.prm"); }, {"Bodies", "a.prm", "at least one"});
  }

  void
  test_names()
  {
    check_edit("a misspelled parameter", "set Degree =", "set Degre =",
               {"unknown parameter \"Degre\" in \"Body inner\"", "line 6 of a.prm",
                "did you mean \"Degree\"", "Body force"});
    check_edit("a misspelled top parameter", "set Title", "set Titel",
               {"unknown parameter \"Titel\"", "line 2", "did you mean \"Title\""});
    check_edit("a parameter at the wrong level", "set Title      =", "set Poisson ratio =",
               {"unknown parameter \"Poisson ratio\"", "belongs into: Body inner/Material"});
    check_edit("a subsection of no body", "subsection Body outer", "subsection Body outr",
               {"unknown subsection \"Body outr\"", "line", "set Bodies = inner, outer",
                "did you mean \"Body outer\""});
    check_edit("a subsection of no interface", "subsection Interface glue", "subsection Interface glu",
               {"unknown subsection \"Interface glu\"", "set Interfaces = glue", "did you mean \"Interface glue\""});
    check_edit("a misspelled subsection", "subsection Material", "subsection Materiel",
               {"unknown subsection \"Materiel\" in \"Body inner\"", "did you mean \"Material\"", "Boundary NAME"});
    check_edit("a misspelled boundary subsection", "subsection Boundary inside", "subsection Boundry inside",
               {"unknown subsection \"Boundry inside\" in \"Body inner\"", "did you mean \"Boundary inside\"",
                "Boundary NAME"});
    check_edit("a misspelled top subsection", "subsection Solver", "subsection Solvr",
               {"unknown subsection \"Solvr\"", "did you mean \"Solver\"", "Output"});
    check_edit("two bodies of one name", "inner, outer", "inner, inner",
               {"Bodies (line 3 of a.prm)", "\"inner\"", "twice"});
    check_edit("no bodies", "inner, outer", "", {"Bodies", "at least one"});
    check_edit("a body without a name", "inner, outer", "inner,, outer", {"Bodies (line 3 of a.prm)", "not empty"});
    check_edit("a body with a colon", "inner, outer", "in:ner, outer", {"in:ner", "none of"});
    check_edit("a slave of no body", "inner: outside", "iner: outside",
               {"Interface glue / Slave (line 36 of a.prm)", "no body \"iner\"", "did you mean \"inner\"",
                "inner, outer"});
    check_edit("an interface without master", "  set Master = outer: inside\n", "",
               {"Interface glue / Master: got \"\"", "body: boundary"});
    check_edit("a side without boundary", "outer: inside", "outer",
               {"Interface glue / Master", "\"outer\"", "body: boundary"});
    const std::vector<std::vector<std::string>> names = {{"inside", "outside", "xmin"},
                                                         {"inside", "outside"}};
    check_message("all boundaries exist",
                  [&] { check_boundary_names(parse_parameters(scene, "a.prm"), names); },
                  {"(no error)"});
    check_message("a boundary subsection of no boundary",
                  [&] { check_boundary_names(parse_parameters(edited("Boundary inside", "Boundary insid"), "a.prm"), names); },
                  {"Body inner / Boundary insid (line 19 of a.prm)", "\"inner\"", "no boundary \"insid\"",
                   "did you mean \"inside\"", "inside, outside, xmin"});
    check_message("a master that is no boundary",
                  [&] { check_boundary_names(parse_parameters(edited("outer: inside", "outer: inner"), "a.prm"), names); },
                  {"Interface glue / Master", "no boundary \"inner\"", "inside, outside"});
    check_message("a resultant on no boundary",
                  [&] { check_boundary_names(parse_parameters(edited("push: inner: inside", "push: outer: xmin"), "a.prm"), names); },
                  {"Output / Resultants", "no boundary \"xmin\"", "inside, outside"});
  }

  void
  test_types()
  {
    check_edit("a word for a number", "Young modulus = 10", "Young modulus = stiff",
               {"Body inner/Material/Young modulus (line 15 of a.prm)", "got \"stiff\"", "positive number"});
    check_edit("a word for an integer", "Degree = 2", "Degree = two",
               {"Body inner/Degree (line 6 of a.prm)", "got \"two\"", "integer from 1 to 8"});
    check_edit("a number for an integer", "Degree = 2", "Degree = 2.5", {"got \"2.5\"", "integer from 1 to 8"});
    check_edit("an unknown choice", "Method    = saddle point", "Method = sadle point",
               {"Solver/Method", "got \"sadle point\"", "did you mean \"saddle point\"", "direct"});
    check_edit("an unknown generator", "shell octant", "shell octand",
               {"Body inner/Mesh/Source (line 9", "did you mean \"shell octant\"", "cylinder sector"});
    check_edit("a list of words", "Subdivisions = 4, 2", "Subdivisions = 4, two",
               {"Subdivisions", "got \"4, two\"", "integers"});
    check_edit("two angles", "0, 0, 30", "0, 30", {"Rotate", "got \"0, 30\"", "3 numbers"});
    check_edit("two components", "Traction     = exact", "Traction = 1; 2",
               {"Body inner / Boundary inside / Traction (line 21", "got \"1; 2\"", "2 components, not 3"});
    check_edit("an expression that does not parse", "Pressure     = 1 + x", "Pressure = 1 + q",
               {"Body inner / Boundary inside / Pressure (line 20 of a.prm)", "q"});
    check_edit("a component that does not parse", "0, -, pow(x, 2)", "0, -, pow(x, 2",
               {"Boundary xmin / Displacement (line 24 of a.prm)"});
    check_edit("an empty component", "0, -, pow(x, 2)", "0, , 1",
               {"Displacement (line 24", "component y", "- (free)"});
    check_edit("a free traction", "Traction     = exact", "Traction = -, 0, 0", {"Traction", "\"-\"", "expression"});
    check_edit("a body force of one number", "0; pow(x, 2); max(y, z)", "1",
               {"Body inner / Body force", "got \"1\"", "auto"});
    check_edit("exact without an exact solution", "Displacement = thick sphere", "Displacement =",
               {"Boundary inside / Traction", "\"exact\"", "Exact solution / Displacement"});
    check_edit("a misspelled exact solution", "= thick sphere", "= thick spere",
               {"Exact solution / Displacement", "thick spere", "did you mean \"thick sphere\""});
    check_edit("an exact solution that does not parse", "= thick sphere", "= x; y; foo(z)",
               {"Exact solution / Displacement", "component z", "foo"});
    check_edit("a region without degree", "3: 4; 5: 1", "3: 4; 5", {"Degree by region", "got \"5\"", "material id"});
    check_edit("a region twice", "3: 4; 5: 1", "3: 4; 3: 1", {"Degree by region", "only once"});
    check_edit("a point of no body", "corner: outer:", "corner: outr:",
               {"Output / Points", "no body \"outr\"", "did you mean \"outer\""});
    check_edit("a point with two coordinates", "2, 0, 0;", "2, 0;", {"Output / Points", "got \"2, 0\"", "x, y, z"});
    check_edit("a resultant without boundary", "push: inner: inside", "push: inner",
               {"Output / Resultants", "name: body: boundary"});
    check_edit("an unknown field", "displacement, traction", "displacement, tractions",
               {"Output / Fields", "got \"tractions\"", "did you mean \"traction\"", "stress"});
    check_edit("two quantities of one name", "push: inner", "corner: inner", {"Output / Resultants", "\"corner\"", "differ"});
  }

  void
  test_ranges()
  {
    check_edit("degree 9", "Degree = 2", "Degree = 9", {"Degree (line 6 of a.prm)", "got \"9\"", "from 1 to 8"});
    check_edit("degree 9 in a region", "3: 4", "3: 9", {"Degree by region (line 7", "degree 9", "from 1 to 8"});
    check_edit("a negative Young's modulus", "Young modulus = 10", "Young modulus = -10",
               {"Body inner / Material / Young modulus (line 15", "got -10", "positive"});
    check_edit("Poisson's ratio 0.5", "ratio = 0.25", "ratio = 0.5",
               {"Body inner / Material / Poisson ratio (line 16", "got 0.5", "below 0.5", "not available yet"});
    check_edit("Poisson's ratio -1", "ratio = 0.25", "ratio = -1", {"Poisson ratio", "got -1", "above -1"});
    check_setting("tolerance 1", "Solver/Tolerance=1", {"Solver / Tolerance (--set", "got 1", "between 0 and 1"});
    check_setting("tolerance 0", "Solver/Tolerance=0", {"Solver / Tolerance", "got 0"});
    check_setting("no iterations", "Solver/Max iterations=0", {"Max iterations", "got \"0\"", "1 or more"});
    check_setting("negative refinements", "Body inner/Mesh/Refinements=-1", {"Refinements", "got \"-1\"", "0 or more"});
    check_setting("tetrahedra", "Body inner/Mesh/Cells=tetrahedra",
                  {"Body inner / Mesh / Cells", "not available yet", "hexahedra"});
    check_setting("radii in the wrong order", "Body inner/Mesh/Extent=2, 1", {"Body inner / Mesh", "Extent", "r_in < r_out"});
    check_setting("a mesh file that is missing", "Body inner/Mesh/Source=file", {"Body inner / Mesh (line 8 of a.prm)", "file"});
    check_edit("slave and master the same", "outer: inside", "inner: outside",
               {"Interface glue / Master (line 37", "inner: outside", "which is the slave"});
    check_edit("a slave with a displacement", "inner: outside", "inner: xmin",
               {"Interface glue / Slave (line 36", "prescribed displacement", "exchange slave and master"});
    check_setting("a law that does not exist", "Interface glue/Law=glue", {"Interface glue/Law", "got \"glue\"", "tie"});
    check_setting("search distance 0", "Interface glue/Search distance=0", {"Search distance", "got 0", "positive"});
    check_setting("no quadrature points", "Interface glue/Quadrature points=0", {"Quadrature points", "got \"0\"", "auto"});
    check_message("two interfaces between the same boundaries",
                  [] {
                    validate(parse_parameters(edited("= glue\n", "= glue, tape\n"),
                                              "a.prm",
                                              {"Interface tape/Slave=outer: inside",
                                               "Interface tape/Master=inner: outside"}));
                  },
                  {"Interface tape / Slave", "interface glue", "once"});
    check_message("two interfaces of one body with itself",
                  [] {
                    validate(parse_parameters(scene, "a.prm", {"Interface glue/Master=inner: inside"}));
                  },
                  {"(no error)"});
  }

  void
  test_settings()
  {
    const Parameters p =
      parse_parameters(scene,
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
    verdict(p.bodies[0].mesh.subdivisions == std::vector<unsigned int>{8, 4}, "--set replaces the file's value");
    verdict(p.solver.method == SolverMethod::direct, "--set of a choice");
    verdict(p.bodies[1].boundaries.at("outside").pressure == "2", "--set makes a boundary subsection");
    verdict(p.bodies[1].degree == 4, "the last --set wins");
    verdict(p.output.directory == "some/where", "--set of the directory");
    verdict(p.bodies[0].boundaries.at("xmin").displacement == Components{{"-", "exact", "if(x < 0, 1, 2)"}},
            "--set of a displacement");
    check_setting("--set of an unknown parameter", "Body inner/Degre=3",
                  {"--set \"Body inner/Degre=3\"", "did you mean \"Degree\""});
    check_setting("--set in an unknown subsection", "Body iner/Degree=3",
                  {"--set \"Body iner/Degree=3\"", "did you mean \"Body inner\""});
    check_setting("--set of a subsection", "Body inner/Mesh=3", {"unknown parameter \"Mesh\"", "is a subsection"});
    check_setting("--set without a value", "Body inner/Degree", {"--set \"Body inner/Degree\"", "NAME=VALUE"});
    check_setting("--set without a name", "=3", {"--set \"=3\"", "NAME=VALUE"});
    check_setting("--set with an empty section", "Body inner//Degree=3", {"NAME=VALUE"});
    unsigned int n = 0, found = 0; // every parameter of the scene by its own path
    for (const auto &declaration : declare_parameters({{"inner", "outer"}, {{"inside", "xmin"}, {}}, {"glue"}}))
      {
        if (declaration.name == "Bodies" || declaration.name == "Interfaces")
          continue; // they make subsections
        std::string path;
        for (const std::string &section : declaration.sections)
          path += section + "/";
        path += declaration.name;
        const std::string message =
          message_of([&] { parse_parameters(scene, "a.prm", {path + "=\x01"}); });
        ++n;
        const bool known = message.find("unknown") == std::string::npos;
        if (!known)
          verdict(false, path, message);
        found += known;
      }
    verdict(n == found && n > 60, "--set reaches every parameter of a subsection");
    const Parameters q =
      parse_parameters("", "a.prm", {"Bodies=b", "Body b/Degree=3", "Interfaces=", "Title=none"});
    verdict(q.bodies.size() == 1 && q.bodies[0].degree == 3, "--set makes a scene without a file");
  }

  void
  test_directory()
  {
    namespace fs = std::filesystem;
    const fs::path root = fs::temp_directory_path() / ("mortise_parameters_" + std::to_string(getpid()));
    fs::create_directory(root);
    std::ofstream(root / "file") << "text";
    fs::create_symlink("nothing", root / "link");
    std::ofstream(root / "main.prm") << "set Bodies = a\ninclude material.prm\n";
    std::ofstream(root / "material.prm") << "subsection Body a\n  set Degree = 3\nend\n";
    const auto check = [&](const std::string &directory) {
      check_output_directory(parse_parameters(scene, "a.prm", {"Output/Directory=" + directory}), MPI_COMM_SELF);
    };
    check_message("a directory that can be made", [&] { check((root / "new/newer").string()); }, {"(no error)"});
    verdict(!fs::exists(root / "new"), "the check makes no directory");
    check_message("a directory below a file",
                  [&] { check((root / "file/new").string()); },
                  {"Output / Directory (--set", "file/new", "not a directory"});
    check_message("a directory that is a file", [&] { check((root / "file").string()); }, {"not a directory"});
    check_message("a directory below a dangling link", [&] { check((root / "link/new").string()); }, {"link to nothing"});
    const std::string  main = (root / "main.prm").string();
    const Parameters p    = read_parameters(main, {"Body a/Mesh/Refinements=2"}, MPI_COMM_WORLD);
    verdict(p.bodies[0].degree == 3 && p.bodies[0].mesh.refinements == 2,
            "a file with an included file beside it");
    fs::remove_all(root);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_values();
  test_defaults();
  test_syntax();
  test_names();
  test_types();
  test_ranges();
  test_settings();
  test_directory();
  return 0;
}
