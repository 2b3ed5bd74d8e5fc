// Proves that numbers that a run could not compute with are refused, with what
// was got and what is allowed, and that messages stay short whatever they
// quote.
#include <deal.II/base/mpi.h>

#include "parameter_checks.h"

using namespace parameter_checks;

namespace
{
  const std::string small = "which is too small",
                    range = "allowed: 0, or from 1e-100 to 1e+100 in magnitude",
                    lengths = "from 1e-15 to 1e+15",
                    moduli  = "from 1e-20 to 1e+20";

  void
  test_too_small()
  {
    for (const std::string number : {"1e-400", "1e-310", "-1e-310", "1e-101"})
      {
        check_setting(
          "tolerance " + number,
          "Solver/Tolerance=" + number,
          {"Solver/Tolerance (--set", "got \"" + number + "\"", small, range});
        check_setting("a rotation by " + number,
                      "Body inner/Mesh/Rotate=0, 0, " + number,
                      {"Body inner/Mesh/Rotate (--set",
                       "got \"" + number + "\"",
                       small,
                       range});
        check_setting("a point at " + number,
                      "Output/Points=corner: outer: 2, " + number + ", 0",
                      {"Output/Points (--set", "got \"" + number, small});
        check_setting("a ball at " + number,
                      "Body inner/Mesh/Refine near=0, 0, " + number + ", 1, 1",
                      {"Body inner/Mesh", "Refine near", number});
        check_setting("a modulus of " + number,
                      "Body inner/Material/Young modulus=" + number,
                      {"Young modulus (--set", number, "allowed"});
      }
    for (const std::string number : {"1e-400", "1e-310"})
      for (const std::string &component : {number, "x + " + number})
        check_setting("a traction of " + component,
                      "Body inner/Boundary zmin/Traction=0; 0; " + component,
                      {"Boundary zmin/Traction (--set",
                       "component z",
                       "'" + number + "'",
                       "too small",
                       "2.2e-308"});
    check_setting("a traction of 1e-200",
                  "Body inner/Boundary zmin/Traction=0; 0; 1e-200",
                  {"Traction", "component z: got \"1e-200\"", range});
    check_setting("zero in many forms",
                  "Body inner/Mesh/Rotate=0.000e-400, -0, +0.",
                  {"(no error)"});
    check_setting("a part of an expression that is small",
                  "Body inner/Boundary zmin/Traction=0; 0; x/(y + 1e-200)",
                  {"(no error)"});
  }

  void
  test_too_large()
  {
    for (const std::string parameter :
         {"Traction", "Displacement", "Body force"})
      check_setting(parameter + " of 1e160",
                    (parameter == "Body force" ? "Body inner/" :
                                                 "Body inner/Boundary zmin/") +
                      parameter + "=0; -10^160; 0",
                    {parameter + " (--set",
                     "component y: got \"-10^160\", which is -1e+160",
                     range});
    check_setting("a pressure of 1e160",
                  "Body outer/Boundary outside/Pressure=1e160",
                  {"Boundary outside/Pressure (--set",
                   "got \"1e160\", which is 1e+160",
                   range});
    check_setting("a translation of 1e160",
                  "Body inner/Mesh/Translate=0, 1e160, 0",
                  {"Mesh/Translate (--set",
                   "got \"1e160\", which is too large",
                   range});
    check_setting("a translation of 1e40",
                  "Body inner/Mesh/Translate=0, 1e40, 0",
                  {"Body inner/Mesh", "Translate = 0, 1e+40, 0", "1e+15"});
    for (const std::string modulus : {"1e300", "1e-90", "1e21", "0"})
      check_setting("a modulus of " + modulus,
                    "Body inner/Material/Young modulus=" + modulus,
                    {"Body inner/Material/Young modulus (--set",
                     "got",
                     modulus == "1e300" ? range : moduli});
    check_setting("a modulus of 1e20",
                  "Body inner/Material/Young modulus=1e20",
                  {"(no error)"});
    check_setting("radii of 1e200",
                  "Body inner/Mesh/Extent=1e200, 2e200",
                  {"Body inner/Mesh/Extent (--set", "got \"1e200\"", range});
    check_setting("radii of 1e50",
                  "Body inner/Mesh/Extent=1e50, 2e50",
                  {"Body inner/Mesh", "Extent = 1e+50, 2e+50", "1e+15"});
    check_setting("radii of 1e-50",
                  "Body inner/Mesh/Extent=1e-50, 2e-50",
                  {"Body inner/Mesh", "Extent = 1e-50, 2e-50", lengths});
    check_setting("radii of 1e-14",
                  "Body inner/Mesh/Extent=1e-14, 2e-14",
                  {"(no error)"});
    for (const std::string number : {"inf", "nan", "1e400"})
      check_setting("an extent of " + number,
                    "Body inner/Mesh/Extent=1, " + number,
                    {"Body inner/Mesh/Extent (--set",
                     "got \"1, " + number + "\"",
                     "allowed: 2, 3 or 6 numbers"});
  }

