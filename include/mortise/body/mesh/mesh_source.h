// The mesh of a body: from a generator or a file, then refined, then moved.
#pragma once

#include <deal.II/distributed/tria_base.h>

#include <mortise/base/rigid_motion.h>
#include <mortise/base/types.h>
#include <mortise/body/mesh/balls.h>
#include <mortise/body/mesh/coarse_geometry.h>
#include <mortise/body/mesh/lattice_coarsening.h>

#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace mortise
{
  class SizeField;

  /// The subsection "Mesh" of a body. Lengths are in the unit of the scene.
  ///
  /// | Source          | Extent                     | Subdivisions          | boundaries           |
  /// |-----------------|----------------------------|-----------------------|----------------------|
  /// | box             | x0, y0, z0, x1, y1, z1     | nx, ny, nz            | xmin ... zmax        |
  /// | shell octant    | r_in, r_out                | n, m (n x n per patch | inside, outside,     |
  /// |                 |                            | of three, m radial)   | xmin, ymin, zmin     |
  /// | cylinder sector | r_in, r_out, length        | around, radial, axial | inside, outside,     |
  /// |                 |                            |                       | xmin, ymin, zmin, zmax |
  /// | curved block    | x0, y0, z0, x1, y1, z1     | nx, ny, nz; for both  | xmin ... ymax, zmin  |
  /// |                 | of the whole block         | halves nx, ny,        | (not upper), zmax (not |
  /// |                 |                            | nz_lower, nz_upper    | lower), interface    |
  /// |                 |                            |                       | (lower, upper)       |
  /// | file            | -                          | -                     | physical surfaces    |
  ///
  /// Material ids: box 0..7, the octant of the coarse cell, (x half) + 2 (y
  /// half) + 4 (z half); shell octant 0..2, the patch around x, y, z; cylinder
  /// sector 0; curved block 0 lower, 1 upper half; file: the physical volumes.
  ///
  /// Meaning and units of the rest are what --parameters prints of them.
  struct MeshParameters
  {
    std::string               source = "box";
    std::string               cells  = "auto";
    std::vector<double>       extent;
    std::vector<unsigned int> subdivisions;
    unsigned int              refinements = 0;
    std::string               refine_near;
    bool is_refined_later = false; ///< cells of hexahedra may be cut, any time

    /// Of Source = file; see curved_boundaries.h for "Curved boundaries".
    std::string file;
    std::string part;
    double      mesh_size = 0.;
    std::string boundaries; ///< see boundary_selection.h
    std::string curved_boundaries;
    std::string directory; ///< where a relative File may be, too
    std::shared_ptr<const SizeField>
      sizes; ///< of edges, at most, where gmsh meshes a geometry; null: none
    std::array<double, 3> rotate{};
    std::array<double, 3> translate{};

    /// Of Source = box. Boundary faces stay in their planes where distort > 0.
    std::array<double, 2> bottom_slope{};
    std::array<double, 2> top_slope{};
    double                distort = 0.;

    /// Of Source = curved block. The amplitude is below 0.9 times the height of
    /// the thinner half.
    std::string half      = "both";
    std::string surface   = "bump";
    double      amplitude = 0.;
    double      middle    = 0.5;
  };

  /// Meaning of the ids on a mesh.
  struct MeshNames
  {
    std::map<std::string, dealii::types::boundary_id> boundaries;
    std::map<dealii::types::material_id, std::string> materials;
  };

  /// The balls of "Refine near": cells that a ball touches are refined
  /// Ball::number times. Throws InputError.
  std::vector<Ball>
  refinement_balls(const MeshParameters &parameters, const std::string &where);

  /// Names that "Source" accepts.
  std::vector<std::string>
  mesh_source_names();

  /// Check @p parameters without building the mesh or opening a file.
  /// @p where (e.g. "Body inner, Mesh") starts the messages. Throws InputError. Not collective.
  void
  validate(const MeshParameters &parameters, const std::string &where);

  /// Names of the boundaries that create_mesh() would return. Throws InputError
  /// for an unknown source or an unreadable file. Not collective.
  std::vector<std::string>
  boundary_names(const MeshParameters &parameters);

  /// A distributed mesh and what belongs to it. The manifolds live in the
  /// triangulation.
  struct Mesh
  {
    std::unique_ptr<dealii::parallel::DistributedTriangulationBase<dim>>
              triangulation;
    MeshNames names;
    bool      tetrahedra = false;
    bool      curved     = false; ///< not all faces are straight

    /// Of second-order files: what the mapping takes its points from.
    std::shared_ptr<const CoarseGeometry> geometry;

    /// What became of the cells of a file, for the log; empty: nothing.
    std::string remark;

    /// What is worth knowing of the mesh of a file; it has no errors.
    std::vector<std::string> warnings;

    /// Of hexahedra from generators: the vertices of the coarse mesh.
    std::vector<LatticeBlock> lattice;
  };

  /// Make the mesh: coarse mesh, manifolds on all entities, motion, global and
  /// local refinement. Hexahedra are consistently ordered and spread by p4est,
  /// tetrahedra have the orders of order_vertices() and are spread by METIS;
  /// the coarse mesh is the same on every rank. Collective; throws InputError
  /// on all ranks alike.
  /// @p interfaces: boundaries whose cells have more work, for METIS to balance; unknown names
  /// do nothing.
  Mesh
  create_mesh(const MeshParameters        &parameters,
              MPI_Comm                     comm,
              const std::string           &where      = "Mesh",
              const std::set<std::string> &interfaces = {});

  /// The motion "Rotate" then "Translate".
  inline RigidMotion
  rigid_motion(const MeshParameters &parameters)
  {
    return RigidMotion(parameters.rotate, parameters.translate);
  }
} // namespace mortise
