// Curved boundaries of files: shapes are fitted to rounding, wrong ones are
// refused, and cells of any degree follow them at the full rate, h^(p+1), of
// tetrahedra and hexahedra, from spheres, cylinders cut at an angle and STEP
// files, refined or not, on all ranks.

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_values.h>

#include <fcntl.h>
#include <mortise/body/body.h>
#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/fe_simplex_legendre.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/body/mesh/curved_boundaries.h>
#include <unistd.h>
#include <verdict.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "gmsh_meshes.h"

using namespace dealii;
using namespace gmsh_test;
using mortise::Body;
using mortise::MeshParameters;

namespace
{
  std::string
  shipped(const std::string &name)
  {
    return (std::filesystem::path(__FILE__).parent_path() / "../../meshes" /
            name)
      .string();
  }

  std::string
  text(const double value)
  {
    std::ostringstream stream;
    stream << value;
    return stream.str();
  }

  /// Off the true shape, by the name of a boundary.
  using Distances =
    std::map<std::string, std::function<double(const Point<3> &)>>;

  struct Measured
  {
    double volume = 0.;
    double off    = 0.; ///< largest distance of boundaries from their shapes
    double gap    = 0.; ///< between neighbours
  };

  /// Points of face @p f in its cell's reference cell.
  std::vector<Point<3>>
  face_points(const Body::CellIterator &cell, const unsigned int f)
  {
    const unsigned int    n = 5;
    std::vector<Point<3>> points;
    std::vector<Point<3>> corners;
    for (unsigned int k = 0; k < 3; ++k)
      for (const unsigned int v : cell->vertex_indices())
        if (cell->vertex_index(v) == cell->face(f)->vertex_index(k))
          corners.push_back(cell->reference_cell().template vertex<3>(v));
    for (unsigned int i = 0; i <= n; ++i)
      for (unsigned int j = 0; i + j <= n; ++j)
        points.push_back(corners[0] +
                         double(i) / n * (corners[1] - corners[0]) +
                         double(j) / n * (corners[2] - corners[0]));
    return points;
  }

  double
  volume(const Body &body)
  {
    const unsigned int                degree = body.max_degree();
    std::unique_ptr<FiniteElement<3>> fe;
    Quadrature<3>                     rule;
    if (body.mesh.tetrahedra)
      {
        fe   = std::make_unique<mortise::FE_SimplexLegendre>(1);
        rule = mortise::simplex_quadrature<3>(3 * degree);
      }
    else
      {
        fe   = std::make_unique<mortise::FE_Legendre>(1);
        rule = QGauss<3>(2 * degree + 2);
      }
    FEValues<3> values(*body.mapping, *fe, rule, update_JxW_values);
    double      sum = 0.;
    for (const auto &cell : body.triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          for (const unsigned int q : values.quadrature_point_indices())
            sum += values.JxW(q);
        }
    return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }

