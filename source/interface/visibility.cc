#include <deal.II/base/bounding_box.h>

#include <deal.II/numerics/rtree.h>

#include <boost/iterator/function_output_iterator.hpp>

#include <mortise/interface/projection.h>
#include <mortise/interface/visibility.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Largest part of the way that belongs to each end.
    constexpr double near_end = 0.05;

    /// Cosine between way and normal from which a face is crossed and not
    /// grazed.
    constexpr double grazing = 0.1;

    /// How far beyond its rim a face is crossed, in its reference coordinates:
    /// no way leads between two faces.
    constexpr double rim = 1e-6;

    /// Width of what is added to boxes of faces for their rims, beside the
    /// length of a box.
    constexpr double rim_of_box = 10. * rim;

    using Box = BoundingBox<3>;

    /// Ways from points to their partners, eight at a time.
    struct Ways
    {
      Vec3<Lanes> from, way;
      Lanes       length;
      Lanes       end; ///< part of the way that belongs to each of its ends
    };

    /// Those from point @p begin on; beyond the last one it is repeated.
    Ways
    ways(const IntegrationPoints &points,
         const unsigned int       begin,
         const double             safe)
    {
      Ways result;
      for (unsigned int l = 0; l < n_lanes; ++l)
        {
          const unsigned int q = std::min(begin + l, points.size() - 1);
          for (unsigned int d = 0; d < 3; ++d)
            {
              result.from[d][l] = points.slave_x[d][q];
              result.way[d][l]  = points.master_x[d][q] - points.slave_x[d][q];
            }
        }
      result.length = square_root(dot(result.way, result.way));
      result.end    = minimum(broadcast(near_end), safe / result.length);
      return result;
    }

    /// Box of all ways without their ends.
    Box
    box_of(const Ways &of)
    {
      Point<3> lower, upper;
      for (unsigned int d = 0; d < 3; ++d)
        {
          const Lanes a = of.from[d] + of.end * of.way[d],
                      b = of.from[d] + (1. - of.end) * of.way[d];
          lower[d]      = -largest(-minimum(a, b));
          upper[d]      = largest(maximum(a, b));
        }
      return Box({lower, upper});
    }

    /// Bits of the lanes whose ways without their ends meet the box @p box.
    unsigned int
    lanes_through(const Box &box, const Ways &of)
    {
      Lanes enter = of.end, leave = 1. - of.end;
      for (unsigned int d = 0; d < 3; ++d)
        {
          const Lanes way   = of.way[d] == 0. ? broadcast(1e-300) : of.way[d];
          const Lanes lower = (box.lower_bound(d) - of.from[d]) / way,
                      upper = (box.upper_bound(d) - of.from[d]) / way;
          enter             = maximum(enter, minimum(lower, upper));
          leave             = minimum(leave, maximum(lower, upper));
        }
      const unsigned int all = (1u << n_lanes) - 1;
      return all & ~lanes_above(enter, leave);
    }
  } // namespace

  struct Visibility::Tree
  {
    struct Face
    {
      std::uint64_t id;
      MasterMap     map; ///< about its own centre
      Vec3<double>  center;
      Vec3<double>  normal; ///< outward, in the middle, times area
    };

    explicit Tree(const std::vector<SurfaceFace> &boundary)
    {
      std::vector<std::pair<Box, unsigned int>> all;
      for (const SurfaceFace &face : boundary)
        {
          Face of;
          of.id = face.id;
          of.map.reinit(face, face.frame.center);
          of.center = to_vec3(face.frame.center);
          of.normal =
            to_vec3(face.orientation * cross_product_3d(face.frame.tangent[0],
                                                        face.frame.tangent[1]));
          faces.push_back(of);
          Box box({face.lower, face.upper});
          box.extend(rim_of_box * face.lower.distance(face.upper));
          all.emplace_back(box, faces.size() - 1);
        }
      boxes = pack_rtree(all);
    }

    /// Sets entries of @p result, from @p begin on, where a face other than
    /// @p except is crossed.
    void
    mark_crossed(const std::uint64_t except,
                 const Ways         &of,
                 const unsigned int  begin,
                 std::vector<bool>  &result) const
    {
      const auto test = [&](const std::pair<Box, unsigned int> &entry) {
        const Face &face = faces[entry.second];
        if (face.id != except && lanes_through(entry.first, of) != 0)
          mark_crossed(face, of, begin, result);
      };
      boxes.query(boost::geometry::index::intersects(box_of(of)),
                  boost::make_function_output_iterator(test));
    }

    void
    mark_crossed(const Face        &face,
                 const Ways        &of,
                 const unsigned int begin,
                 std::vector<bool> &result) const
    {
      // the projection looks for a place that faces the point: towards it where
      // the way enters the body, backwards where it leaves
      const Lanes        along = dot(of.way, face.normal);
      const Lanes        sign  = along > 0. ? broadcast(-1.) : broadcast(1.);
      Lanes              eta[2], t, slope;
      Vec3<Lanes>        at;
      const Vec3<Lanes>  from = of.from - broadcast(face.center);
      const unsigned int failed =
        face.map.project(from, sign * of.way, false, eta, t, at, slope);
      t                 = sign * t;
      const double size = std::sqrt(dot(face.normal, face.normal));
      for (unsigned int l = 0; l < n_lanes && begin + l < result.size(); ++l)
        {
          const double most = 1. + rim;
          if ((failed & (1u << l)) == 0 && t[l] > of.end[l] &&
              t[l] < 1. - of.end[l] && eta[0][l] >= -rim && eta[1][l] >= -rim &&
              (face.map.shape == FaceShape::triangle ?
                 eta[0][l] + eta[1][l] <= most :
                 eta[0][l] <= most && eta[1][l] <= most) &&
              std::fabs(slope[l]) > grazing * size * of.length[l])
            result[begin + l] = true;
        }
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

  std::vector<bool>
  Visibility::hidden(const std::uint64_t      slave,
                     const std::uint64_t      master,
                     const double             safe,
                     const IntegrationPoints &points) const
  {
    std::vector<bool> result(points.size(), false);
    for (unsigned int begin = 0; begin < points.size(); begin += n_lanes)
      {
        const Ways of = ways(points, begin, safe);
        slave_tree->mark_crossed(slave, of, begin, result);
        master_tree->mark_crossed(master, of, begin, result);
      }
    return result;
  }
} // namespace mortise
