// Coarse hexahedral meshes of simple bodies as plain data in coordinates before
// Rotate and Translate, from input that was checked.
#pragma once

#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria_description.h>

#include <mortise/body/mesh/coarse_geometry.h>
#include <mortise/body/mesh/lattice_coarsening.h>
#include <mortise/body/mesh/mesh_findings.h>
#include <mortise/body/mesh/mesh_source.h>
#include <mortise/body/mesh/surfaces.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace mortise
{
  /// Vertices, cells and boundary faces before a triangulation is made of them.
  struct CoarseMesh
  {
    std::vector<dealii::Point<3>>    vertices;
    std::vector<dealii::CellData<3>> cells;
    dealii::SubCellData              faces; ///< boundary faces with their ids
    MeshNames                        names;
    std::vector<LatticeBlock> lattice; ///< that has all vertices, or none

    /// Geometry of all entities, moved like the vertices; none: flat.
    std::unique_ptr<dealii::Manifold<3>> manifold;

    /// True shapes of curved boundaries, moved like the vertices; the other
    /// faces are flat.
    std::map<dealii::types::boundary_id, SurfacePointer> shapes;

    /// Curved geometry of second-order cells, moved like the vertices; none:
    /// the cells are of first order.
    std::shared_ptr<const CoarseGeometry> geometry;

    /// Indices into faces.boundary_quads by the name of a set of the file that
    /// overlaps another one, so that it is no boundary by itself.
    std::map<std::string, std::vector<std::size_t>> overlapping_sets;

    std::string remark; ///< what became of the cells of a file; empty: nothing

    /// Of a file, as long as it is read: numbers that cells and vertices have
    /// there, and what is wrong.
    std::vector<std::size_t> cell_numbers, vertex_numbers;
    MeshFindings             findings;
  };

  /// The body described by @p parameters (any source but file), vertices already moved.
  CoarseMesh
  generate(const MeshParameters &parameters);

  /// Boundary names of a generator, in the order of their ids, from 1 on.
  std::vector<std::string>
  generator_boundaries(const MeshParameters &parameters);

  /// Names of the generators ("Source" but file) and of the surfaces of a
  /// curved block.
  std::vector<std::string>
  generator_names();
  std::vector<std::string>
  surface_names();
} // namespace mortise
