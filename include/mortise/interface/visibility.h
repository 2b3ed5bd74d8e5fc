// What lies between a point of the slave and its partner: a partner must not be
// seen through a body. It never decides which faces belong to the interface.
#pragma once

#include <mortise/interface/surface_face.h>

#include <memory>
#include <vector>

namespace mortise
{
  class Visibility
  {
  public:
    /// Faces of the whole boundaries of both bodies that are near to the slave faces of this
    /// rank; their straight pictures count, by the vertices.
    Visibility(const std::vector<SurfaceFace> &slave_boundary,
               const std::vector<SurfaceFace> &master_boundary);
    ~Visibility();

    /// Is there a face between @p slave_point and @p master_point, other than faces @p slave
    /// and @p master (ids) on which they lie? What lies in the outer twentieths
    /// of the way is taken for their neighbourhood.
    bool
    is_hidden(std::uint64_t           slave,
              std::uint64_t           master,
              const dealii::Point<3> &slave_point,
              const dealii::Point<3> &master_point) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> slave_tree, master_tree;
  };
} // namespace mortise
