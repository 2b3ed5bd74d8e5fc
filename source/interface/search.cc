#include <mortise/interface/search.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    struct Box
    {
      std::array<double, 3> lower{{1., 1., 1.}}, upper{{0., 0., 0.}}; ///< empty

      bool
      empty() const
      {
        return lower[0] > upper[0];
      }

      void
      include(const Box &other)
      {
        if (empty())
          *this = other;
        else
          for (unsigned int d = 0; d < 3; ++d)
            {
              lower[d] = std::min(lower[d], other.lower[d]);
              upper[d] = std::max(upper[d], other.upper[d]);
            }
      }

      bool
      meets(const Box &other) const
      {
        return lower[0] <= other.upper[0] && other.lower[0] <= upper[0] &&
               lower[1] <= other.upper[1] && other.lower[1] <= upper[1] &&
               lower[2] <= other.upper[2] && other.lower[2] <= upper[2];
      }

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        for (unsigned int d = 0; d < 3; ++d)
          archive &lower[d] & upper[d];
      }
    };

    // The face's box, extended along its normals to both sides by the distance at which it can
    // still have a partner.
    Box
    box_of_reach(const SurfaceFace &face, const double search_fraction)
    {
      Box box;
      for (unsigned int d = 0; d < 3; ++d)
        {
          double component = 0;
          for (const auto &normal : face.vertex_normals)
            component = std::max(component, std::abs(normal[d]));
          const double reach = search_fraction * face.size * component + 1e-10 * face.size;
          box.lower[d]       = face.lower[d] - reach;
          box.upper[d]       = face.upper[d] + reach;
        }
      return box;
    }

    // The prism over the face's chart box: it contains the curved face.
    struct Prism
    {
      Tensor<1, 3> corner[8];
    };

    Prism
    prism_of(const SurfaceFace &face)
    {
      const FaceFrame &frame = face.frame;
      // What a chart's dual base leaves out is the part of the tangents along the normal.
      Prism prism;
      for (unsigned int v = 0; v < 8; ++v)
        {
          const double a = (v % 2 == 0 ? frame.chart_lower[0] : frame.chart_upper[0]) - 0.5;
          const double b = (v / 2 % 2 == 0 ? frame.chart_lower[1] : frame.chart_upper[1]) - 0.5;
          const Tensor<1, 3> in_plane = a * frame.tangent[0] + b * frame.tangent[1];
          const double       height   = v < 4 ? frame.height_lower : frame.height_upper;
          prism.corner[v] =
            frame.center + in_plane + (height - in_plane * frame.normal) * frame.normal;
        }
      return prism;
    }

    // Does the prism of one face lie beside the other face in that face's chart?
    bool
    beside(const SurfaceFace &face, const Prism &other, const double reach)
    {
      const FaceFrame &frame = face.frame;
      double           twist = 0;
      for (const auto &normal : face.vertex_normals)
        for (const auto &dual : frame.dual)
          twist = std::max(twist, std::abs(dual * normal));
      for (unsigned int i = 0; i < 2; ++i)
        {
          double low = 1e300, high = -1e300;
          for (const auto &corner : other.corner)
            {
              const double chart = 0.5 + frame.dual[i] * (corner - frame.center);
              low                = std::min(low, chart);
              high               = std::max(high, chart);
            }
          const double slack = 1e-10 + twist * reach;
          if (low > frame.chart_upper[i] + slack || high < frame.chart_lower[i] - slack)
            return true;
        }
      return false;
    }

    bool
    normals_may_oppose(const SurfaceFace &a, const SurfaceFace &b)
    {
      for (const auto &n_a : a.vertex_normals)
        for (const auto &n_b : b.vertex_normals)
          if (n_a * n_b < 0)
            return true;
      return false;
    }

    // Halve the boxes at the median of their longest extent, again and again: at most
    // 2^depth boxes that together contain all.
    void
    coarsen(std::vector<Box> &boxes,
            const std::size_t begin,
            const std::size_t end,
            unsigned int      depth,
            std::vector<Box> &result)
    {
      if (begin == end)
        return;
      Box whole;
      for (std::size_t i = begin; i < end; ++i)
        whole.include(boxes[i]);
      if (depth == 0 || end - begin == 1)
        {
          result.push_back(whole);
          return;
        }
      unsigned int axis = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (whole.upper[d] - whole.lower[d] > whole.upper[axis] - whole.lower[axis])
          axis = d;
      const std::size_t middle = begin + (end - begin) / 2;
      std::nth_element(boxes.begin() + begin,
                       boxes.begin() + middle,
                       boxes.begin() + end,
                       [axis](const Box &a, const Box &b) {
                         return a.lower[axis] + a.upper[axis] < b.lower[axis] + b.upper[axis];
                       });
      coarsen(boxes, begin, middle, depth - 1, result);
      coarsen(boxes, middle, end, depth - 1, result);
    }
  } // namespace



  // Boxes of the faces in the order of median splits, and above them a binary tree of boxes; a leaf
  // holds at most leaf_size faces.
  struct FaceTree::Tree
  {
    static constexpr std::size_t leaf_size = 4;

    struct Node
    {
      Box         box;
      std::size_t begin, end, left; ///< left: position of the first child; 0: a leaf
    };

    std::vector<Box>          face_box;
    std::vector<Box>          box; ///< of the faces in the tree's order
    std::vector<unsigned int> face;
    std::vector<Node>         nodes;

    void
    build(const std::size_t node)
    {
      const std::size_t begin = nodes[node].begin, end = nodes[node].end;
      for (std::size_t i = begin; i < end; ++i)
        nodes[node].box.include(face_box[face[i]]);
      if (end - begin <= leaf_size)
        return;
      const Box   &whole = nodes[node].box;
      unsigned int axis  = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (whole.upper[d] - whole.lower[d] > whole.upper[axis] - whole.lower[axis])
          axis = d;
      const std::size_t middle = begin + (end - begin) / 2;
      std::nth_element(face.begin() + begin,
                       face.begin() + middle,
                       face.begin() + end,
                       [&](const unsigned int a, const unsigned int b) {
                         const double x = face_box[a].lower[axis] + face_box[a].upper[axis];
                         const double y = face_box[b].lower[axis] + face_box[b].upper[axis];
                         return x != y ? x < y : a < b;
                       });
      nodes[node].left = nodes.size();
      nodes.push_back({Box(), begin, middle, 0});
      nodes.push_back({Box(), middle, end, 0});
      build(nodes[node].left);
      build(nodes[node].left + 1);
    }

    template <typename Function>
    void
    visit(const std::size_t node, const Box &query, const Function &function) const
    {
      if (!nodes[node].box.meets(query))
        return;
      if (nodes[node].left == 0)
        {
          for (std::size_t i = nodes[node].begin; i < nodes[node].end; ++i)
            if (box[i].meets(query))
              function(face[i]);
          return;
        }
      visit(nodes[node].left, query, function);
      visit(nodes[node].left + 1, query, function);
    }
  };



  FaceTree::FaceTree(const std::vector<SurfaceFace> &masters, const double search_fraction)
    : masters(masters)
    , search_fraction(search_fraction)
    , tree(std::make_unique<Tree>())
  {
    for (const auto &master : masters)
      tree->face_box.push_back(box_of_reach(master, search_fraction));
    tree->face.resize(masters.size());
    std::iota(tree->face.begin(), tree->face.end(), 0u);
    tree->nodes.reserve(masters.size() + 1);
    tree->nodes.push_back({Box(), 0, masters.size(), 0});
    tree->build(0);
    for (const unsigned int face : tree->face)
      tree->box.push_back(tree->face_box[face]);
  }



  FaceTree::~FaceTree() = default;



  void
  FaceTree::candidates(const SurfaceFace &slave, std::vector<unsigned int> &result) const
  {
    result.clear();
    const Prism prism = prism_of(slave);
    tree->visit(0, box_of_reach(slave, search_fraction), [&](const unsigned int m) {
      const SurfaceFace &master = masters[m];
      const double       reach  = search_fraction * std::max(slave.size, master.size);
      if (normals_may_oppose(slave, master) && !beside(slave, prism_of(master), reach) &&
          !beside(master, prism, reach))
        result.push_back(m);
    });
    std::sort(result.begin(), result.end());
  }



  std::vector<SurfaceFace>
  exchange_near_faces(const std::vector<SurfaceFace> &owned_slaves,
                      const std::vector<SurfaceFace> &owned_masters,
                      const double                    search_fraction,
                      MPI_Comm                        comm)
  {
    std::vector<Box> slave_boxes, rank_boxes;
    for (const auto &slave : owned_slaves)
      slave_boxes.push_back(box_of_reach(slave, search_fraction));
    coarsen(slave_boxes, 0, slave_boxes.size(), 3, rank_boxes);
    const std::vector<std::vector<Box>> all_boxes = Utilities::MPI::all_gather(comm, rank_boxes);

    const unsigned int                               me = Utilities::MPI::this_mpi_process(comm);
    std::map<unsigned int, std::vector<SurfaceFace>> to_send;
    std::vector<SurfaceFace>                         result;
    for (const auto &master : owned_masters)
      {
        const Box reach = box_of_reach(master, search_fraction);
        for (unsigned int rank = 0; rank < all_boxes.size(); ++rank)
          if (std::any_of(all_boxes[rank].begin(), all_boxes[rank].end(), [&](const Box &box) {
                return box.meets(reach);
              }))
            (rank == me ? result : to_send[rank]).push_back(master);
      }
    for (auto &received : Utilities::MPI::some_to_some(comm, to_send))
      std::move(received.second.begin(), received.second.end(), std::back_inserter(result));

    std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) {
      return a.id < b.id;
    });
    result.erase(std::unique(result.begin(),
                             result.end(),
                             [](const auto &a, const auto &b) { return a.id == b.id; }),
                 result.end());
    return result;
  }
} // namespace mortise
