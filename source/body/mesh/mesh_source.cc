#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/curved_boundaries.h>
#include <mortise/body/mesh/mesh_file.h>
#include <mortise/body/mesh/mesh_source.h>
#include <mortise/body/mesh/tetrahedra.h>

#include <algorithm>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The edges of a cell, from deal.II's line vertex 0 to 1, must run the
    /// same way in all cells.
    bool
    consistently_ordered(const std::vector<CellData<3>> &cells)
    {
      std::vector<std::array<unsigned int, 3>>
        edges; // smaller vertex, larger vertex, direction
      edges.reserve(12 * cells.size());
      for (const CellData<3> &cell : cells)
        for (unsigned int line = 0; line < 12; ++line)
          {
            const unsigned int a =
              cell.vertices[GeometryInfo<3>::line_to_cell_vertices(line, 0)];
            const unsigned int b =
              cell.vertices[GeometryInfo<3>::line_to_cell_vertices(line, 1)];
            edges.push_back({{std::min(a, b), std::max(a, b), a < b}});
          }
      std::sort(edges.begin(), edges.end());
      return std::adjacent_find(edges.begin(),
                                edges.end(),
                                [](const auto &e, const auto &f) {
                                  return e[0] == f[0] && e[1] == f[1] &&
                                         e[2] != f[2];
                                }) == edges.end();
    }

    /// Order the cells so that a face between two of them is at most
    /// transposed; a mesh that has no such order has one after a uniform
    /// refinement. Throws if even that fails.
    void
    order_cells(CoarseMesh &mesh, const std::string &where)
    {
      if (consistently_ordered(mesh.cells))
        return;
      std::vector<CellData<3>> ordered = mesh.cells;
      GridTools::consistently_order_cells(ordered);
      if (!consistently_ordered(ordered))
        {
          Triangulation<3> serial;
          create_coarse_triangulation(mesh, serial);
          serial.refine_global(1);
          Triangulation<3> flat;
          GridGenerator::flatten_triangulation(serial, flat);
          std::tie(mesh.vertices, ordered, mesh.faces) =
            GridTools::get_coarse_mesh_description(flat);
          if (mesh.geometry != nullptr)
            {
              auto refined =
                std::make_shared<CoarseGeometry>(mesh.geometry->refined());
              refined->place_vertices(ordered, mesh.vertices);
              mesh.geometry = refined;
            }
          GridTools::consistently_order_cells(ordered);
          if (!consistently_ordered(ordered))
            throw InputError(
              where +
              ": the cells of the mesh cannot be ordered consistently, not even after "
              "one uniform refinement");
        }
      mesh.cells = ordered;
    }

    /// Vertices at the ends of the three edges at vertex @p v, such that their
    /// directions are right-handed in a cell of positive volume.
    std::array<unsigned int, 3>
    edge_ends(const unsigned int v, const bool tetrahedron)
    {
      if (!tetrahedron)
        {
          std::array<unsigned int, 3> ends = {{v ^ 1, v ^ 2, v ^ 4}};
          if ((v % 2 + v / 2 % 2 + v / 4) % 2 == 1)
            std::swap(ends[0], ends[1]);
          return ends;
        }
      constexpr unsigned int others[4][3] = {{1, 2, 3},
                                             {0, 3, 2},
                                             {0, 1, 3},
                                             {0, 2, 1}};
      return {{others[v][0], others[v][1], others[v][2]}};
    }

    /// The Jacobian determinant is positive in all corners of all cells.
    void
    check_shapes(const CoarseMesh &mesh, const std::string &where)
    {
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          const auto &vertices    = mesh.cells[c].vertices;
          const bool  tetrahedron = vertices.size() == 4;
          for (unsigned int v = 0; v < vertices.size(); ++v)
            {
              Tensor<2, 3> edges;
              const auto   ends = edge_ends(v, tetrahedron);
              for (unsigned int d = 0; d < 3; ++d)
                edges[d] =
                  mesh.vertices[vertices[ends[d]]] - mesh.vertices[vertices[v]];
              if (determinant(edges) > 0.)
                continue;
              std::ostringstream message;
              message << where << ": cell " << c << " near ("
                      << mesh.vertices[vertices[v]]
                      << ") is turned inside out; allowed: "
                      << (tetrahedron ? "tetrahedra of positive volume" :
                                        "convex hexahedra");
              throw InputError(message.str());
            }
        }
    }

    bool
    is_tetrahedral(const CoarseMesh &mesh)
    {
      return mesh.cells.front().vertices.size() == 4;
    }

    CoarseMesh
    coarse_mesh(const MeshParameters &parameters,
                const std::string    &where,
                const MPI_Comm        comm)
    {
      CoarseMesh mesh = parameters.source == "file" ?
                          read_mesh_file(parameters, where, comm) :
                          generate(parameters);
      if (parameters.source != "file" && parameters.cells == "tetrahedra")
        mesh = cut_into_tetrahedra(
          refine_uniformly(std::move(mesh), parameters.refinements));
      else if (is_tetrahedral(mesh))
        for (unsigned int time = 0; time < parameters.refinements; ++time)
          mesh = refine_tetrahedra(mesh);
      if (!is_tetrahedral(mesh) && parameters.source == "file")
        order_cells(mesh, where);
      Assert(is_tetrahedral(mesh) || consistently_ordered(mesh.cells),
             ExcMessage("generators order their cells"));
      check_shapes(mesh, where);
      return mesh;
    }

    /// Refine as often as @p ball says all cells that it touches.
    void
    refine_near(const Ball        &ball,
                HexTriangulation  &triangulation,
                const std::string &where)
    {
      for (unsigned int time = 0; time < ball.number; ++time)
        {
          unsigned int n_flagged = 0;
          for (const auto &cell : triangulation.active_cell_iterators())
            if (cell->is_locally_owned() && ball.touches(cell))
              {
                cell->set_refine_flag();
                ++n_flagged;
              }
          if (Utilities::MPI::sum(n_flagged,
                                  triangulation.get_communicator()) == 0)
            fail_untouched(ball, where + ": Refine near");
          triangulation.execute_coarsening_and_refinement();
        }
    }

    std::unique_ptr<HexTriangulation>
    distribute_hexahedra(const CoarseMesh     &mesh,
                         const MeshParameters &parameters,
                         const MPI_Comm        comm,
                         const std::string    &where)
    {
      auto triangulation = std::make_unique<HexTriangulation>(comm);
      create_coarse_triangulation(mesh, *triangulation);
      const auto balls = refinement_balls(parameters, where);
      if (!mesh.shapes.empty() &&
          (parameters.refinements > 0 || !balls.empty() ||
           parameters.is_refined_later))
        blend_into_cells(*triangulation);
      triangulation->refine_global(parameters.refinements);
      if (mesh.geometry != nullptr)
        mesh.geometry->place_vertices(*triangulation);
      for (const Ball &ball : balls)
        {
          refine_near(ball, *triangulation, where);
          if (mesh.geometry != nullptr)
            mesh.geometry->place_vertices(*triangulation);
        }
      return triangulation;
    }
  } // namespace

  Mesh
  create_mesh(const MeshParameters        &parameters,
              const MPI_Comm               comm,
              const std::string           &where,
              const std::set<std::string> &interfaces)
  {
    validate(parameters, where);
    CoarseMesh coarse = coarse_mesh(parameters, where, comm);
    if (is_tetrahedral(coarse) && !parameters.refine_near.empty())
      throw InputError(
        where + ": Refine near = " + in_quotes(parameters.refine_near, '\'') +
        " belongs to hexahedra, but " + file_in_quotes(parameters.file, '\'') +
        " has tetrahedra, which cannot be refined locally; try Degree "
        "near, Refinements, or a gmsh file whose mesh size varies");

    Mesh mesh;
    mesh.names      = coarse.names;
    mesh.tetrahedra = is_tetrahedral(coarse);
    mesh.geometry   = coarse.geometry;
    mesh.remark     = coarse.remark;
    mesh.warnings   = coarse.findings.warnings();
    mesh.curved     = coarse.manifold != nullptr || !coarse.shapes.empty() ||
                  coarse.geometry != nullptr;
    std::set<types::boundary_id> balanced;
    for (const auto &[name, id] : mesh.names.boundaries)
      if (interfaces.count(name) > 0)
        balanced.insert(id);
    if (mesh.tetrahedra)
      mesh.triangulation =
        distribute_tetrahedra(std::move(coarse), balanced, comm);
    else
      {
        mesh.triangulation =
          distribute_hexahedra(coarse, parameters, comm, where);
        mesh.lattice = std::move(coarse.lattice);
      }
    return mesh;
  }
} // namespace mortise
