#include <deal.II/base/mpi.h>

#include <mortise/interface/body_surface.h>
#include <mortise/interface/smooth_patches.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The cosine of 60 degrees, and rounding: the facets of a hexagon are a
    /// round surface, just so.
    constexpr double least_cosine_of_neighbours = 0.5 - 1e-3;

    /// Disjoint sets of ordered keys; the least of each set represents it.
    template <typename Key>
    class DisjointSets
    {
    public:
      Key
      find(const Key &key)
      {
        Key root = key;
        for (auto at = less.find(root); at != less.end(); at = less.find(root))
          root = at->second;
        // what is on the way points there from now on
        for (auto at = less.find(key); at != less.end();)
          at = less.find(std::exchange(at->second, root));
        return root;
      }

      void
      join(const Key &a, const Key &b)
      {
        const Key root_a = find(a), root_b = find(b);
        if (root_a != root_b)
          less[std::max(root_a, root_b)] = std::min(root_a, root_b);
      }

    private:
      std::map<Key, Key> less;
    };

    /// Of a face, the same on any number of ranks: it puts patches in order.
    using FaceKey = std::pair<std::string, unsigned int>;

    FaceKey
    key(const BoundaryFace &face)
    {
      return {face.cell->id().to_string(), face.number};
    }

    /// By face: the first one in its patch as far as this rank knows; second,
    /// whether there is an edge.
    std::pair<std::vector<unsigned int>, bool>
    join_neighbours(const Body &body, const std::vector<BoundaryFace> &faces)
    {
      struct Corner
      {
        unsigned int face;
        Tensor<1, 3> normal;
      };
      std::unordered_map<std::uint64_t, std::vector<Corner>> around;
      for (unsigned int i = 0; i < faces.size(); ++i)
        {
          const SurfaceFace face     = face_geometry(body, faces[i]);
          const auto        vertices = face_vertices(faces[i]);
          const auto        normals  = corner_normals(face);
          for (unsigned int v = 0; v < n_vertices(face.shape); ++v)
            around[vertices[v]].push_back({i, normals[v] / normals[v].norm()});
        }
      DisjointSets<unsigned int> sets;
      bool                       edge = false;
      for (const auto &[vertex, corners] : around)
        for (const Corner &a : corners)
          for (const Corner &b : corners)
            if (a.normal * b.normal > least_cosine_of_neighbours)
              sets.join(a.face, b.face);
            else
              edge = true;
      std::vector<unsigned int> first(faces.size());
      for (unsigned int i = 0; i < faces.size(); ++i)
        first[i] = sets.find(i);
      return {first, edge};
    }
  } // namespace

  std::vector<std::vector<BoundaryFace>>
  smooth_patches(const Body &body, const std::vector<BoundaryFace> &boundary)
  {
    const MPI_Comm comm      = body.triangulation().get_communicator();
    const auto [first, edge] = join_neighbours(body, boundary);
    if (Utilities::MPI::max(static_cast<int>(edge), comm) == 0)
      return {boundary};

    std::vector<std::pair<FaceKey, FaceKey>> joined;
    for (unsigned int i = 0; i < boundary.size(); ++i)
      joined.emplace_back(key(boundary[i]), key(boundary[first[i]]));
    DisjointSets<FaceKey> sets;
    std::set<FaceKey>     firsts;
    const auto            all = Utilities::MPI::all_gather(comm, joined);
    for (const auto &of_rank : all)
      for (const auto &[face, other] : of_rank)
        sets.join(face, other);
    for (const auto &of_rank : all)
      for (const auto &[face, other] : of_rank)
        firsts.insert(sets.find(face));

    std::vector<std::vector<BoundaryFace>> patches(firsts.size());
    for (unsigned int i = 0; i < boundary.size(); ++i)
      patches[std::distance(firsts.begin(),
                            firsts.find(sets.find(joined[i].first)))]
        .push_back(boundary[i]);
    return patches;
  }
} // namespace mortise
