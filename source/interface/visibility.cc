#include <deal.II/base/bounding_box.h>

#include <deal.II/numerics/rtree.h>

#include <boost/iterator/function_output_iterator.hpp>

#include <mortise/interface/visibility.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Triangle = std::array<Point<3>, 3>;

    /// Part of the way that belongs to the ends.
    constexpr double near_end = 0.05;

    /// Sine of the angle from which a face is crossed and not grazed.
    constexpr double grazing = 0.1;

    bool
    crosses(const Point<3>     &from,
            const Tensor<1, 3> &way,
            const Triangle     &triangle)
    {
      // from + t way = a + u (b - a) + v (c - a)
      const Tensor<1, 3> e1 = triangle[1] - triangle[0],
                         e2 = triangle[2] - triangle[0];
      const Tensor<1, 3> normal = cross_product_3d(e1, e2);
      const double       d      = normal * way;
      if (std::fabs(d) <= grazing * normal.norm() * way.norm())
        return false;
      const double       t  = normal * (triangle[0] - from) / d;
      const Tensor<1, 3> at = from + t * way - triangle[0];
      const double       u  = cross_product_3d(at, e2) * normal /
                       normal.norm_square(),
                   v = cross_product_3d(e1, at) * normal / normal.norm_square();
      constexpr double rim = -1e-6;
      return t > near_end && t < 1. - near_end && u >= rim && v >= rim &&
             u + v <= 1. - rim;
    }
  } // namespace

  struct Visibility::Tree
  {
    struct Face
    {
      std::uint64_t           id;
      std::array<Triangle, 2> triangles;
      unsigned int            n_triangles;
    };

    using Box = BoundingBox<3>;

    explicit Tree(const std::vector<SurfaceFace> &boundary)
    {
      std::vector<std::pair<Box, unsigned int>> all;
      for (const SurfaceFace &face : boundary)
        {
          std::array<Point<3>, 4> vertex;
          for (unsigned int v = 0; v < n_vertices(face.shape); ++v)
            vertex[v] = face_point(face, Point<2>(v % 2, v / 2));
          faces.push_back({face.id,
                           {{{{vertex[0], vertex[1], vertex[2]}},
                             {{vertex[3], vertex[1], vertex[2]}}}},
                           n_vertices(face.shape) - 2});
          all.emplace_back(Box({face.lower, face.upper}), faces.size() - 1);
        }
      boxes = pack_rtree(all);
    }

    bool
    is_crossed(const std::uint64_t except,
               const Point<3>     &from,
               const Point<3>     &to) const
    {
      Point<3> lower, upper;
      for (unsigned int d = 0; d < 3; ++d)
        {
          lower[d] = std::min(from[d], to[d]);
          upper[d] = std::max(from[d], to[d]);
        }
      bool       crossed = false;
      const auto test    = [&](const std::pair<Box, unsigned int> &entry) {
        const Face &face = faces[entry.second];
        if (crossed || face.id == except)
          return;
        for (unsigned int k = 0; k < face.n_triangles; ++k)
          crossed = crossed || crosses(from, to - from, face.triangles[k]);
      };
      boxes.query(boost::geometry::index::intersects(Box({lower, upper})),
                  boost::make_function_output_iterator(test));
      return crossed;
    }

    std::vector<Face>                   faces;
    RTree<std::pair<Box, unsigned int>> boxes;
  };

  Visibility::Visibility(const std::vector<SurfaceFace> &slave_boundary,
                         const std::vector<SurfaceFace> &master_boundary)
    : slave_tree(std::make_unique<Tree>(slave_boundary))
    , master_tree(std::make_unique<Tree>(master_boundary))
  {}

  Visibility::~Visibility() = default;

  bool
  Visibility::is_hidden(const std::uint64_t slave,
                        const std::uint64_t master,
                        const Point<3>     &slave_point,
                        const Point<3>     &master_point) const
  {
    return slave_tree->is_crossed(slave, slave_point, master_point) ||
           master_tree->is_crossed(master, slave_point, master_point);
  }
} // namespace mortise
