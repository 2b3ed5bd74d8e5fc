// Boundaries chosen by place and shape: of a geometry without names, of a mesh,
// and of hexahedra, in areas that are known; and what is refused.

#include <mortise/body/mesh/boundary_selection.h>
#include <mortise/body/mesh/surface_patches.h>
#include <verdict.h>

#include <cmath>

#include "gmsh_meshes.h"

using namespace dealii;
using namespace gmsh_test;
using mortise::CoarseMesh;
using mortise::MeshParameters;

namespace
{
  /// A plate of 40 x 40 x 10 with a hole of radius 5 at the origin, which is
  /// cut in halves as some CAD programs do, another one at (12, 12), and a ball
  /// on its corner; faces have no names.
  const std::string plate = R"(
SetFactory("OpenCASCADE");
Box(1) = {-20, -20, 0, 40, 40, 10};
Cylinder(2) = {0, 0, 0, 0, 0, 10, 5, Pi};
Cylinder(3) = {0, 0, 0, 0, 0, 10, 5, Pi};
Rotate{{0, 0, 1}, {0, 0, 0}, Pi}{ Volume{3}; }
Cylinder(4) = {12, 12, 0, 0, 0, 10, 5};
BooleanDifference(5) = { Volume{1}; Delete; }{ Volume{2, 3, 4}; Delete; };
Sphere(6) = {-20, -20, 10, 6};
BooleanUnion(7) = { Volume{5}; Delete; }{ Volume{6}; Delete; };
Mesh.MeshSizeMax = 3;
)";

  /// Edges of a mesh in which cells have names, but not faces.
  const std::string named_volume =
    plate + "Physical Volume(\"plate\") = {7};\n";

  double
  area(const CoarseMesh &mesh, const std::string &name)
  {
    double sum = 0.;
    for (const CellData<2> &face : mesh.faces.boundary_quads)
      if (face.boundary_id == mesh.names.boundaries.at(name))
        {
          const auto &v = face.vertices;
          const auto &x = mesh.vertices;
          sum += cross_product_3d(x[v[1]] - x[v[0]], x[v[2]] - x[v[0]]).norm() /
                 (v.size() == 4 ? 1. : 2.);
        }
    return sum;
  }

  CoarseMesh
  read(MeshParameters q, const std::string &boundaries)
  {
    q.boundaries = boundaries;
    return mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
  }

  void
  check_areas(const std::string &what, const MeshParameters &q)
  {
    const CoarseMesh mesh = read(
      q,
      "hole: cylinder radius 5 near 0, 0, 5; other: cylinder near 12, 12, 5; "
      "left: plane x = 20; back: plane through 0, 20, 0 normal 0, 3, 0; ball: "
      "sphere; foot: plane z = 0");
    const double hole    = 2. * numbers::PI * 5. * 10.;
    const double exact[] = {400., 400., 1600. - 2. * numbers::PI * 25.};
    verdict(std::fabs(area(mesh, "hole") / hole - 1.) < 0.04 &&
              std::fabs(area(mesh, "other") / area(mesh, "hole") - 1.) < 0.02,
            what + ": a hole of two halves, another one of the same radius",
            std::to_string(area(mesh, "hole")));
    verdict(std::fabs(area(mesh, "left") - exact[0]) < 1e-9 &&
              std::fabs(area(mesh, "back") - exact[1]) < 1e-9,
            what + ": sides by planes");
    // the ball is cut off by the plate: 4 pi r^2 (1 - 1/8)
    verdict(std::fabs(area(mesh, "ball") / (3.5 * numbers::PI * 36.) - 1.) <
              0.06,
            what + ": the only sphere",
            std::to_string(area(mesh, "ball")));
    verdict(std::fabs(area(mesh, "foot") / exact[2] - 1.) < 0.01,
            what + ": the foot without its holes");
  }

  void
  check_patches(const MeshParameters &q)
  {
    const CoarseMesh mesh     = read(q, "foot: plane z = 0");
    unsigned int     planes   = 0;
    bool             measured = false;
    for (const auto &patch : mortise::surface_patches(mesh, false))
      {
        planes += patch.kind == "plane";
        measured =
          measured ||
          (patch.kind == "cylinder" && std::fabs(patch.radius - 5.) < 1e-6 &&
           patch.centre.distance(Point<3>(12, 12, 5)) < 0.1);
      }
    verdict(planes == 6, "six planes", std::to_string(planes));
    verdict(measured, "radius and centre of a cylinder");
  }

  void
  check_refusals(MeshParameters q)
  {
    const auto refuse = [&q](const std::string &what,
                             const std::string &boundaries,
                             const std::string &fragment) {
      q.boundaries = boundaries;
      refused(what, q, fragment);
    };
    refuse("nothing that can be read",
           "hole: cylindr",
           "Boundaries has the entry 'hole: cylindr'; allowed: entries");
    refuse("a radius that is no number", "hole: cylinder radius x", "allowed:");
    refuse("a plane without place", "foot: plane z", "allowed:");
    refuse("words too many", "foot: plane z = 0 please", "allowed:");
    refuse("no name", ": plane z = 0", "allowed:");
    refuse("a radius that is not there",
           "hole: cylinder radius 7",
           "'hole: cylinder radius 7' chooses no face; there are 1: ");
    refuse("faces of two boundaries",
           "foot: plane z = 0; all: box -30, -30, -10, 30, 30, 30",
           "'foot: plane z = 0' and 'all: box -30, -30, -10, 30, 30, 30' of "
           "Boundaries both choose: ");
    q.boundaries = "";
    if (q.file.find(".msh") != std::string::npos)
      refused("no names at all",
              q,
              "or Boundaries = name: plane z = 0; ..., which names faces");
  }

  /// Names of the file: those that are left, and faces that are taken away.
  void
  check_names()
  {
    const std::string    box = R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Transfinite Curve{:} = 3; Transfinite Surface{:}; Recombine Surface{:};
Transfinite Volume{1};
Physical Volume("box") = {1};
Physical Surface("sides") = {1, 2, 3, 4};
Physical Surface("low") = {5};
)";
    const MeshParameters q =
      file_parameters(write_mesh("selection_box", box, {}));
    const CoarseMesh mesh =
      read(q, "left: plane x = 0; both: named low and plane z = 1");
    verdict(mesh.cells[0].vertices.size() == 8 && area(mesh, "left") == 1. &&
              area(mesh, "sides") == 3. && area(mesh, "both") == 2. &&
              mesh.names.boundaries.count("low") == 0,
            "faces leave the boundaries of the file");
    MeshParameters twice = q;
    twice.boundaries     = "sides: plane x = 0";
    refused("a name of other faces",
            twice,
            "which the file has as a name of other faces");
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MeshParameters             geometry =
    file_parameters(write_file("selection.geo", plate));
  const MeshParameters mesh =
    file_parameters(write_mesh("selection_mesh", named_volume, {}));
  check_areas("geometry", geometry);
  check_areas("mesh", mesh);
  check_patches(mesh);
  check_refusals(mesh);
  check_names();
}
