#include <deal.II/base/mpi.h>

#include <deal.II/distributed/fully_distributed_tria.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <mortise/body/mesh/curved_boundaries.h>
#include <mortise/body/mesh/partition.h>
#include <mortise/body/mesh/tetrahedra.h>
#include <mortise/body/mesh/vertex_order.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Triangle = std::array<unsigned int, 3>;

    /// @p quad: vertices in deal.II's order.
    std::array<Triangle, 2>
    cut_quadrilateral(const std::array<unsigned int, 4> &quad)
    {
      std::array<unsigned int, 4> around = {
        {quad[0], quad[1], quad[3], quad[2]}};
      std::rotate(around.begin(),
                  std::min_element(around.begin(), around.end()),
                  around.end());
      return {{{{around[0], around[1], around[2]}},
               {{around[0], around[2], around[3]}}}};
    }

    void
    cut_hexahedron(const CellData<3>        &hexahedron,
                   std::vector<CellData<3>> &cells)
    {
      const auto        &vertices = hexahedron.vertices;
      const unsigned int lowest =
        *std::min_element(vertices.begin(), vertices.end());
      for (const unsigned int f : GeometryInfo<3>::face_indices())
        {
          std::array<unsigned int, 4> face;
          for (unsigned int v = 0; v < 4; ++v)
            face[v] = vertices[GeometryInfo<3>::face_to_cell_vertices(f, v)];
          if (std::find(face.begin(), face.end(), lowest) == face.end())
            for (const Triangle &base : cut_quadrilateral(face))
              {
                CellData<3> cell(4);
                cell.vertices = {lowest, base[0], base[1], base[2]};
                if (f % 2 == 0) // seen from inside, deal.II's order goes round
                  std::swap(cell.vertices[2], cell.vertices[3]);
                cell.material_id = hexahedron.material_id;
                cells.push_back(cell);
              }
        }
    }
  } // namespace

  CoarseMesh
  cut_into_tetrahedra(CoarseMesh mesh)
  {
    std::vector<CellData<3>> cells;
    for (const CellData<3> &cell : mesh.cells)
      cut_hexahedron(cell, cells);
    mesh.cells.swap(cells);

    std::vector<CellData<2>> triangles;
    for (const CellData<2> &quad : mesh.faces.boundary_quads)
      for (const Triangle &part : cut_quadrilateral({{quad.vertices[0],
                                                      quad.vertices[1],
                                                      quad.vertices[2],
                                                      quad.vertices[3]}}))
        {
          CellData<2> triangle(3);
          std::copy(part.begin(), part.end(), triangle.vertices.begin());
          triangle.boundary_id = quad.boundary_id;
          triangles.push_back(triangle);
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
