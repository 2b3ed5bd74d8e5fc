// What lies between a point of the slave and its partner: a partner must not be
// seen through a body. It never decides which faces belong to the interface.
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
    /// Faces of the whole boundaries of both bodies that are near to the slave
    /// faces of this rank, finalized. They count as curved as they are: where
    /// bodies are thinner than their faces bend, straight ones lie on the other
    /// side of the points.
    Visibility(const std::vector<SurfaceFace> &slave_boundary,
               const std::vector<SurfaceFace> &master_boundary);
    ~Visibility();

    /// By point of a pair: is there a face between it and its partner, other than faces @p slave
    /// and @p master (ids) on which they lie? What lies in the outer twentieths
    /// of the way, and no farther from its ends than @p safe [length], in which no body ends, is
    /// their neighbourhood.
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
