// --import: what a deck with some of everything becomes, what is told of the
// rest, and what is refused.

#include <deal.II/base/mpi.h>

#include <mortise/body/mesh/mesh_source.h>
#include <mortise/problem/import/deck_import.h>
#include <mortise/problem/input/parameter_file.h>
#include <verdict.h>

#include <algorithm>
#include <filesystem>

#include "../body/gmsh_meshes.h"

using gmsh_test::read_file;
using gmsh_test::write_file;

namespace
{
  const std::string deck = R"(*HEADING
Everything
*NODE, NSET=NALL
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
11, 0, 0, 1.1
12, 1, 0, 1.1
13, 1, 1, 1.1
14, 0, 1, 1.1
15, 0, 0, 2
16, 1, 0, 2
17, 1, 1, 2
18, 0, 1, 2
25, 0, 0, 3
26, 1, 0, 3
27, 1, 1, 3
28, 0, 1, 3
99, 5, 5, 5
*ELEMENT, TYPE=C3D8, ELSET=LOW
1, 1,2,3,4,5,6,7,8
*ELEMENT, TYPE=C3D8R, ELSET=MID
2, 11,12,13,14,15,16,17,18
*ELEMENT, TYPE=C3D8I, ELSET=HIGH
3, 15,16,17,18,25,26,27,28
*ELEMENT, TYPE=B31, ELSET=BEAM
4, 1, 99
*NSET, NSET=FOOT
1,2,3,4
*NSET, NSET=TOP
25,26,27,28
*SURFACE, NAME=SLAVE
MID, S1
*SURFACE, NAME=MASTER
LOW, S2
*SURFACE, NAME=SIDE
3, S4
*SURFACE, NAME=ROUND, TYPE=NODE
TOP
*MATERIAL, NAME=A
*ELASTIC, TYPE=ORTHO
1346.153846, 576.9230769, 1346.153846, 576.9230769, 576.9230769, 1346.153846, 384.6153846, 384.6153846,
384.6153846
*CONDUCTIVITY
1.
*MATERIAL, NAME=B
*ELASTIC
1000., 0.3, 20.
900., 0.3, 100.
*PLASTIC, HARDENING=KINEMATIC
10., 0.
20., 0.1
*EXPANSION
1e-5
*DENSITY
2.
*CREEP
1., 2., 3.
*MATERIAL, NAME=C
*HYPERELASTIC, OGDEN, N=2
100., 2., 50., -2., 0.01, 0.
*SOLID SECTION, ELSET=LOW, MATERIAL=A
*SOLID SECTION, ELSET=MID, MATERIAL=B
*SOLID SECTION, ELSET=HIGH, MATERIAL=C
*BEAM SECTION, ELSET=BEAM, MATERIAL=A, SECTION=RECT
1., 1.
*ORIENTATION, NAME=O, SYSTEM=CYLINDRICAL
0,0,0,0,0,1
*TRANSFORM, NSET=TOP
0.6, 0.8, 0., -0.8, 0.6, 0.
*SURFACE INTERACTION, NAME=I
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL
1., 2.
*FRICTION
0.2
*CONTACT PAIR, INTERACTION=I, SMALL SLIDING, ADJUST=0.1
SLAVE, MASTER
*CLEARANCE, SLAVE=SLAVE, MASTER=MASTER, VALUE=0.05
*MPC
BEAM, 1, 2
*RIGID BODY, NSET=11, REF NODE=99
*COUPLING, REF NODE=99, SURFACE=ROUND, CONSTRAINT NAME=K
*KINEMATIC
1,2
*INITIAL CONDITIONS, TYPE=TEMPERATURE
NALL, 20.
*AMPLITUDE, NAME=RAMP
0., 0., 0.5, 1., 1., 0.5
*BOUNDARY
FOOT, 1, 3
99, 1, 2
5, 1
*BOUNDARY
TOP, 1
*STEP, NLGEOM
*STATIC, DIRECT
0.5, 1.
*DLOAD, AMPLITUDE=RAMP
3, P4, 5.
MID, GRAV, 9.81, 0, 0, -1
MID, BX, 1.
LOW, HP, 1., 2., 3.
*DSLOAD
SIDE, TRVEC, 3., 0., 0., 2.
*CLOAD
15, 1, 3.
99, 2, 1.
*TEMPERATURE
NALL, 120.
*NODE PRINT, NSET=TOP
U
*END STEP
*STEP, NLGEOM
*DYNAMIC
0.1, 2.
*BOUNDARY, OP=NEW
FOOT, 1, 3
*DLOAD, OP=NEW
LOW, CENTRIF, 100., 0., 0., 0., 0., 0., 1.
*END STEP
)";

  bool
  holds(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }

  void
  check_remarks(const std::string &told)
  {
    for (
      const std::string remark :
      {"line 31: *ELEMENT, TYPE=B31",
       "line 62: *CREEP of B",
       "line 84: *MPC",
       "line 86: *RIGID BODY of '11', which has no outer faces",
       "line 88: *COUPLING with *KINEMATIC, whose reference node is free in the components 4, 5, 6, and which does not move all components",
       "line 107: *DLOAD of the kind 'HP'",
       "line 111: *CLOAD on 1 node that is not",
       "line 124: CENTRIF on the body LOW, which has no *DENSITY",
       "line 54: *ELASTIC of B depends on the temperature",
       "line 65: *HYPERELASTIC of C",
       "line 77: PRESSURE-OVERCLOSURE=EXPONENTIAL is hard contact",
       "line 119: *DYNAMIC: the step is static",
       "line 121: *BOUNDARY, OP=NEW: what was held before"})
      verdict(holds(told, remark),
              "told: " + remark.substr(remark.find(": ") + 2),
              told);
  }

  void
  check_scene(const std::string &scene)
  {
    for (
      const std::string text :
      {"set Bodies     = LOW, MID, HIGH",
       "set Degree = 1  # C3D8\n",
       "set Degree = 2  # C3D8R",
       // of a stiffness that is isotropic, with E = 1000 and nu = 0.3
       "set Shear moduli = 384.6153846, 384.6153846, 384.6153846",
       // 2 (9.81) of an amplitude 0, 1, 0.5, and 0 from t = 2 on
       "set Body force = if(t <= 0.5, 2*t, if(t <= 1, 1 - 1*(t - 0.5), 0.5 - 0.5*(t - 1))); 0; "
       "if(t <= 0.5, -39.24*t, if(t <= 1, -19.62 + 19.62*(t - 0.5), -9.81 + 9.81*(t - 1)))",
       "set Temperature = if(t <= 1, 100*t, 100)",
       "set Kinematic hardening modulus = 100",
       "set Ogden terms = 100, 2; -50, -2",
       // K = 2 / D = 200 and mu = 150
       "set Poisson ratio = 0.2\n",
       "set Traction = 0; 0; if(t <= 1, 3*t, 3)",
       "set Displacement = 0, -, -\n    set Displacement axes = 0, 0, 53.1301023542",
       "set Displacement at = 0, 0, 1: 0, -, -",
       "set Slave  = MID: to_HIGH",
       "set Slave  = MID: SLAVE\n  set Master = LOW: MASTER\n  set Law = contact\n"
       "  set Friction coefficient = 0.2\n  set Sliding = small\n  set Offset = 0.05\n",
       "set Step = 0.5, 1, 1.5, 2\n  set Largest step = 0.5",
       "node_26: HIGH: 1, 0, 3"})
      verdict(holds(scene, text),
              text.substr(0, text.find_first_of(";\n")),
              scene);
  }

  void
  check_refused(const std::string &what,
                const std::string &text,
                const std::string &fragment,
                const std::string &extra = "Output/Directory=nowhere")
  {
    const std::string file = write_file("wrong.inp", text);
    const std::string message =
      message_of([&] { mortise::import_deck(file, {extra}, MPI_COMM_WORLD); });
    verdict(holds(message, fragment), "refused: " + what, message);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                           comm = MPI_COMM_WORLD;
  const std::string                        file = write_file("sink.inp", deck);
  const std::string                        directory = temporary_file("import");
  const mortise::Settings settings = {"Output/Directory=" + directory};
  const std::string       told     = mortise::import_deck(file, settings, comm);
  const std::string       scene    = read_file(directory + "/sink.prm");
  if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
    check_remarks(told);
  verdict(holds(scene, "# Left out:\n#   line 31: "), "remarks are comments");
  check_scene(scene);
  const mortise::Parameters parameters =
    mortise::read_parameters(directory + "/sink.prm", {}, comm);
  mortise::validate(parameters);
  bool meshes = true;
  for (const auto &body : parameters.bodies)
    meshes = meshes && mortise::boundary_names(body.mesh).size() ==
                         body.boundaries.size() + (body.name == "LOW" ? 1 :
                                                   body.name == "MID" ? 2 :
                                                                        1);
  verdict(parameters.bodies.size() == 3 && meshes, "the scene is valid");

  const std::string again =
    message_of([&] { mortise::import_deck(file, settings, comm); });
  verdict(holds(again, "which is there already"),
          "refused: a scene that is there",
          again);
  const std::string mesh = deck.substr(0, deck.find("*MATERIAL"));
  check_refused("no material",
                mesh + "*SOLID SECTION, ELSET=LOW, MATERIAL=X\n",
                "the material 'X', which it does not define");
  check_refused("no section", mesh, "none of them has a *SOLID SECTION");
  check_refused("no solids",
                mesh.substr(0, mesh.find("*ELEMENT")) +
                  "*ELEMENT, TYPE=CPS4, ELSET=E\n1, 1, 2, 3, 4\n",
                "has no solid elements");
  check_refused(
    "no constants",
    mesh +
      "*SOLID SECTION, ELSET=LOW, MATERIAL=X\n*MATERIAL, NAME=X\n*DENSITY\n1.\n",
    "has no elastic constants");
  check_refused(
    "a word for a number",
    mesh +
      "*SOLID SECTION, ELSET=LOW, MATERIAL=X\n*MATERIAL, NAME=X\n*ELASTIC\n1., x\n",
    "'x', which is no number");
  const std::string section = "*SOLID SECTION, ELSET=LOW, MATERIAL=X\n"
                              "*MATERIAL, NAME=X\n*ELASTIC\n1., 0.3\n";
  check_refused("a direction of no length",
                mesh + section + "*STEP\n*STATIC\n*DLOAD\nLOW, GRAV, 1.\n",
                "in line 52 a direction of no length");
  check_refused("axes that are none",
                mesh + section +
                  "*TRANSFORM, NSET=TOP\n1., 0., 0., 2., 0., 0.\n",
                "in line 49 axes by two points on a line through the origin");
  check_refused("times that descend",
                mesh + section + "*AMPLITUDE, NAME=A\n0., 0., 2., 1., 1., 0.\n",
                "in line 50 an *AMPLITUDE whose times descend");
  check_refused(
    "a word for a clearance",
    mesh + section +
      "*SOLID SECTION, ELSET=MID, MATERIAL=X\n*CONTACT PAIR\n"
      "SLAVE, MASTER\n*CLEARANCE, SLAVE=SLAVE, MASTER=MASTER, VALUE=x\n",
    "in line 52 'x', which is no number");
  check_refused(
    "moduli of zero",
    mesh +
      "*SOLID SECTION, ELSET=LOW, MATERIAL=X\n*MATERIAL, NAME=X\n"
      "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n0.,0.,0.,0.,0.,0.,0.,0.,\n0.\n",
    "a value that is no finite number");
  check_refused("an orientation that is none",
                mesh +
                  "*SOLID SECTION, ELSET=LOW, MATERIAL=X, ORIENTATION=O\n" +
                  section.substr(section.find("*MATERIAL")),
                "the orientation 'O', which it does not define");
  check_refused("another setting", deck, "--import with --set", "Part=LOW");
}
