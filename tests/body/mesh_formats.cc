// Files of gmsh in both versions, ASCII and binary, of tetrahedra and
// hexahedra, of first and second order, give the same bodies: volumes and areas
// are exact (or those of the curved shape), names and parts are right, on all
// ranks.

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/grid/tria.h>

#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/body/mesh/vertex_order.h>
#include <verdict.h>

#include <cmath>

#include "gmsh_meshes.h"

using namespace dealii;
using namespace gmsh_test;
using mortise::CoarseMesh;

namespace
{
  /// A cube of 2 x 2 x 2 hexahedra, and the corner of another one in
  /// tetrahedra, which do not touch.
  const std::string apart = R"(
SetFactory("Built-in");
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1:4} = 3;
Transfinite Surface{1};
Recombine Surface{1};
core[] = Extrude{0, 0, 1}{ Surface{1}; Layers{2}; Recombine; };
Point(101) = {3, 0, 0, 0.5}; Point(102) = {4, 0, 0, 0.5}; Point(103) = {3, 1, 0, 0.5};
Point(104) = {3, 0, 1, 0.5};
Line(101) = {101, 102}; Line(102) = {102, 103}; Line(103) = {103, 101};
Line(104) = {101, 104}; Line(105) = {102, 104}; Line(106) = {103, 104};
Curve Loop(101) = {101, 102, 103}; Plane Surface(101) = {101};
Curve Loop(102) = {101, 105, -104}; Plane Surface(102) = {102};
Curve Loop(103) = {102, 106, -105}; Plane Surface(103) = {103};
Curve Loop(104) = {103, 104, -106}; Plane Surface(104) = {104};
Surface Loop(101) = {101:104}; Volume(101) = {101};
Physical Volume("brick") = {core[1]};
Physical Volume("corner") = {101};
Physical Surface("floor") = {1, 101};
Physical Surface("slope") = {103};
Physical Surface("lid") = {core[0]};
)";

  /// Two layers of a quarter of a thick cylinder, radii 1, 1.5, 2, height 1,
  /// that share the nodes of "middle"; @p recombined: in hexahedra.
  std::string
  quarter(const bool recombined)
  {
    const std::string recombine = recombined ? "Recombine;" : "";
    return std::string(R"(
SetFactory("Built-in");
For i In {0:2}
  Point(1 + i) = {1 + 0.5 * i, 0, 0, 0.4};
  Point(11 + i) = {0, 1 + 0.5 * i, 0, 0.4};
EndFor
Point(20) = {0, 0, 0};
For i In {0:2}
  Circle(1 + i) = {1 + i, 20, 11 + i};
EndFor
For i In {0:1}
  Line(11 + i) = {1 + i, 2 + i};
  Line(21 + i) = {11 + i, 12 + i};
  Curve Loop(1 + i) = {11 + i, 2 + i, -(21 + i), -(1 + i)};
  Plane Surface(1 + i) = {1 + i};
EndFor
Transfinite Curve{1, 2, 3} = 4;
Transfinite Curve{11, 12, 21, 22} = 2;
)") +
           (recombined ?
              "Transfinite Surface{1, 2}; Recombine Surface{1, 2};\n" :
              "") +
           "a[] = Extrude{0, 0, 1}{ Surface{1}; Layers{2}; " + recombine +
           "};\nb[] = Extrude{0, 0, 1}{ Surface{2}; Layers{2}; " + recombine +
           R"(};
Physical Volume("inner") = {a[1]};
Physical Volume("outer") = {b[1]};
Physical Surface("inside") = {a[5]};
Physical Surface("middle") = {a[3]};
Physical Surface("outside") = {b[3]};
Physical Surface("zmin") = {1, 2};
Physical Surface("zmax") = {a[0], b[0]};
)";
  }

  /// Volume of the curved (or straight) cells of @p mesh.
  double
  volume(const CoarseMesh &mesh)
  {
    const bool          hexahedra = mesh.cells[0].vertices.size() == 8;
    const Quadrature<3> rule      = hexahedra ? Quadrature<3>(QGauss<3>(4)) :
                                                mortise::simplex_quadrature<3>(6);
    double              sum       = 0.;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          Tensor<2, 3>    J;
          const Point<3> &x = rule.point(q);
          const auto     &v = mesh.cells[c].vertices;
          for (unsigned int i = 0; i < v.size() && !mesh.geometry; ++i)
            {
              Tensor<1, 3> slope;
              if (hexahedra)
                slope = GeometryInfo<3>::d_linear_shape_function_gradient(x, i);
              else
                for (unsigned int d = 0; d < 3; ++d)
                  slope[d] = i == 0 ? -1. : (i == d + 1 ? 1. : 0.);
              J += outer_product(Tensor<1, 3>(mesh.vertices[v[i]]), slope);
            }
          sum += rule.weight(q) *
                 determinant(mesh.geometry ? mesh.geometry->jacobian(c, x) : J);
        }
    return sum;
  }

  /// Flat area of the faces of a boundary; 0 for an unknown name.
  double
  area(const CoarseMesh &mesh, const std::string &name)
  {
    double sum = 0.;
    if (mesh.names.boundaries.count(name) == 1)
      for (const CellData<2> &face : mesh.faces.boundary_quads)
        if (face.boundary_id == mesh.names.boundaries.at(name))
          {
            const auto &v    = face.vertices;
            const auto  edge = [&](unsigned int i, unsigned int j) {
              return mesh.vertices[v[i]] - mesh.vertices[v[j]];
            };
            sum += 0.5 * cross_product_3d(edge(1, 0), edge(2, 0)).norm();
            if (v.size() == 4)
              sum += 0.5 * cross_product_3d(edge(1, 3), edge(2, 3)).norm();
          }
    return sum;
  }

  std::string
  text(const double value)
  {
    std::ostringstream stream;
    stream.precision(16);
    stream << value;
    return stream.str();
  }

  std::string
  names(const CoarseMesh &mesh)
  {
    std::string result;
    for (const auto &entry : mesh.names.boundaries)
      result += entry.first + " ";
    for (const auto &entry : mesh.names.materials)
      result += "[" + entry.second + "]";
    return result;
  }

  /// The same data on all ranks, and cells that deal.II takes.
  bool
  usable(const CoarseMesh &mesh)
  {
    double sum = 0.;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      sum += mesh.vertices[v] * Point<3>(1., std::sqrt(2.), v);
    auto cells = mesh.cells;
    if (cells[0].vertices.size() == 4)
      mortise::order_vertices(mesh.vertices, cells);
    Triangulation<3> triangulation;
    triangulation.create_triangulation(mesh.vertices, cells, mesh.faces);
    return Utilities::MPI::max(sum, MPI_COMM_WORLD) ==
             Utilities::MPI::min(sum, MPI_COMM_WORLD) &&
           triangulation.n_active_cells() == mesh.cells.size();
  }

  std::string
  text(const Format &format)
  {
    return std::to_string(format.version).substr(0, 3) +
           (format.binary ? " binary" : " ASCII") + ", order " +
           std::to_string(format.order) +
           (format.serendipity ? " incomplete" : "");
  }

  void
  check_apart(const Format &format)
  {
    const std::string name = write_mesh("formats_apart", apart, format);
    const CoarseMesh  brick =
      mortise::read_mesh_file(file_parameters(name, "brick"),
                              "Mesh",
                              MPI_COMM_WORLD);
    const CoarseMesh corner =
      mortise::read_mesh_file(file_parameters(name, "corner"),
                              "Mesh",
                              MPI_COMM_WORLD);
    verdict(names(brick) == "floor lid [brick]" &&
              names(corner) == "floor slope [corner]",
            text(format) + ": names of both parts",
            names(brick) + names(corner));
    verdict(brick.cells.size() == 8 && brick.cells[0].vertices.size() == 8 &&
              corner.cells[0].vertices.size() == 4 &&
              (format.order == 2) == (brick.geometry != nullptr),
            text(format) + ": shapes");
    verdict(std::abs(volume(brick) - 1.) < 1e-13 &&
              std::abs(volume(corner) - 1. / 6.) < 1e-13,
            text(format) + ": volumes",
            text(volume(brick)) + " " + text(volume(corner)));
    verdict(std::abs(area(brick, "lid") - 1.) < 1e-13 &&
              std::abs(area(brick, "floor") - 1.) < 1e-13 &&
              std::abs(area(corner, "floor") - 0.5) < 1e-13 &&
              std::abs(area(corner, "slope") - std::sqrt(0.75)) < 1e-13,
            text(format) + ": areas");
    verdict(usable(brick) && usable(corner),
            text(format) + ": the same on all ranks");
    const CoarseMesh both =
      mortise::read_mesh_file(file_parameters(name), "Mesh", MPI_COMM_WORLD);
    verdict(std::abs(volume(both) - 7. / 6.) < 1e-13,
            text(format) + ": two shapes without Part",
            text(volume(both)));
    refused(text(format) + ": an unknown part",
            file_parameters(name, "bricks"),
            "no physical volume 'bricks', which Part names; it has: brick");
  }

  void
  check_quarter(const Format &format, const bool recombined)
  {
    const std::string what =
      text(format) + (recombined ? ", hexahedra" : ", tetrahedra");
    const std::string name =
      write_mesh("formats_quarter", quarter(recombined), format);
    const CoarseMesh both =
      mortise::read_mesh_file(file_parameters(name), "Mesh", MPI_COMM_WORLD);
    const CoarseMesh inner =
      mortise::read_mesh_file(file_parameters(name, "inner"),
                              "Mesh",
                              MPI_COMM_WORLD);
    const CoarseMesh outer =
      mortise::read_mesh_file(file_parameters(name, "outer"),
                              "Mesh",
                              MPI_COMM_WORLD);
    verdict(names(both) == "inside outside zmax zmin [inner][outer]" &&
              names(inner) == "inside middle zmax zmin [inner]" &&
              names(outer) == "middle outside zmax zmin [outer]",
            what + ": a shared surface is a boundary of each part",
            names(both) + names(inner) + names(outer));
    // three chords of 30 degrees, or parabolas through their middles (which
    // gmsh places to ten digits)
    const double chord = 3. * std::sin(numbers::PI / 6.) / 2.;
    const double bulge = 3. * 2. / 3. * 2. * std::sin(numbers::PI / 12.) *
                         (1. - std::cos(numbers::PI / 12.));
    const double disc  = chord + (format.order == 2 ? bulge : 0.);
    const double error = std::abs(volume(inner) - 1.25 * disc) +
                         std::abs(volume(outer) - 1.75 * disc) +
                         std::abs(volume(both) - 3. * disc);
    verdict(error < 1e-9,
            what + ": volumes to 1e-9",
            text(volume(inner)) + " for " + text(1.25 * disc));
    verdict(std::abs(area(inner, "middle") - area(outer, "middle")) < 1e-14 &&
              std::abs(area(inner, "middle") -
                       9. * std::sin(numbers::PI / 12.)) < 1e-13,
            what + ": area of the shared surface",
            text(area(inner, "middle")));
    verdict(usable(both) && usable(inner), what + ": the same on all ranks");
  }

  /// Meshes of other programs, written by gmsh: their names, their numbers, or
  /// faces that are chosen by where they are.
  void
  check_foreign(const std::string &end, const int order)
  {
    const std::string what = end + ", order " + std::to_string(order);
    const std::string geo =
      write_file("foreign.geo",
                 "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 2};\n"
                 "Mesh.MeshSizeMax = 0.7;\nPhysical Volume(\"solid\") = {1};\n"
                 "Physical Surface(\"left\") = {1};\n"
                 "Physical Surface(\"low\") = {5};\n");
    const std::string file = temporary_file("foreign." + end);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::open(geo);
        gmsh::model::mesh::generate(3);
        gmsh::model::mesh::setOrder(order);
        gmsh::write(file);
        gmsh::finalize();
      }
    MPI_Barrier(MPI_COMM_WORLD);
    mortise::MeshParameters q = file_parameters(file);
    if (end != "unv")
      q.boundaries = "left: plane x = 0; low: plane z = 0";
    const CoarseMesh mesh = mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
    verdict(std::abs(volume(mesh) - 2.) < 1e-9 &&
              std::abs(area(mesh, "left") - 2.) < 1e-9 &&
              std::abs(area(mesh, "low") - 1.) < 1e-9 &&
              (mesh.geometry != nullptr) == (order == 2),
            what + ": volume, and areas of boundaries",
            text(volume(mesh)) + " " + text(area(mesh, "left")) + " " +
              names(mesh));
  }

  void
  check_foreign_files()
  {
    for (const std::string end : {"unv", "bdf", "vtk"})
      for (const int order : {1, 2})
        check_foreign(end, order);
    refused("a damaged mesh of another program",
            file_parameters(write_file("damaged.unv", "    -1\n  2411\n   x")),
            "damaged.unv' ");
    mortise::MeshParameters q =
      file_parameters(write_file("sized.bdf", "BEGIN BULK\n"));
    q.mesh_size = 1.;
    refused("Mesh size of a mesh", q, "nothing for a file that is a mesh");
  }

  void
  check_choice_of_cells()
  {
    mortise::MeshParameters q =
      file_parameters(write_mesh("formats_cells", quarter(false), Format()));
    q.cells = "hexahedra";
    refused("Cells of the other shape", q, "Cells = hexahedra");
    q.cells = "tetrahedra";
    verdict(message_of(q) == "(no error)", "Cells of the same shape");
    q.translate           = {{1., 2., 3.}};
    q.rotate              = {{0., 0., 90.}};
    const CoarseMesh mesh = mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
    bool             placed = true;
    for (const Point<3> &x : mesh.vertices)
      {
        const double r = std::hypot(x[0] - 1., x[1] - 2.);
        placed         = placed && x[0] < 1. + 1e-12 && x[1] > 2. - 1e-12 &&
                 x[2] > 3. - 1e-12 && r > 1. - 1e-12 && r < 2. + 1e-12;
      }
    verdict(placed, "Rotate and Translate");
  }

  void
  check_geometries()
  {
    const std::string       name = write_file("formats_meshed.geo",
                                        R"(DefineConstant[ mesh_size = 0.5 ];
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
MeshSize{:} = mesh_size;
Physical Volume("box") = {1};
Physical Surface("low") = {5};
)");
    mortise::MeshParameters q    = file_parameters(name);
    std::size_t             n[2];
    for (const unsigned int fine : {0, 1})
      {
        q.mesh_size = fine * 0.2;
        const CoarseMesh mesh =
          mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
        n[fine] = mesh.cells.size();
        verdict(std::abs(volume(mesh) - 1.) < 1e-13 &&
                  std::abs(area(mesh, "low") - 1.) < 1e-13 && usable(mesh),
                ".geo with Mesh size = " + text(q.mesh_size));
        const CoarseMesh again =
          mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
        verdict(again.vertices == mesh.vertices, "the same in a second run");
      }
    verdict(n[1] > 4 * n[0],
            "Mesh size changes the mesh",
            std::to_string(n[0]) + " " + std::to_string(n[1]));

    const std::string brep = temporary_file("formats_box.brep");
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::model::occ::addBox(0., 0., 0., 1., 2., 3.);
        gmsh::model::occ::synchronize();
        gmsh::write(brep);
        gmsh::finalize();
      }
    MPI_Barrier(MPI_COMM_WORLD);
    q                     = file_parameters(brep);
    q.mesh_size           = 1.;
    const CoarseMesh mesh = mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
    verdict(std::abs(volume(mesh) - 6.) < 1e-12 && usable(mesh) &&
              names(mesh) == "1 2 3 4 5 6 [1]",
            ".brep: volume, and surfaces named by their tags",
            text(volume(mesh)) + " " + names(mesh));
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const double version : {2.2, 4.1})
    for (const bool binary : {false, true})
      for (const unsigned int order : {1, 2})
        {
          Format format;
          format.version = version;
          format.binary  = binary;
          format.order   = order;
          check_apart(format);
          check_quarter(format, false);
          check_quarter(format, true);
          format.serendipity = true;
          if (order == 2)
            check_quarter(format, true);
        }
  check_choice_of_cells();
  check_geometries();
  check_foreign_files();
}
