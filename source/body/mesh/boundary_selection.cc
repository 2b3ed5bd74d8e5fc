#include <deal.II/base/bounding_box.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/boundary_selection.h>
#include <mortise/body/mesh/surface_patches.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Finds the faces of conditions.
    class FaceFinder
    {
    public:
      FaceFinder(const CoarseMesh &mesh, const bool cad)
        : mesh(mesh)
        , patches(surface_patches(mesh, cad))
      {
        const auto box = BoundingBox<3>(mesh.vertices).get_boundary_points();
        rounding       = 1e-6 * box.first.distance(box.second);
      }

      std::set<std::size_t>
      operator()(const FaceCondition &condition) const
      {
        const auto &x = condition.numbers;
        if (condition.kind == "plane")
          {
            const SurfacePointer plane = make_plane(Point<3>(x[0], x[1], x[2]),
                                                    Point<3>(x[3], x[4], x[5]));
            return faces_with([&](const Point<3> &v) {
              return std::fabs(plane->distance(v).value) < rounding;
            });
          }
        if (condition.kind == "box")
          return faces_with([&](const Point<3> &v) {
            bool inside = true;
            for (unsigned int d = 0; d < 3; ++d)
              inside = inside && v[d] > std::min(x[d], x[3 + d]) - rounding &&
                       v[d] < std::max(x[d], x[3 + d]) + rounding;
            return inside;
          });
        if (condition.kind == "named")
          return faces_of_names(condition.names);
        return faces_of_patches(condition);
      }

      /// What there is to choose from, in at most @p most lines.
      std::string
      list(const std::size_t most) const
      {
        std::ostringstream text;
        for (std::size_t i = 0; i < std::min(most, patches.size()); ++i)
          text << (i > 0 ? "; " : "") << patches[i].number << ": "
               << patches[i].text() << " around (" << patches[i].centre << ")";
        if (patches.size() > most)
          text << "; and " << patches.size() - most << " more";
        return text.str();
      }

    private:
      template <typename Predicate>
      std::set<std::size_t>
      faces_with(const Predicate &at_vertex) const
      {
        std::set<std::size_t> chosen;
        const auto           &faces = mesh.faces.boundary_quads;
        for (std::size_t f = 0; f < faces.size(); ++f)
          if (std::all_of(faces[f].vertices.begin(),
                          faces[f].vertices.end(),
                          [&](const unsigned int v) {
                            return at_vertex(mesh.vertices[v]);
                          }))
            chosen.insert(f);
        return chosen;
      }

      std::set<std::size_t>
      faces_of_names(const std::vector<std::string> &names) const
      {
        const auto           &faces = mesh.faces.boundary_quads;
        std::set<std::size_t> chosen;
        for (const std::string &name : names)
          {
            if (const auto set = mesh.overlapping_sets.find(name);
                set != mesh.overlapping_sets.end())
              chosen.insert(set->second.begin(), set->second.end());
            if (const auto id = mesh.names.boundaries.find(name);
                id != mesh.names.boundaries.end())
              for (std::size_t f = 0; f < faces.size(); ++f)
                if (faces[f].boundary_id == id->second)
                  chosen.insert(f);
          }
        return chosen;
      }

      bool
      fits(const SurfacePatch &patch, const FaceCondition &condition) const
      {
        const auto has = [&condition](const std::string &name) {
          return std::count(condition.names.begin(),
                            condition.names.end(),
                            name) > 0;
        };
        if (condition.kind == "faces")
          return has(std::to_string(patch.number));
        // radii in drawings are rounded
        return patch.kind == condition.kind &&
               (condition.radius == 0. ||
                std::fabs(patch.radius - condition.radius) <
                  1e-3 * condition.radius);
      }

      std::set<std::size_t>
      faces_of_patches(const FaceCondition &condition) const
      {
        std::vector<const SurfacePatch *> chosen;
        for (const SurfacePatch &patch : patches)
          if (fits(patch, condition))
            chosen.push_back(&patch);
        if (!condition.near.empty() && !chosen.empty())
          chosen = nearest(chosen,
                           Point<3>(condition.near[0],
                                    condition.near[1],
                                    condition.near[2]));
        std::set<std::size_t> faces;
        for (const SurfacePatch *patch : chosen)
          faces.insert(patch->faces.begin(), patch->faces.end());
        return faces;
      }

      /// The patch nearest to @p x, and those that go on with it on the same
      /// surface: CAD programs cut holes into halves.
      std::vector<const SurfacePatch *>
      nearest(const std::vector<const SurfacePatch *> &among,
              const Point<3>                          &x) const
      {
        const SurfacePatch *first = nullptr;
        double              least = std::numeric_limits<double>::max();
        for (const SurfacePatch *patch : among)
          for (const std::size_t f : patch->faces)
            for (const unsigned int v : mesh.faces.boundary_quads[f].vertices)
              if (mesh.vertices[v].distance(x) < least)
                {
                  least = mesh.vertices[v].distance(x);
                  first = patch;
                }
        std::vector<const SurfacePatch *> result   = {first};
        std::set<unsigned int>            vertices = vertices_of(mesh, *first);
        for (bool grows = first->shape != nullptr; grows;)
          {
            grows = false;
            for (const SurfacePatch *patch : among)
              if (std::count(result.begin(), result.end(), patch) == 0)
                {
                  const auto of_patch = vertices_of(mesh, *patch);
                  const bool touches =
                    std::any_of(of_patch.begin(),
                                of_patch.end(),
                                [&](const unsigned int v) {
                                  return vertices.count(v) > 0;
                                });
                  if (!touches ||
                      !std::all_of(of_patch.begin(),
                                   of_patch.end(),
                                   [&](const unsigned int v) {
                                     return std::fabs(
                                              first->shape
                                                ->distance(mesh.vertices[v])
                                                .value) < rounding;
                                   }))
                    continue;
                  result.push_back(patch);
                  vertices.insert(of_patch.begin(), of_patch.end());
                  grows = true;
                }
          }
        return result;
      }

      const CoarseMesh               &mesh;
      const std::vector<SurfacePatch> patches;
      double                          rounding;
    };
  } // namespace

  void
  select_boundaries(CoarseMesh        &mesh,
                    const std::string &text,
                    const bool         cad,
                    const std::string &where)
  {
    const auto entries = parse_boundaries(text, where);
    if (entries.empty())
      return;
    auto              &faces = mesh.faces.boundary_quads;
    const FaceFinder   find(mesh, cad);
    types::boundary_id next = 0;
    for (const CellData<2> &face : faces)
      next = std::max(next, face.boundary_id);
    std::map<std::string, types::boundary_id> chosen_names;
    std::vector<const BoundarySelection *>    owner(faces.size(), nullptr);
    std::vector<std::string>                  empty;
    for (const BoundarySelection &entry : entries)
      {
        const auto [name, is_new] =
          chosen_names.emplace(entry.boundary, next + 1);
        next += is_new;
        std::set<std::size_t> chosen;
        for (const FaceCondition &condition : entry.conditions)
          {
            const auto more = find(condition);
            if (more.empty())
              empty.push_back(in_quotes(entry.text, '\''));
            chosen.insert(more.begin(), more.end());
          }
        for (const std::size_t f : chosen)
          {
            if (owner[f] != nullptr && owner[f]->boundary != entry.boundary)
              mesh.findings
                .error("faces that the entries " +
                         in_quotes(owner[f]->text, '\'') + " and " +
                         in_quotes(entry.text, '\'') +
                         " of Boundaries both choose",
                       "allowed: one boundary for a face")
                .at("face " + std::to_string(f),
                    middle(mesh.vertices, faces[f].vertices));
            owner[f]             = &entry;
            faces[f].boundary_id = name->second;
          }
      }
    if (!empty.empty())
      mesh.findings.error("Boundaries, " + join_names(empty) +
                            (empty.size() == 1 ? " chooses" : " choose") +
                            " no face",
                          "there are " + find.list(12) +
                            " (mortise --boundaries lists them all)");
    // names of the file that have lost all faces, or that are given anew
    std::set<types::boundary_id> used;
    for (const CellData<2> &face : faces)
      used.insert(face.boundary_id);
    for (auto it = mesh.names.boundaries.begin();
         it != mesh.names.boundaries.end();)
      it = used.count(it->second) == 0 ? mesh.names.boundaries.erase(it) :
                                         std::next(it);
    for (const auto &[name, id] : chosen_names)
      if (!mesh.names.boundaries.emplace(name, id).second)
        mesh.findings.error("Boundaries chooses " + in_quotes(name, '\'') +
                              ", which the file has as a name of other faces",
                            "allowed: another name");
  }
} // namespace mortise
