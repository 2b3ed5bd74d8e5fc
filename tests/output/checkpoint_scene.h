// Bodies of all kinds with two interfaces, for tests of checkpoints, and
// verdicts on messages.
#pragma once

#include <mortise/output/checkpoint.h>
#include <verdict.h>

#include <map>

#include "../body/gmsh_meshes.h"

namespace mortise::testing
{
  using namespace dealii;

  struct GivenBody
  {
    std::string                                name;
    MeshParameters                             mesh;
    unsigned int                               degree = 2;
    bool                                       mixed  = false;
    std::map<types::material_id, unsigned int> regions{};
  };

  struct GivenInterface
  {
    std::string  name;
    unsigned int slave;
    std::string  slave_boundary;
    unsigned int master;
    std::string  master_boundary;
  };

  struct Given
  {
    std::vector<GivenBody>      bodies;
    std::vector<GivenInterface> interfaces;
  };

  /// Spread over a communicator, with interfaces that are not integrated.
  struct Scene
  {
    Scene(const Given &given, const MPI_Comm comm)
      : comm(comm)
    {
      std::vector<const DoFHandler<dim> *>   handlers;
      std::vector<AffineConstraints<double>> constraints(given.bodies.size());
      for (unsigned int b = 0; b < given.bodies.size(); ++b)
        {
          const GivenBody &own = given.bodies[b];
          bodies.push_back(std::make_unique<Body>(
            own.name, b, LinearElastic{1., 0.3, own.mixed}));
          bodies[b]->create_mesh(own.mesh, comm, own.name);
          bodies[b]->create_space(own.degree, own.regions, own.name);
          handlers.push_back(&bodies[b]->dof_handler);
          constraints[b].copy_from(bodies[b]->conformity);
        }
      const FieldNumbering numbering(handlers, comm);
      const auto           all = scene_constraints(numbering, constraints);
      const auto surface = [&](const unsigned int b, const std::string &name) {
        return extract_surface(*bodies[b],
                               boundary_faces(*bodies[b],
                                              bodies[b]->boundary_id(name, "")),
                               numbering,
                               all);
      };
      for (const GivenInterface &own : given.interfaces)
        {
          couplings.emplace_back();
          couplings.back().interface = std::make_unique<InterfaceHandler>(
            own.name,
            surface(own.slave, own.slave_boundary),
            surface(own.master, own.master_boundary),
            InterfaceOptions(),
            comm);
        }
    }

    MPI_Comm              comm;
    Bodies                bodies;
    std::vector<Coupling> couplings;
  };

  /// A cube of tetrahedra, or of 2 x 2 x 3 second-order hexahedra.
  inline std::string
  gmsh_mesh(const bool hexahedra)
  {
    const std::string square = R"(
Point(1) = {0, 0, 0, 0.5};
Point(2) = {1, 0, 0, 0.5};
Point(3) = {1, 1, 0, 0.5};
Point(4) = {0, 1, 0, 0.5};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
)";
    const std::string layers = hexahedra ? R"(
Transfinite Curve{1, 2, 3, 4} = 3;
Transfinite Surface{1};
Recombine Surface{1};
out[] = Extrude {0, 0, 1} {Surface{1}; Layers{3}; Recombine;};
)" :
                                           R"(
out[] = Extrude {0, 0, 1} {Surface{1};};
)";
    const std::string names  = R"(
Physical Volume("solid") = {out[1]};
Physical Surface("bottom") = {1};
Physical Surface("top") = {out[0]};
Physical Surface("side") = {out[2]};
)";
    gmsh_test::Format format;
    format.version = 2.2;
    format.order   = hexahedra ? 2 : 1;
    return gmsh_test::write_mesh(hexahedra ? "hexahedra" : "tetrahedra",
                                 square + layers + names,
                                 format);
  }

  inline MeshParameters
  box(const std::vector<double>       &extent,
      const std::vector<unsigned int> &subdivisions)
  {
    MeshParameters mesh;
    mesh.extent       = extent;
    mesh.subdivisions = subdivisions;
    return mesh;
  }

  enum : unsigned int
  {
    inner, ///< curved hexahedra, hanging nodes, degrees by region, pressures
    outer, ///< curved tetrahedra, degrees by region, pressures
    block, ///< tetrahedra of a file
    solid, ///< second-order hexahedra of a file
    brick, ///< one cell
    bar    ///< two cells of different degrees
  };

  inline Given
  given_scene()
  {
    MeshParameters shell;
    shell.source       = "shell octant";
    shell.extent       = {1., 1.5};
    shell.subdivisions = {2, 1};
    shell.refine_near  = "0, 0, 1.5, 0.4, 1";
    MeshParameters cover;
    cover.source              = "shell octant";
    cover.extent              = {1.5, 2.};
    cover.subdivisions        = {2, 1};
    cover.cells               = "tetrahedra";
    MeshParameters tetrahedra = gmsh_test::file_parameters(gmsh_mesh(false));
    tetrahedra.translate      = {{10., 0., 0.}};
    MeshParameters hexahedra  = gmsh_test::file_parameters(gmsh_mesh(true));
    hexahedra.translate       = {{20., 0., 0.}};
    return {{{"inner", shell, 2, true, {{0, 2}, {1, 4}, {2, 3}}},
             {"outer", cover, 2, true, {{0, 3}, {1, 2}, {2, 4}}},
             {"block", tetrahedra, 3},
             {"solid", hexahedra, 2},
             {"brick", box({10., 0., 1., 11., 1., 2.}, {1, 1, 1}), 1},
             {"bar",
              box({0., 0., 5., 2., 1., 6.}, {2, 1, 1}),
              2,
              false,
              {{0, 2}, {1, 3}}}},
            {{"glue", inner, "outside", outer, "inside"},
             {"seam", block, "top", brick, "zmin"}}};
  }

} // namespace mortise::testing
