#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <deal.II/numerics/rtree.h>

#include <boost/iterator/function_output_iterator.hpp>

#include <mortise/interface/search.h>

#include <algorithm>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Box = BoundingBox<3>;

    // A bound of |axis . n| for the unit normals n of a face, which are means
    // of those of its vertices.
    double
    along_normals(const SurfaceFace &face, const Tensor<1, 3> &axis)
    {
      constexpr double shortest = 0.1; // of the means
      double           most = 0., length = 1.;
      for (unsigned int v = 0; v < n_vertices(face.shape); ++v)
        {
          const Tensor<1, 3> &normal = face.vertex_normals[v];
          most                       = std::max(most, std::abs(axis * normal));
          length = std::min(length, face.frame.normal * normal);
        }
      return most / std::max(shortest, length);
    }

    // A partner lies along the normals of the slave, within the distance of the
    // larger face: in the first box where that is the slave, and else the slave
    // reaches into the second one.
    Box
    reach_of_slave(const SurfaceFace &slave, const SearchDistance &distance)
    {
      Point<3> lower, upper;
      for (unsigned int d = 0; d < 3; ++d)
        {
          Tensor<1, 3> axis;
          axis[d] = 1.;
          const double reach =
            distance.of(slave.size) * along_normals(slave, axis) +
            1e-10 * slave.size;
          lower[d] = slave.lower[d] - reach;
          upper[d] = slave.upper[d] + reach;
        }
      return Box({lower, upper});
    }

    Box
    reach_of_master(const SurfaceFace &master, const SearchDistance &distance)
    {
      Box box({master.lower, master.upper});
      box.extend(distance.of(master.size) + 1e-10 * master.size);
      return box;
    }

    // The prism over the face's chart box (over a triangle, what the bound of
    // the sum leaves of it, with two corners twice): it contains the curved
    // face.
    struct Prism
    {
      Tensor<1, 3> corner[8];
    };

    Prism
    prism_of(const SurfaceFace &face)
    {
      const FaceFrame    &frame    = face.frame;
      const ReferenceBox &chart    = frame.chart;
      const bool          triangle = face.shape == FaceShape::triangle;
      const double        low[2]   = {chart.lower[0] - frame.center_xi,
                                      chart.lower[1] - frame.center_xi};
      const double        high[2]  = {
        (triangle ? chart.upper[2] - chart.lower[1] : chart.upper[0]) -
          frame.center_xi,
        (triangle ? chart.upper[2] - chart.lower[0] : chart.upper[1]) -
          frame.center_xi};
      // The dual basis of a chart is without the part of the tangents along the
      // normal.
      Prism prism;
      for (unsigned int v = 0; v < 4; ++v)
        {
          const Tensor<1, 3> in_plane =
            (v % 2 == 0 || (triangle && v == 3) ? low : high)[0] *
              frame.tangent[0] +
            (v / 2 == 0 ? low : high)[1] * frame.tangent[1];
          const Tensor<1, 3> foot =
            frame.center + in_plane - (in_plane * frame.normal) * frame.normal;
          prism.corner[2 * v]     = foot + frame.height_lower * frame.normal;
          prism.corner[2 * v + 1] = foot + frame.height_upper * frame.normal;
        }
      return prism;
    }

    // Does the prism of one face lie beside the other face in that face's
    // chart, and everything within the reach along the normals of the slave?
    bool
    beside(const SurfaceFace &face,
           const Prism       &other,
           const SurfaceFace &slave,
           const double       reach)
    {
      const FaceFrame    &frame = face.frame;
      const ReferenceBox &box   = frame.chart;
      const auto          apart = [&](const Tensor<1, 3> &axis,
                             const double        centre,
                             const double        least,
                             const double        most) {
        double low = 1e300, high = -1e300;
        for (const auto &corner : other.corner)
          {
            const double chart = centre + axis * (corner - frame.center);
            low  = std::min(low, chart);
            high = std::max(high, chart);
          }
        const double slack = 1e-10 + along_normals(slave, axis) * reach;
        return low > most + slack || high < least - slack;
      };
      for (unsigned int i = 0; i < 2; ++i)
        if (apart(frame.dual[i], frame.center_xi, box.lower[i], box.upper[i]))
          return true;
      return face.shape == FaceShape::triangle &&
             apart(frame.axis(2),
                   2. * frame.center_xi,
                   box.lower[0] + box.lower[1],
                   box.upper[2]);
    }

    /// Cosine between the outward normals of the faces themselves, in the
    /// middle, from which they do not face each other: those of a corner do
    /// not, whatever the mean normals around its edge are.
    constexpr double across = -0.1;

    Tensor<1, 3>
    own_normal(const SurfaceFace &face)
    {
      const Tensor<1, 3> area =
        face.orientation *
        cross_product_3d(face.frame.tangent[0], face.frame.tangent[1]);
      return area / area.norm();
    }

    bool
    normals_may_oppose(const SurfaceFace &a, const SurfaceFace &b)
    {
      if (own_normal(a) * own_normal(b) > across)
        return false;
      for (unsigned int v = 0; v < n_vertices(a.shape); ++v)
        for (unsigned int w = 0; w < n_vertices(b.shape); ++w)
          if (a.vertex_normals[v] * b.vertex_normals[w] < 0)
            return true;
      return false;
    }

    // Halve the boxes at the median of their longest extent, again and again:
    // at most 2^depth boxes that together contain all.
    void
    coarsen(std::vector<Box> &boxes,
            const std::size_t begin,
            const std::size_t end,
            unsigned int      depth,
            std::vector<Box> &result)
    {
      if (begin == end)
        return;
      Box whole = boxes[begin];
      for (std::size_t i = begin + 1; i < end; ++i)
        whole.merge_with(boxes[i]);
      if (depth == 0 || end - begin == 1)
        {
          result.push_back(whole);
          return;
        }
      unsigned int axis = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (whole.side_length(d) > whole.side_length(axis))
          axis = d;
      const std::size_t middle = begin + (end - begin) / 2;
      std::nth_element(boxes.begin() + begin,
                       boxes.begin() + middle,
                       boxes.begin() + end,
                       [axis](const Box &a, const Box &b) {
                         return a.lower_bound(axis) + a.upper_bound(axis) <
                                b.lower_bound(axis) + b.upper_bound(axis);
                       });
      coarsen(boxes, begin, middle, depth - 1, result);
      coarsen(boxes, middle, end, depth - 1, result);
    }
  } // namespace



  struct FaceTree::Tree
  {
    RTree<std::pair<Box, unsigned int>>
      boxes; ///< of reach, with positions of faces
  };



  FaceTree::FaceTree(const std::vector<SurfaceFace> &masters,
                     const SearchDistance           &distance)
    : masters(masters)
    , distance(distance)
    , tree(std::make_unique<Tree>())
  {
    std::vector<std::pair<Box, unsigned int>> boxes;
    for (unsigned int m = 0; m < masters.size(); ++m)
      boxes.emplace_back(reach_of_master(masters[m], distance), m);
    tree->boxes = pack_rtree(boxes);
  }



  FaceTree::~FaceTree() = default;



  void
  FaceTree::candidates(const SurfaceFace         &slave,
                       std::vector<unsigned int> &result) const
  {
    result.clear();
    const Prism prism = prism_of(slave);
    const auto  test  = [&](const std::pair<Box, unsigned int> &entry) {
      const SurfaceFace &master = masters[entry.second];
      const double       reach = distance.of(std::max(slave.size, master.size));
      if (normals_may_oppose(slave, master) &&
          !beside(slave, prism_of(master), slave, reach) &&
          !beside(master, prism, slave, reach))
        result.push_back(entry.second);
    };
    tree->boxes.query(boost::geometry::index::intersects(
                        reach_of_slave(slave, distance)),
                      boost::make_function_output_iterator(test));
    std::sort(result.begin(), result.end());
  }



  std::vector<SurfaceFace>
  exchange_near_faces(const std::vector<SurfaceFace> &owned_slaves,
                      const std::vector<SurfaceFace> &owned_masters,
                      const SearchDistance           &distance,
                      MPI_Comm                        comm)
  {
    std::vector<Box> slave_boxes, rank_boxes;
    for (const auto &slave : owned_slaves)
      slave_boxes.push_back(reach_of_slave(slave, distance));
    coarsen(slave_boxes, 0, slave_boxes.size(), 3, rank_boxes);
    const std::vector<std::vector<Box>> all_boxes =
      Utilities::MPI::all_gather(comm, rank_boxes);

    const unsigned int me = Utilities::MPI::this_mpi_process(comm);
    std::map<unsigned int, std::vector<SurfaceFace>> to_send;
    std::vector<SurfaceFace>                         result;
    for (const auto &master : owned_masters)
      {
        const Box reach = reach_of_master(master, distance);
        for (unsigned int rank = 0; rank < all_boxes.size(); ++rank)
          if (std::any_of(all_boxes[rank].begin(),
                          all_boxes[rank].end(),
                          [&](const Box &box) {
                            return boost::geometry::intersects(box, reach);
                          }))
            (rank == me ? result : to_send[rank]).push_back(master);
      }
    for (auto &received : Utilities::MPI::some_to_some(comm, to_send))
      std::move(received.second.begin(),
                received.second.end(),
                std::back_inserter(result));

    std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) {
      return a.id < b.id;
    });
    result.erase(std::unique(result.begin(),
                             result.end(),
                             [](const auto &a, const auto &b) {
                               return a.id == b.id;
                             }),
                 result.end());
    return result;
  }
} // namespace mortise
