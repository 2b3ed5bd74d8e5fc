#include <deal.II/base/mpi.h>

#include <deal.II/distributed/fully_distributed_tria.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <mortise/body/mesh/cell_cutting.h>
#include <mortise/body/mesh/curved_boundaries.h>
#include <mortise/body/mesh/partition.h>
#include <mortise/body/mesh/tetrahedra.h>
#include <mortise/body/mesh/vertex_order.h>

#include <utility>

namespace mortise
{
  using namespace dealii;

  CoarseMesh
  cut_into_tetrahedra(CoarseMesh mesh)
  {
    std::vector<CellData<3>> cells;
    for (const CellData<3> &hexahedron : mesh.cells)
      {
        const std::vector<unsigned int> vertices = around(hexahedron.vertices);
        for (const auto &part : cut_cell(vertices))
          {
            CellData<3> cell(4);
            for (unsigned int v = 0; v < 4; ++v)
              cell.vertices[v] = vertices[part[v]];
            cell.material_id = hexahedron.material_id;
            cells.push_back(cell);
          }
      }
    mesh.cells.swap(cells);

    std::vector<CellData<2>> triangles;
    for (const CellData<2> &quad : mesh.faces.boundary_quads)
      {
        const std::vector<unsigned int> vertices = around(quad.vertices);
        for (const auto &part : cut_quadrilateral(
               {{vertices[0], vertices[1], vertices[2], vertices[3]}}))
          {
            CellData<2> triangle(3);
            for (unsigned int v = 0; v < 3; ++v)
              triangle.vertices[v] = vertices[part[v]];
            triangle.boundary_id = quad.boundary_id;
            triangles.push_back(triangle);
          }
      }
    mesh.faces.boundary_quads.swap(triangles);
    mesh.faces.boundary_lines.clear();
    return mesh;
  }

  CoarseMesh
  refine_uniformly(CoarseMesh mesh, const unsigned int times)
  {
    if (times == 0)
      return mesh;
    Triangulation<3> serial, flat;
    create_coarse_triangulation(mesh, serial);
    serial.refine_global(times);
    GridGenerator::flatten_triangulation(serial, flat);
    std::tie(mesh.vertices, mesh.cells, mesh.faces) =
      GridTools::get_coarse_mesh_description(flat);
    return mesh;
  }

  std::unique_ptr<parallel::DistributedTriangulationBase<3>>
  distribute_tetrahedra(CoarseMesh                          mesh,
                        const std::set<types::boundary_id> &balanced,
                        const MPI_Comm                      comm)
  {
    order_vertices(mesh.vertices, mesh.cells);
    Triangulation<3> serial;
    const Manifolds  curved = create_coarse_triangulation(mesh, serial);

    partition_cells(Utilities::MPI::n_mpi_processes(comm), balanced, serial);

    auto triangulation =
      std::make_unique<parallel::fullydistributed::Triangulation<3>>(comm);
    if (mesh.manifold != nullptr)
      triangulation->set_manifold(0, *mesh.manifold);
    for (const auto &[id, manifold] : curved)
      triangulation->set_manifold(id, *manifold);
    triangulation->create_triangulation(
      TriangulationDescription::Utilities::
        create_description_from_triangulation(serial, comm));
    return triangulation;
  }
} // namespace mortise
