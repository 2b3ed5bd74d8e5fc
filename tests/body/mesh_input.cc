// Every wrong parameter of a mesh is refused with a message that says where,
// what and what is allowed, the same from validation and from meshing.

#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/body/mesh/mesh_source.h>
#include <verdict.h>

#include <functional>
#include <iostream>
#include <limits>

using namespace mortise;

namespace
{
  MeshParameters
  make(const std::string               &source,
       const std::vector<double>       &extent,
       const std::vector<unsigned int> &subdivisions)
  {
    MeshParameters q;
    q.source       = source;
    q.extent       = extent;
    q.subdivisions = subdivisions;
    return q;
  }

  void
  refused(const MeshParameters &q, const std::vector<std::string> &fragments)
  {
    const std::string first =
      message_of([&] { validate(q, "Body inner, Mesh"); });
    const std::string second =
      message_of([&] { create_mesh(q, MPI_COMM_WORLD, "Body inner, Mesh"); });
    bool good = first == second && first.find("Body inner, Mesh: ") == 0;
    for (const std::string &fragment : fragments)
      good = good && first.find(fragment) != std::string::npos;
    verdict(good,
            "refused: " + (good ? first.substr(18) : first),
            "\"" + second + "\"");
  }

  void
  refused_with(MeshParameters                               q,
               const std::function<void(MeshParameters &)> &change,
               const std::vector<std::string>              &fragments)
  {
    change(q);
    refused(q, fragments);
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MeshParameters box   = make("box", {0., 0., 0., 1., 1., 1.}, {2, 2, 2});
  const MeshParameters shell = make("shell octant", {1., 1.5}, {4, 2});
  const MeshParameters curved =
    make("curved block", {0., 0., 0., 1., 1., 1.}, {2, 2, 1, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();

  refused(make("shell octants", {1., 1.5}, {4, 2}),
          {"did you mean 'shell octant'", "cylinder sector"});
  refused(make("box", {1., 2.}, {1, 1, 1}),
          {"Extent = 1, 2;", "6 numbers, x0, y0"});
  refused(make("box", {}, {1, 1, 1}), {"Extent = (nothing)"});
  refused(make("box", {0., 0., 0., 1., 1., 1.}, {2}),
          {"Subdivisions", "Subdivisions = 2;", "nx, ny, nz"});
  refused(make("box", {0., 0., 0., 1., 1., 1.}, {2, 0, 2}),
          {"Subdivisions = 2, 0, 2", "1 to 10000"});
  refused(make("box", {0., 0., 0., 1., 1., 1.}, {2000, 2000, 2000}),
          {"20 million"});
  refused(make("box", {0., 0., 0., 1., -1., 1.}, {2, 2, 2}), {"y0 < y1"});
  refused(make("box", {0., 0., 0., 1., nan, 1.}, {2, 2, 2}), {"not finite"});
  refused(make("shell octant", {1.5, 1.}, {2, 2}), {"0 < r_in < r_out"});
  refused(make("shell octant", {0., 1.}, {2, 2}), {"0 < r_in < r_out"});
  refused(make("cylinder sector", {1., 2., 0.}, {2, 2, 2}), {"length > 0"});
  refused(make("cylinder sector", {1., 2.}, {2, 2, 2}),
          {"r_in, r_out, length"});
  refused(make("curved block", {0., 0., 0., 1., 1., 1.}, {2, 2, 2}),
          {"nz_lower, nz_upper"});
  refused(make("file", {1.}, {}), {"Extent = 1; allowed: nothing"});

  refused_with(box,
               [](auto &q) {
                 q.cells       = "tetrahedra";
                 q.refine_near = "0, 0, 0, 1, 1";
               },
               {"cannot be refined locally", "Degree near"});
  refused_with(box,
               [](auto &q) { q.cells = "hexahedron"; },
               {"did you mean 'hexahedra'"});
  refused_with(box,
               [](auto &q) { q.file = "a.msh"; },
               {"belongs to Source = file"});
  refused_with(box,
               [](auto &q) { q.part = "core"; },
               {"Part = 'core' belongs to Source = file"});
  refused_with(box,
               [](auto &q) { q.mesh_size = 0.25; },
               {"Mesh size = '0.25' belongs to Source = file"});
  refused_with(box,
               [](auto &q) { q.curved_boundaries = "zmin: sphere"; },
               {"Curved boundaries", "belongs to Source = file"});
  refused_with(box,
               [](auto &q) { q.distort = 0.4; },
               {"Distort = 0.4", "0 to 0.3"});
  refused_with(box,
               [](auto &q) {
                 q.top_slope = {{-1.5, 0.}};
               },
               {"the top meets the bottom"});
  refused_with(box,
               [](auto &q) { q.amplitude = 0.1; },
               {"belongs to Source = curved block"});
  refused_with(box, [](auto &q) { q.refinements = 15; }, {"14 in all"});
  refused_with(box,
               [](auto &q) {
                 q.rotate[1] = std::numeric_limits<double>::infinity();
               },
               {"Rotate"});
  refused_with(box,
               [](auto &q) { q.refine_near = "0, 0, 0, 1"; },
               {"'0, 0, 0, 1'", "x, y, z, radius, times"});
  refused_with(box,
               [](auto &q) { q.refine_near = "0, 0, 0, 1, 1.5"; },
               {"whole number"});
  refused_with(box,
               [](auto &q) { q.refine_near = "0,0,0,1,1; a,0,0,1,1"; },
               {"'a,0,0,1,1'"});
  refused_with(box,
               [](auto &q) { q.refine_near = "0, 0, 0, -1, 1"; },
               {"radius > 0"});
  refused_with(shell,
               [](auto &q) { q.distort = 0.1; },
               {"belongs to Source = box"});
  refused_with(shell,
               [](auto &q) {
                 q.top_slope = {{0.1, 0.}};
               },
               {"belong to Source = box"});
  refused_with(curved,
               [](auto &q) { q.half = "top"; },
               {"Half = 'top'", "lower, upper, both"});
  refused_with(curved,
               [](auto &q) { q.surface = "bumb"; },
               {"did you mean 'bump'", "saddle"});
  refused_with(curved,
               [](auto &q) { q.amplitude = 0.46; },
               {"Amplitude = 0.46", "0.45"});
  refused_with(curved,
               [](auto &q) { q.middle = 1.; },
               {"Middle = 1", "between 0 and 1"});
}
