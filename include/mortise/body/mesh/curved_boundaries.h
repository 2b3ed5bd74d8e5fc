// The parameter "Curved boundaries": true shapes of the boundaries of a file,
// given or fitted, and their manifolds. Vertices that miss a shape by rounding
// are moved onto it.
#pragma once

#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria.h>

#include <mortise/body/mesh/generators.h>
#include <mortise/body/mesh/surfaces.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace mortise
{
  /// One entry of "boundary: kind numbers; ...", for example
  ///   inside: sphere; outside: sphere 0, 0, 0, 2; bore: cylinder;
  ///   rim: cylinder 0, 0, 0, 0, 0, 1; skin: step part.step
  struct CurvedBoundary
  {
    std::string         boundary;
    std::string         kind; ///< sphere, cylinder or step
    std::vector<double> numbers;
    std::string         file; ///< of step
  };

  /// Throws InputError (starting with @p where) for anything else.
  std::vector<CurvedBoundary>
  parse_curved_boundaries(const std::string &text, const std::string &where);

  /// Give the boundaries of @p mesh that @p parameters name their shapes, and
  /// move their vertices onto them. What is not given of a sphere or a
  /// cylinder is fitted by least squares, for each connected part of the
  /// boundary on its own. Throws InputError for a boundary that is not there,
  /// or whose vertices are off the shape by more than 1e-6 of its size.
  void
  fit_curved_boundaries(CoarseMesh           &mesh,
                        const MeshParameters &parameters,
                        const std::string    &where);

  /// Points are means, moved along the normal onto one surface, or onto the
  /// curve in which two cross.
  class SurfaceManifold : public dealii::Manifold<3>
  {
  public:
    explicit SurfaceManifold(const std::vector<SurfacePointer> &surfaces);

    std::unique_ptr<dealii::Manifold<3>>
    clone() const override
    {
      return std::make_unique<SurfaceManifold>(surfaces);
    }

    dealii::Point<3>
    get_new_point(const dealii::ArrayView<const dealii::Point<3>> &points,
                  const dealii::ArrayView<const double> &weights) const override
    {
      dealii::Tensor<1, 3> mean;
      for (unsigned int i = 0; i < points.size(); ++i)
        mean += weights[i] * points[i];
      return project(surfaces, dealii::Point<3>(mean));
    }

    dealii::Point<3>
    project_to_manifold(const dealii::ArrayView<const dealii::Point<3>> &,
                        const dealii::Point<3> &candidate) const override
    {
      return project(surfaces, candidate);
    }

  private:
    const std::vector<SurfacePointer> surfaces;
  };

  /// Surfaces on which the edges of curved boundaries lie, by their vertices in
  /// ascending order: that of the boundary, and, where it ends, that of the
  /// other boundary or the plane of the face there.
  using CurvedEdges =
    std::map<std::array<unsigned int, 2>, std::vector<SurfacePointer>>;
  CurvedEdges
  curved_edges(const CoarseMesh &mesh);

  using Manifolds =
    std::map<dealii::types::manifold_id, std::shared_ptr<dealii::Manifold<3>>>;

  /// Make the empty @p triangulation of @p mesh, with the manifolds of all of it and of the faces
  /// and edges of curved boundaries; the latter are returned.
  Manifolds
  create_coarse_triangulation(const CoarseMesh         &mesh,
                              dealii::Triangulation<3> &triangulation);

  /// Let everything else of a mesh of hexahedra follow its curved boundaries by
  /// transfinite interpolation in coarse cells, for meshes that are to be
  /// refined; after create_coarse_triangulation().
  void
  blend_into_cells(dealii::Triangulation<3> &triangulation);
} // namespace mortise
