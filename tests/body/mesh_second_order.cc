// The curved geometry of second-order files is kept: a quadratic displacement
// of a mesh is reproduced exactly by the mapping, in tetrahedra and hexahedra,
// refined globally and locally, and in tetrahedra that were cut from hexahedra,
// wedges and pyramids, on all ranks.

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_values.h>

#include <mortise/body/body.h>
#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/fe_simplex_legendre.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <verdict.h>

#include <array>
#include <cmath>

#include "gmsh_meshes.h"

using namespace dealii;
using namespace gmsh_test;
using mortise::Body;
using mortise::MeshParameters;

namespace
{
  enum class Shapes
  {
    hexahedra,
    wedges,
    tetrahedra
  };

  /// A cube: @p n hexahedra, or two triangles in place of a square, in each
  /// direction.
  std::string
  cube(const Shapes shapes, const std::array<unsigned, 3> &n)
  {
    const auto text = [&](const unsigned int d, const unsigned int more) {
      return std::to_string(n[d] + more);
    };
    return std::string(R"(
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 3} = )") +
           text(0, 1) + "; Transfinite Curve{2, 4} = " + text(1, 1) + R"(;
Transfinite Surface{1};
)" + (shapes == Shapes::hexahedra ? "Recombine Surface{1};\n" : "") +
           "core[] = Extrude{0, 0, 1}{ Surface{1}; Layers{" + text(2, 0) +
           "}; " + (shapes == Shapes::tetrahedra ? "" : "Recombine;") + R"(};
Physical Volume("cube") = {core[1]};
Physical Surface("low") = {1};
Physical Surface("high") = {core[0]};
)";
  }

  /// A cube of hexahedra below, pyramids on them and tetrahedra above.
  const std::string cube_with_pyramids = R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 0.5}; Box(2) = {0, 0, 0.5, 1, 1, 0.5}; Coherence;
