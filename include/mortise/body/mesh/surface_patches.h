// Patches of the surface of a mesh: faces that belong together, and the simple
// shapes that they have. It knows no triangulation.
#pragma once

#include <mortise/body/mesh/generators.h>

#include <set>
#include <string>
#include <vector>

namespace mortise
{
  /// Boundary faces that are one face of a CAD file, or that meet smoothly
  /// within one boundary of a mesh. Lengths in the unit of the file.
  struct SurfacePatch
  {
    unsigned int               number = 0; ///< of the CAD file, else from 1 on
    dealii::types::boundary_id id     = 0;
    std::string                kind;        ///< plane, sphere, cylinder or free
    double                     radius = 0.; ///< of a sphere or cylinder
    SurfacePointer             shape;       ///< of a plane, sphere or cylinder
    double                     area = 0.;   ///< of the mesh, with flat faces
    dealii::Point<3>           centre, low, high; ///< of mass, of the box
    std::vector<std::size_t>   faces; ///< indices into faces.boundary_quads

    /// "cylinder of radius 5".
    std::string
    text() const;
  };

  /// Normal of a flat face with vertices @p v of @p x around it, as long as its
  /// area, and the mean of its vertices.
  dealii::Tensor<1, 3>
  area_vector(const std::vector<dealii::Point<3>> &x,
              const std::vector<unsigned int>     &v);
  dealii::Point<3>
  middle(const std::vector<dealii::Point<3>> &x,
         const std::vector<unsigned int>     &vertices);

  std::set<unsigned int>
  vertices_of(const CoarseMesh &mesh, const SurfacePatch &patch);

  /// All boundary faces of @p mesh in patches. @p cad: every boundary is one face
  /// of a CAD file, whose number is its id. Else faces that share an edge and
  /// whose normals differ by less than 40 degrees are in one patch, as facets
  /// of a round surface are.
  std::vector<SurfacePatch>
  surface_patches(const CoarseMesh &mesh, bool cad);
} // namespace mortise
