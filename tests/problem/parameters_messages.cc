// Proves that every kind of wrong parameter file gives one message with what,
// where, what was got and what is allowed or nearest.
#include <deal.II/base/mpi.h>

#include "parameter_checks.h"

using namespace parameter_checks;

namespace
{
  void
  test_syntax()
  {
    check_edit("a missing end",
               "  set Slave  = inner: outside\n",
               "subsection x\n  set Slave = inner: outside\n",
               {"subsection \"Interface glue\"",
                "\"end\" is missing",
                "a.prm"});
    check_edit("an end too many",
               "subsection Solver",
               "end\nsubsection Solver",
               {"\"end\" without an open subsection", "line"});
    check_edit("an unknown keyword",
               "set Bodies ",
               "sett Bodies ",
               {"line 3 of a.prm",
                "sett Bodies",
                "set NAME = VALUE",
                "did you mean \"set\""});
    check_edit("a set without =",
               "set Degree = 2",
               "set Degree 2",
               {"line 6 of a.prm", "set NAME = VALUE"});
    check_edit("a subsection without a name",
               "subsection Solver",
               "subsection",
               {"a subsection needs a name"});
    check_message(
      "an included file that is missing",
      [] {
        parse_parameters("set Bodies = a\ninclude missing_file.prm\n", "a.prm");
      },
      {"missing_file.prm", "included at line 2 of a.prm", "No such file"});
    check_message("an included directory",
                  [] { parse_parameters("include .\n", "a.prm"); },
                  {"included at line 1 of a.prm", "directory"});
    check_message("a continued last line",
                  [] { parse_parameters("set Bodies = a \\\n", "a.prm"); },
                  {"line 1 of a.prm", "continues"});
    check_message("a missing file",
                  [] {
                    read_parameters("missing_file.prm", {}, MPI_COMM_SELF);
                  },
                  {"missing_file.prm", "cannot be read", "No such file"});
    check_message("a directory instead of a file",
                  [] { read_parameters(".", {}, MPI_COMM_SELF); },
                  {"\".\"", "directory", "name of a file is needed"});
    check_message("an empty file",
                  [] { parse_parameters("", "a.prm"); },
                  {"Bodies", "a.prm", "at least one"});
  }

  void
  test_names()
  {
    check_edit("a misspelled parameter",
               "set Degree =",
               "set Degre =",
               {"unknown parameter \"Degre\" in \"Body inner\"",
                "line 6 of a.prm",
                "did you mean \"Degree\"",
                "Body force"});
    check_edit("a misspelled top parameter",
               "set Title",
               "set Titel",
               {"unknown parameter \"Titel\"",
                "line 2",
                "did you mean \"Title\""});
    check_edit("a parameter at the wrong level",
               "set Title      =",
               "set Poisson ratio =",
               {"unknown parameter \"Poisson ratio\"",
                "belongs into: Body inner/Material"});
    check_edit("a subsection of no body",
               "subsection Body outer",
               "subsection Body outr",
               {"unknown subsection \"Body outr\"",
                "line",
                "set Bodies = inner, outer",
                "did you mean \"Body outer\""});
    check_edit("a subsection of no interface",
               "subsection Interface glue",
               "subsection Interface glu",
               {"unknown subsection \"Interface glu\"",
                "set Interfaces = glue",
                "did you mean \"Interface glue\""});
    check_edit("a misspelled subsection",
               "subsection Material",
               "subsection Materiel",
               {"unknown subsection \"Materiel\" in \"Body inner\"",
                "did you mean \"Material\"",
                "Boundary NAME"});
    check_edit("a misspelled boundary subsection",
               "subsection Boundary inside",
               "subsection Boundry inside",
               {"unknown subsection \"Boundry inside\" in \"Body inner\"",
                "did you mean \"Boundary inside\"",
                "Boundary NAME"});
    check_edit("a misspelled top subsection",
               "subsection Solver",
               "subsection Solvr",
               {"unknown subsection \"Solvr\"",
                "did you mean \"Solver\"",
                "Output"});
    check_edit("two bodies of one name",
               "inner, outer",
               "inner, inner",
               {"Bodies (line 3 of a.prm)", "\"inner\"", "twice"});
    check_edit("no bodies", "inner, outer", "", {"Bodies", "at least one"});
    check_edit("a body without a name",
               "inner, outer",
               "inner,, outer",
               {"Bodies (line 3 of a.prm)", "not empty"});
    check_edit("a body with a colon",
               "inner, outer",
               "in:ner, outer",
               {"in:ner", "none of"});
    check_edit("a slave of no body",
               "inner: outside",
               "iner: outside",
               {"Interface glue/Slave (line 41 of a.prm)",
                "no body \"iner\"",
                "did you mean \"inner\"",
                "inner, outer"});
    check_edit("an interface without master",
               "  set Master = outer: inside\n",
               "",
               {"Interface glue/Master: got \"\"", "body: boundary"});
    check_edit("a side without boundary",
               "outer: inside",
               "outer",
               {"Interface glue/Master", "\"outer\"", "body: boundary"});
    const mortise::NamesOfBoundaries names = {
      {{"inside", "outside", "xmin", "zmin"}}, {{"inside", "outside"}}};
    check_message("all boundaries exist",
                  [&] {
                    check_boundary_names(parse_parameters(scene, "a.prm"),
                                         names);
                  },
                  {"(no error)"});
    check_message("a boundary subsection of no boundary",
                  [&] {
                    check_boundary_names(
                      parse_parameters(
                        edited("Boundary inside", "Boundary insid"), "a.prm"),
                      names);
                  },
                  {"Body inner/Boundary insid (line 19 of a.prm)",
                   "\"inner\"",
                   "no boundary \"insid\"",
                   "did you mean \"inside\"",
                   "inside, outside, xmin, zmin"});
    check_message(
      "a boundary subsection of no boundary, by --set",
      [&] {
        check_boundary_names(
          parse_parameters(scene,
                           "a.prm",
                           {"Body inner/Boundary insid/Pressure=1"}),
          names);
      },
      {"Body inner/Boundary insid (--set \"Body inner/Boundary insid/Pressure=1\")",
       "no boundary \"insid\""});
    check_message(
      "a master that is no boundary",
      [&] {
        check_boundary_names(
          parse_parameters(edited("outer: inside", "outer: inner"), "a.prm"),
          names);
      },
      {"Interface glue/Master", "no boundary \"inner\"", "inside, outside"});
    check_message(
      "a resultant on no boundary",
      [&] {
        check_boundary_names(parse_parameters(edited("push: inner: inside",
                                                     "push: outer: xmin"),
                                              "a.prm"),
                             names);
      },
      {"Output/Resultants", "no boundary \"xmin\"", "inside, outside"});
  }