Transfinite Curve{:} = 4;
sides[] = Boundary{ Volume{1}; };
Transfinite Surface{sides[]}; Recombine Surface{sides[]};
Transfinite Volume{1};
Physical Volume("cube") = {1, 2};
Physical Surface("low") = {Surface In BoundingBox{-1, -1, -0.1, 2, 2, 0.1}};
)";

  /// A mesh of @p geometry whose nodes were moved by x + bend(x).
  std::string
  bent(const std::string &geometry, const bool serendipity)
  {
    const std::string name =
      write_mesh("second_order", geometry, {2.2, false, 2, serendipity, false});
    // the nodes of version 2.2 stand one on a line: tag x y z
    std::istringstream in(read_file(name));
    std::ostringstream out;
    out.precision(17);
    std::string line;
    while (std::getline(in, line))
      {
        out << line << "\n";
        if (line != "$Nodes")
          continue;
        std::getline(in, line);
        out << line << "\n";
        for (int i = 0, n = std::stoi(line); i < n; ++i)
          {
            std::getline(in, line);
            std::istringstream numbers(line);
            int                tag;
            double             x, y, z;
            numbers >> tag >> x >> y >> z;
            out << tag << " " << x + 0.2 * y * z << " " << y + 0.3 * z * z
                << " " << z + 0.2 * x * x - 0.1 * x * y << "\n";
          }
      }
    return write_file("second_order_bent.msh", out.str());
  }

  /// Determinant of the gradient of that map.
  double
  determinant_at(const Point<3> &x)
  {
    Tensor<2, 3> J;
    J[0] = Point<3>(1., 0.2 * x[2], 0.2 * x[1]);
    J[1] = Point<3>(0., 1., 0.6 * x[2]);
    J[2] = Point<3>(0.4 * x[0] - 0.1 * x[1], -0.1 * x[0], 1.);
    return determinant(J);
  }

  double
  exact_volume()
  {
    const QGauss<3> rule(3);
    double          sum = 0.;
    for (unsigned int q = 0; q < rule.size(); ++q)
      sum += rule.weight(q) * determinant_at(rule.point(q));
    return sum;
  }

  /// Distance of @p point from the bent bottom z = 0, where
  /// (x, y, 0) goes to (x, y, 0.2 x^2 - 0.1 x y).
  double
  off_bottom(const Point<3> &point)
  {
    return point[2] - 0.2 * point[0] * point[0] + 0.1 * point[0] * point[1];
  }

  struct Measured
  {
    double volume = 0., bottom = 0., vertices = 0.;
  };

  Measured
  measure(const MeshParameters &q)
  {
    Body body("body", 0, mortise::LinearElastic());
    body.create_mesh(q, MPI_COMM_WORLD, "Mesh", {});
    body.create_space(1, {}, "Mesh");
    std::unique_ptr<FiniteElement<3>> fe;
    if (body.mesh.tetrahedra)
      fe = std::make_unique<mortise::FE_SimplexLegendre>(1);
    else
      fe = std::make_unique<mortise::FE_Legendre>(1);
    const Quadrature<3> rule      = body.mesh.tetrahedra ?
                                      mortise::simplex_quadrature<3>(8) :
                                      Quadrature<3>(QGauss<3>(5));
    const Quadrature<2> face_rule = body.mesh.tetrahedra ?
                                      mortise::simplex_quadrature<2>(4) :
                                      Quadrature<2>(QGauss<2>(3));
    FEValues<3>         values(*body.mapping, *fe, rule, update_JxW_values);
    FEFaceValues<3>     faces(*body.mapping,
                          *fe,
                          face_rule,
                          update_quadrature_points);
    Measured            result;
    for (const auto &cell : body.triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          for (const unsigned int i : values.quadrature_point_indices())
            result.volume += values.JxW(i);
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->boundary_id() ==
                  body.mesh.names.boundaries.at("low") &&
                cell->at_boundary(f))
              {
                faces.reinit(cell, f);
                for (const auto &x : faces.get_quadrature_points())
                  result.bottom =
                    std::max(result.bottom, std::abs(off_bottom(x)));
                for (unsigned int v = 0; v < cell->face(f)->n_vertices(); ++v)
                  result.vertices =
                    std::max(result.vertices,
                             std::abs(off_bottom(cell->face(f)->vertex(v))));
              }
        }
    result.volume   = Utilities::MPI::sum(result.volume, MPI_COMM_WORLD);
    result.bottom   = Utilities::MPI::max(result.bottom, MPI_COMM_WORLD);
    result.vertices = Utilities::MPI::max(result.vertices, MPI_COMM_WORLD);
    return result;
  }

  void
  check(const std::string &what, MeshParameters q, const double volume)
  {
    const Measured     got = measure(q);
    std::ostringstream text;
    text << std::abs(got.volume / volume - 1.) << " " << got.bottom << " "
         << got.vertices;
    verdict(std::abs(got.volume / volume - 1.) < 1e-13,
            what + ": volume to 1e-13",
            text.str());
    verdict(got.bottom < 1e-13 && got.vertices < 1e-13,
            what + ": points and vertices on the bent boundary to 1e-13",
            text.str());
  }

  void
  check_shape(const std::string &shape,
              const std::string &file,
              const std::string &cells = "auto")
  {
    MeshParameters q = file_parameters(file);
    q.cells          = cells;
    check(shape, q, exact_volume());
    q.refinements = 1;
    check(shape + ", refined", q, exact_volume());
    q.refinements = 2;
    check(shape + ", refined twice", q, exact_volume());
    if (shape.find(" x ") == 1)
      {
        q.refinements = 1;
        q.refine_near = "0, 0, 0, 0.1, 2";
        check(shape + ", refined near", q, exact_volume());
      }
    q.refine_near       = "";
    q.curved_boundaries = "low: sphere";
    refused(shape + " with Curved boundaries",
            q,
            "is of second order, whose own curved geometry is kept");
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // p4est permutes coarse cells, in another way for each of these
  const std::string complete =
    bent(cube(Shapes::hexahedra, {{3, 3, 1}}), false);
  check_shape("3 x 3 x 1 hexahedra of 27 nodes", complete);
  check_shape("hexahedra of 27 nodes, cut", complete, "tetrahedra");
  // the map is of degree 2 in all, so that serendipity has it, too
  const std::string serendipity =
    bent(cube(Shapes::hexahedra, {{2, 3, 4}}), true);
  check_shape("2 x 3 x 4 hexahedra of 20 nodes", serendipity);
  check_shape("hexahedra of 20 nodes, cut", serendipity, "tetrahedra");
  check_shape("tetrahedra", bent(cube(Shapes::tetrahedra, {{2, 3, 2}}), false));
  check_shape("wedges of 18 nodes",
              bent(cube(Shapes::wedges, {{2, 3, 2}}), false));
  check_shape("wedges of 15 nodes",
              bent(cube(Shapes::wedges, {{3, 2, 2}}), true));
  check_shape("pyramids of 13 nodes", bent(cube_with_pyramids, true));
}
