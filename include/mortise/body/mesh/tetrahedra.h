// Meshes of tetrahedra: hexahedra cut into them, and the distributed
// triangulation made of them.
#pragma once

#include <deal.II/distributed/tria_base.h>

#include <mortise/body/mesh/generators.h>

#include <memory>
#include <set>

namespace mortise
{
  /// Cut each hexahedron into six tetrahedra (cell_cutting.h).
  CoarseMesh
  cut_into_tetrahedra(CoarseMesh hexahedra);

  /// Refine all cells of @p mesh @p times times, following its manifold.
  CoarseMesh
  refine_uniformly(CoarseMesh mesh, unsigned int times);

  /// Cut each tetrahedron into eight, the inner octahedron along its shortest
  /// diagonal; middles of edges follow curved boundaries or the mesh's curved
  /// geometry.
  CoarseMesh
  refine_tetrahedra(const CoarseMesh &mesh);

  /// The triangulation of @p mesh (tetrahedra in any numbering, the same on
  /// all ranks), spread over the ranks by partition_cells(). Each rank holds
  /// the whole coarse mesh while this runs. Collective.
  std::unique_ptr<dealii::parallel::DistributedTriangulationBase<3>>
  distribute_tetrahedra(CoarseMesh                                  mesh,
                        const std::set<dealii::types::boundary_id> &balanced,
                        MPI_Comm                                    comm);
} // namespace mortise