  void
  test_types()
  {
    check_edit("a word for a number",
               "Young modulus = 10",
               "Young modulus = stiff",
               {"Body inner/Material/Young modulus (line 15 of a.prm)",
                "got \"stiff\"",
                "positive number"});
    check_edit("a word for an integer",
               "Degree = 2",
               "Degree = two",
               {"Body inner/Degree (line 6 of a.prm)",
                "got \"two\"",
                "integer from 1 to 8"});
    check_edit("a number for an integer",
               "Degree = 2",
               "Degree = 2.5",
               {"got \"2.5\"", "integer from 1 to 8"});
    check_edit("an unknown choice",
               "Method    = saddle point",
               "Method = sadle point",
               {"Solver/Method",
                "got \"sadle point\"",
                "did you mean \"saddle point\"",
                "direct"});
    check_edit("an unknown generator",
               "shell octant",
               "shell octand",
               {"Body inner/Mesh/Source (line 9",
                "did you mean \"shell octant\"",
                "cylinder sector"});
    check_edit("a list of words",
               "Subdivisions = 4, 2",
               "Subdivisions = 4, two",
               {"Subdivisions", "got \"4, two\"", "integers"});
    check_edit("two angles",
               "0, 0, 30",
               "0, 30",
               {"Rotate", "got \"0, 30\"", "3 numbers"});
    check_edit("two components",
               "Traction     = exact",
               "Traction = 1; 2",
               {"Body inner/Boundary zmin/Traction (line 23",
                "got \"1; 2\"",
                "2 components, not 3"});
    check_edit("an expression that does not parse",
               "Pressure     = 1 + x",
               "Pressure = 1 + q",
               {"Body inner/Boundary inside/Pressure (line 20 of a.prm)", "q"});
    check_edit("a component that does not parse",
               "0, -, pow(x, 2)",
               "0, -, pow(x, 2",
               {"Boundary xmin/Displacement (line 26 of a.prm)"});
    check_edit("an empty component",
               "0, -, pow(x, 2)",
               "0, , 1",
               {"Displacement (line 26", "component y", "- (free)"});
    check_edit("a free traction",
               "Traction     = exact",
               "Traction = -, 0, 0",
               {"Traction", "\"-\"", "expression"});
    check_edit("a body force of one number",
               "0; pow(x, 2); max(y, z)",
               "1",
               {"Body inner/Body force", "got \"1\"", "auto"});
    check_edit("exact without an exact solution",
               "Displacement = thick sphere",
               "Displacement =",
               {"Boundary zmin/Traction",
                "\"exact\"",
                "Exact solution/Displacement"});
    check_edit("an exact pressure with a solution that follows from it",
               "Pressure     = 1 + x",
               "Pressure = exact",
               {"Boundary inside/Pressure", "\"exact\"", "constant Pressure"});
    check_setting("a traction with a solution that follows from the pressure",
                  "Body inner/Boundary inside/Traction=exact",
                  {"Boundary inside/Traction", "constant Pressure"});
    check_edit("a misspelled exact solution",
               "= thick sphere",
               "= thick spere",
               {"Exact solution/Displacement",
                "thick spere",
                "did you mean \"thick sphere\""});
    check_edit("an exact solution that does not parse",
               "= thick sphere",
               "= x; y; foo(z)",
               {"Exact solution/Displacement", "component z", "foo"});
    check_edit("a region without degree",
               "3: 4; 5: 1",
               "3: 4; 5",
               {"Degree by region", "got \"5\"", "material id"});
    check_edit("a region twice",
               "3: 4; 5: 1",
               "3: 4; 3: 1",
               {"Degree by region", "only once"});
    check_edit("a point of no body",
               "corner: outer:",
               "corner: outr:",
               {"Output/Points", "no body \"outr\"", "did you mean \"outer\""});
    check_edit("a point with two coordinates",
               "2, 0, 0;",
               "2, 0;",
               {"Output/Points", "got \"2, 0\"", "x, y, z"});
    check_edit("a resultant without boundary",
               "push: inner: inside",
               "push: inner",
               {"Output/Resultants", "name: body: boundary"});
    check_edit("an unknown field",
               "displacement, traction",
               "displacement, tractions",
               {"Output/Fields",
                "got \"tractions\"",
                "did you mean \"traction\"",
                "stress"});
    check_edit("two quantities of one name",
               "push: inner",
               "corner: inner",
               {"Output/Resultants", "\"corner\"", "differ"});
  }

