// Which master faces are near to a slave face: boxes in a packed R-tree on one
// rank, and the exchange of near faces between ranks. It never clips and never
// decides about contact.
#pragma once

#include <mortise/interface/surface_face.h>
#include <mpi.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace mortise
{
  /// How far from each other two faces can be a pair.
  struct SearchDistance
  {
    double by_size = 0.5; ///< times the size of the larger one
    double length  = 0.;  ///< if it is positive, in place of that
    double least   = 0.;  ///< a length, however small both are

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

  /// The master faces of all ranks that are near to a slave face of this rank,
  /// sorted by id and without doubles: what this rank needs to integrate over
  /// its slave faces. A face travels whole, with its payload. Collective; a
  /// rank may own no faces.
  std::vector<SurfaceFace>
  exchange_near_faces(const std::vector<SurfaceFace> &owned_slaves,
                      const std::vector<SurfaceFace> &owned_masters,
                      const SearchDistance           &distance,
                      MPI_Comm                        comm);
} // namespace mortise
