// Test whether a body lies between a point of the slave and its partner, which
// excludes the pair.
#pragma once

#include <mortise/interface/integration_cells.h>
#include <mortise/interface/surface_face.h>

#include <memory>
#include <vector>

namespace mortise
{
  class Visibility
  {
  public:
    /// Finalized faces of the whole boundaries of both bodies near to owned
    /// slave faces. They have to be curved: in bodies thinner than the sagitta
    /// of their faces straight ones lie on the wrong side of the points.
    Visibility(const std::vector<SurfaceFace> &slave_boundary,
               const std::vector<SurfaceFace> &master_boundary);
    ~Visibility();

    /// By point of a pair: is there a face between it and its partner, other
    /// than their own faces @p slave and @p master (ids)? Faces in the outer
    /// twentieths of the way, and no farther from its ends than the length
    /// @p safe within which no body ends, do not count.
    std::vector<bool>
    hidden(std::uint64_t            slave,
           std::uint64_t            master,
           double                   safe,
           const IntegrationPoints &points) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> slave_tree, master_tree;
  };
} // namespace mortise