  void
  test_ranges()
  {
    check_edit("degree 9",
               "Degree = 2",
               "Degree = 9",
               {"Degree (line 6 of a.prm)", "got \"9\"", "from 1 to 8"});
    check_edit("degree 9 in a region",
               "3: 4",
               "3: 9",
               {"Degree by region (line 7", "degree 9", "from 1 to 8"});
    check_edit(
      "no Young's modulus",
      "set Young modulus = 10",
      "",
      {"Body inner/Material/Young modulus: got nothing with Law = linear elastic",
       "allowed: a positive number (force per area)"});
    check_edit("a negative Young's modulus",
               "Young modulus = 10",
               "Young modulus = -10",
               {"Body inner/Material/Young modulus (line 15",
                "got -10",
                "positive"});
    check_edit("Poisson's ratio 0.6",
               "ratio = 0.25",
               "ratio = 0.6",
               {"Body inner/Material/Poisson ratio (line 16",
                "got 0.6",
                "not above 0.5"});
    check_edit("Poisson's ratio -1",
               "ratio = 0.25",
               "ratio = -1",
               {"Poisson ratio", "got -1", "above -1"});
    check_setting("tolerance 1",
                  "Solver/Tolerance=1",
                  {"Solver/Tolerance (--set", "got 1", "between 0 and 1"});
    check_setting("tolerance 0",
                  "Solver/Tolerance=0",
                  {"Solver/Tolerance", "got 0"});
    check_setting("no iterations",
                  "Solver/Max iterations=0",
                  {"Max iterations", "got \"0\"", "1 or more"});
    check_setting("negative refinements",
                  "Body inner/Mesh/Refinements=-1",
                  {"Refinements", "got \"-1\"", "0 or more"});
    check_setting("cells that do not exist",
                  "Body inner/Mesh/Cells=tetrahedrons",
                  {"Body inner/Mesh/Cells", "tetrahedrons", "hexahedra"});
    check_setting("radii in the wrong order",
                  "Body inner/Mesh/Extent=2, 1",
                  {"Body inner/Mesh", "Extent", "r_in < r_out"});
    check_setting("a mesh file that is missing",
                  "Body inner/Mesh/Source=file",
                  {"Body inner/Mesh (line 8 of a.prm)", "file"});
    check_edit("slave and master the same",
               "outer: inside",
               "inner: outside",
               {"Interface glue/Master (line 42",
                "inner: outside",
                "which is on the slave's side"});
    check_edit("a slave with a displacement",
               "inner: outside",
               "inner: xmin",
               {"Interface glue/Slave (line 41",
                "prescribed displacement",
                "exchange slave and master"});
    check_setting("a law that does not exist",
                  "Interface glue/Law=glue",
                  {"Interface glue/Law", "got \"glue\"", "tie"});
    check_setting("search distance 0",
                  "Interface glue/Search distance=0",
                  {"Search distance", "got \"0\"", "positive"});
    check_setting("no quadrature points",
                  "Interface glue/Quadrature points=0",
                  {"Quadrature points", "got \"0\"", "auto"});
    check_message(
      "two interfaces between the same boundaries",
      [] {
        validate(parse_parameters(edited("= glue\n", "= glue, tape\n"),
                                  "a.prm",
                                  {"Interface tape/Slave=outer: inside",
                                   "Interface tape/Master=inner: outside"}));
      },
      {"Interface tape/Slave", "interface glue", "once"});
    check_setting("an interface of one body with itself",
                  "Interface glue/Master=inner: inside",
                  {"(no error)"});
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_syntax();
  test_names();
  test_types();
  test_ranges();
  return 0;
}