  Measured
  measure(const MeshParameters &q,
          const unsigned int    degree,
          const Distances      &distances)
  {
    Body body("body", 0, mortise::LinearElastic());
    body.create_mesh(q, MPI_COMM_WORLD, "Mesh", {});
    body.create_space(degree, {}, "Mesh");
    Measured result;
    result.volume = volume(body);
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->is_locally_owned() && cell->at_boundary(f))
          for (const auto &[name, distance] : distances)
            if (body.mesh.names.boundaries.at(name) ==
                cell->face(f)->boundary_id())
              for (const Point<3> &x : face_points(cell, f))
                result.off = std::max(
                  result.off,
                  std::abs(distance(
                    body.mapping->transform_unit_to_real_cell(cell, x))));
    result.off = Utilities::MPI::max(result.off, MPI_COMM_WORLD);
    return result;
  }

  /// Volume and distances fall at the rate of the degree.
  void
  check_rates(const std::string &what,
              MeshParameters     q,
              const Distances   &distances,
              const double       exact,
              const unsigned int max_degree,
              const unsigned int first = 0)
  {
    for (unsigned int p = 1; p <= max_degree; ++p)
      {
        q.refinements         = first;
        const Measured coarse = measure(q, p, distances);
        q.refinements         = first + 1;
        const Measured fine   = measure(q, p, distances);
        const double   e0     = std::abs(coarse.volume / exact - 1.),
                     e1       = std::abs(fine.volume / exact - 1.);
        if (std::getenv("VERBOSE") != nullptr)
          std::cout << what << " p " << p << " volume " << e0 << " " << e1
                    << " rate " << std::log2(e0 / e1) << "  off " << coarse.off
                    << " " << fine.off << " rate "
                    << std::log2(coarse.off / fine.off) << std::endl;
        const std::string at = what + ", degree " + std::to_string(p);
        verdict(e1 < 4. * fine.off,
                at + ": the volume is as exact as the boundary",
                text(e1) + " " + text(fine.off));
        verdict(coarse.off / fine.off > std::pow(2., p + 0.6) ||
                  fine.off < 1e-13,
                at + ": rate of distances above degree + 0.6",
                text(coarse.off) + " " + text(fine.off));
      }
  }

  double
  off_sphere(const Point<3> &x, const double r)
  {
    return x.norm() - r;
  }

  void
  check_thick_sphere(const std::string &shape)
  {
    MeshParameters q =
      file_parameters(shipped("thick_sphere_" + shape + ".geo"), "inner");
    q.mesh_size = 0.8;
    if (shape == "tet")
      q.mesh_size = 0.6;
    q.curved_boundaries = "inner inside: sphere; inner outside: sphere";
    check_rates(
      "thick sphere, " + shape,
      q,
      {{"inner inside", [](const auto &x) { return off_sphere(x, 1.); }},
       {"inner outside", [](const auto &x) { return off_sphere(x, 1.5); }},
       {"inner zmin", [](const auto &x) { return x[2]; }},
       {"inner xmin", [](const auto &x) { return x[0]; }}},
      numbers::PI / 6. * (1.5 * 1.5 * 1.5 - 1.),
      4,
      shape == "hex" ? 2 : 0);
  }

  /// Rims that are on two surfaces: an oblique plane through a cylinder, and
  /// one beside the centre of a sphere.
  void
  check_rims()
  {
    MeshParameters q    = file_parameters(write_file("curved_cut.geo", R"(
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, -2, 0, 0, 4, 1};
Box(2) = {-3, -3, 0, 6, 6, 6};
Rotate{{0, 1, 0}, {0, 0, 0}, Pi/6}{ Volume{2}; }
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
MeshSize{:} = 0.8;
Physical Volume("stub") = {3};
side[] = Surface In BoundingBox{-1.1, -1.1, -2.1, 1.1, 1.1, 0.7};
Physical Surface("side") = {1};
Physical Surface("oblique") = {2};
Physical Surface("bottom") = {3};
)"));
    q.curved_boundaries = "side: cylinder";
    q.rotate            = {{0., 0., 90.}};
    check_rates("oblique cut",
                q,
                {{"side",
                  [](const auto &x) { return std::hypot(x[0], x[1]) - 1.; }},
                 {"bottom", [](const auto &x) { return x[2] + 2.; }},
                 {"oblique",
                  [](const auto &x) {
                    return x[2] * std::cos(numbers::PI / 6.) +
                           x[1] * std::sin(numbers::PI / 6.);
                  }}},
                2. * numbers::PI,
                4);

    q                   = file_parameters(write_file("curved_cap.geo", R"(
SetFactory("OpenCASCADE");
Sphere(1) = {1, 2, 3, 1};
Box(2) = {-3, -3, 3.5, 8, 8, 6};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
MeshSize{:} = 0.7;
Physical Volume("cap") = {3};
Physical Surface("round") = {1};
Physical Surface("lid") = {2};
)"));
    q.curved_boundaries = "round: sphere 1, 2, 3";
    const double h      = 1.5;
    check_rates("cap of a sphere",
                q,
                {{"round",
                  [](const auto &x) {
                    return x.distance(Point<3>(1., 2., 3.)) - 1.;
                  }},
                 {"lid", [](const auto &x) { return x[2] - 3.5; }}},
                numbers::PI * h * h * (3. - h) / 3.,
                4);
  }

  /// A torus from its STEP file.
  void
  check_step()
  {
    const std::string step = temporary_file("curved_torus.step");
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout.flush();
        const int out = dup(1), nothing = open("/dev/null", O_WRONLY);
        dup2(nothing, 1); // the writer of STEP files talks
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::model::occ::addTorus(0., 0., 0., 2., 0.7, -1, numbers::PI / 2.);
        gmsh::model::occ::synchronize();
        gmsh::write(step);
        gmsh::finalize();
        std::fflush(stdout);
        std::cout.flush();
        dup2(out, 1);
        close(out);
        close(nothing);
      }
    MPI_Barrier(MPI_COMM_WORLD);
    MeshParameters q    = file_parameters(step);
    q.mesh_size         = 0.7;
    q.curved_boundaries = "1: step " + step;
    q.translate         = {{1., 0., 0.}};
    check_rates("torus from STEP",
                q,
                {{"1",
                  [](const auto &x) {
                    return std::hypot(std::hypot(x[0] - 1., x[1]) - 2., x[2]) -
                           0.7;
                  }},
                 {"2", [](const auto &x) { return x[1] * (x[0] - 1.); }}},
                numbers::PI * numbers::PI * 0.49,
                3);
    q.curved_boundaries = "1: step nothing.step";
    refused("a STEP file that is missing", q, "'nothing.step' cannot");
  }

  void
  check_fits()
  {
    // two bores in one boundary, an axis in no special direction
    MeshParameters q    = file_parameters(write_file("curved_bores.geo", R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 6, 3, 1};
Cylinder(2) = {1.5, 1.5, -1, 0, 0, 3, 0.7};
Cylinder(3) = {4.5, 1.5, -1, 0, 0, 3, 0.9};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Rotate{{1, 2, 3}, {1, 0, 0}, 1}{ Volume{4}; }
MeshSize{:} = 0.6;
Physical Volume("plate") = {4};
Physical Surface("bores") = {7, 8};
Physical Surface("end") = {1};
)"));
    q.curved_boundaries = "bores: cylinder";
    const auto   mesh   = mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
    const auto   id     = mesh.names.boundaries.at("bores");
    double       off    = 0.;
    unsigned int n      = 0;
    for (const auto &face : mesh.faces.boundary_quads)
      if (face.boundary_id == id)
        for (const unsigned int v : face.vertices)
          {
            off =
              std::max(off,
                       std::abs(
                         mesh.shapes.at(id)->distance(mesh.vertices[v]).value));
            ++n;
          }
    verdict(mesh.shapes.size() == 1 && n > 100 && off < 1e-14,
            "two bores of one name are fitted each on its own",
            text(off));
    const std::string shape = mesh.shapes.at(id)->text();
    verdict(shape.find("2 surfaces") == 0 &&
              (shape.find("radius 0.7") != std::string::npos ||
               shape.find("radius 0.9") != std::string::npos),
            "radii",
            shape);

    const auto wrong = [&](const std::string &entry,
                           const std::string &message) {
      q.curved_boundaries = entry;
      refused(entry, q, message);
    };
    wrong("bores: sphere", "off the sphere with centre");
    wrong("bores: cylinder 0, 0, 0, 0, 0, 1", "off the cylinder with axis");
    wrong("end: sphere", "do not determine a sphere");
    wrong("end: cylinder", "do not determine a cylinder");
    wrong("boers: cylinder", "did you mean 'bores'?");
    wrong("bores: cone", "allowed: entries \"boundary: shape\"");
    wrong("bores", "has the entry 'bores'");
    wrong("bores: sphere 1, 2", "has the entry 'bores: sphere 1, 2'");
    wrong("bores: sphere 1, 2, x", "has the entry");
    wrong("bores: cylinder 0, 0, 0, 0, 0, 0", "has the entry");
    wrong("bores: step", "has the entry 'bores: step'");
    wrong("bores: cylinder; bores: sphere", "names 'bores' twice");
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_fits();
  check_thick_sphere("tet");
  check_thick_sphere("hex");
  check_rims();
  check_step();
}