  /// The message of @p action is short, and shows the start of what it got and
  /// how long that was.
  void
  check_short(const std::string           &what,
              const std::function<void()> &action,
              const std::string           &start)
  {
    const std::string message = message_of(action);
    verdict(message.size() < 1500 && message.find(start) != std::string::npos &&
              (message.find("...\" (") != std::string::npos ||
               message.find("...' (") != std::string::npos) &&
              message.find(" characters)") != std::string::npos,
            what,
            std::to_string(message.size()) + " characters, " +
              message.substr(0, 300));
  }

  void
  test_long_values()
  {
    const std::string ramble(100000, 'q');
    const auto        set = [&](const std::string &setting) {
      return
        [setting] { validate(parse_parameters(scene, "a.prm", {setting})); };
    };
    const std::vector<std::string> paths = {"Solver/Tolerance",
                                            "Solver/Method",
                                            "Body inner/Degree",
                                            "Body inner/Degree by region",
                                            "Body inner/Body force",
                                            "Body inner/Mesh/Extent",
                                            "Body inner/Mesh/Refine near",
                                            "Body inner/Boundary zmin/Traction",
                                            "Body inner/Boundary xmin/Pressure",
                                            "Interface glue/Slave",
                                            "Interface glue/Law",
                                            "Interface glue/Quadrature points",
                                            "Exact solution/Displacement",
                                            "Output/Fields",
                                            "Output/Points",
                                            "Bodies"};
    for (const std::string &path : paths)
      check_short("a long " + path, set(path + "=" + ramble), "qqqq");
    check_short("a long component",
                set("Body inner/Boundary zmin/Traction=0; 0; " + ramble),
                "component z");
    check_short("a long name of a body in an interface",
                set("Interface glue/Slave=" + ramble + ": outside"),
                "there is no body");
    check_short("a long setting without =", set(ramble), "--set \"qqqq");
    check_short("a long name of a parameter",
                set("Solver/" + ramble + "=1"),
                "at most 200 characters");
    check_short("a long name of a section",
                set(ramble + "/Tolerance=1"),
                "at most 200 characters");
    check_short(
      "a long line",
      [&] { parse_parameters("Set" + ramble, "a.prm"); },
      "line 1 of a.prm");
    check_short(
      "a long name in a file",
      [&] { parse_parameters("subsection " + ramble + "\nend\n", "a.prm"); },
      "line 1 of a.prm");
    check_message("a long name of a directory",
                  [&] {
                    check_output_directory(
                      parse_parameters(scene,
                                       "a.prm",
                                       {"Output/Directory=" + ramble}),
                      MPI_COMM_SELF);
                  },
                  {"Output/Directory (--set", "File name too long", "allowed"});
    const std::string message =
      message_of([&] { read_parameters(ramble + ".prm", {}, MPI_COMM_SELF); });
    verdict(message.size() < 1000 &&
              message.find("q.prm\"") != std::string::npos,
            "a long name of a file",
            message.substr(0, 1000));
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_too_small();
  test_too_large();
  test_long_values();
  return 0;
}
