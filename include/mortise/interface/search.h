// Contact search: bounding boxes of master faces in a packed R-tree, and the
// exchange of nearby faces between ranks.
#pragma once

#include <mortise/interface/surface_face.h>
#include <mpi.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace mortise
{
  /// Largest distance of two faces of a pair.
  struct SearchDistance
  {
    double by_size = 0.5; ///< times the size of the larger one
    double length  = 0.;  ///< takes its place if positive
    double least   = 0.;  ///< lower bound, a length

    double
    of(const double size) const
    {
      return std::max(length > 0. ? length : by_size * size, least);
    }
  };

  /// Boxes of master faces in a packed tree.
  class FaceTree
  {
  public:
    /// Keeps a reference to @p masters: they have to be finalized and outlive the tree.
    explicit FaceTree(const std::vector<SurfaceFace> &masters,
                      const SearchDistance           &distance = {});
    ~FaceTree();

    /// Positions in @p masters, ascending, of the faces that may overlap @p slave: boxes meet,
    /// normals oppose, no separating axis among the sides of either face's
    /// bounding parallelogram or triangle. Never misses an overlapping face
    /// within the search distance.
    void
    candidates(const SurfaceFace         &slave,
               std::vector<unsigned int> &result) const;

  private:
    struct Tree;
    const std::vector<SurfaceFace> &masters;
    const SearchDistance            distance;
    std::unique_ptr<Tree>           tree;
  };

  /// The master faces of all ranks near to a slave face of this rank, with
  /// their payload, sorted by id and without doubles. Collective; a rank may
  /// own no faces.
  std::vector<SurfaceFace>
  exchange_near_faces(const std::vector<SurfaceFace> &owned_slaves,
                      const std::vector<SurfaceFace> &owned_masters,
                      const SearchDistance           &distance,
                      MPI_Comm                        comm);
} // namespace mortise
