#include <deal.II/base/geometry_info.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/surface_patches.h>
#include <mortise/body/mesh/vertex_order.h>

#include <algorithm>
#include <array>
#include <set>

#include "mesh_file_parts.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using FaceKey = std::array<unsigned int, 4>; ///< ascending, padded

    FaceKey
    face_key(const unsigned int *vertices, const unsigned int n)
    {
      FaceKey key;
      key.fill(numbers::invalid_unsigned_int);
      std::copy(vertices, vertices + n, key.begin());
      std::sort(key.begin(), key.end());
      return key;
    }

    struct OuterFace
    {
      FaceKey                   key;
      std::vector<unsigned int> vertices; ///< in deal.II's order
      std::size_t               cell = 0;
    };

    /// The faces of all cells, by ascending key: those between two cells twice.
    std::vector<OuterFace>
    all_faces(const CoarseMesh &mesh)
    {
      const bool hexahedra = mesh.cells.front().vertices.size() == 8;
      std::vector<OuterFace> faces;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (unsigned int f = 0; f < (hexahedra ? 6 : 4); ++f)
          {
            const CellData<3> &cell = mesh.cells[c];
            OuterFace          face;
            face.cell = c;
            for (unsigned int v = 0; v < (hexahedra ? 4 : 3); ++v)
              face.vertices.push_back(
                cell.vertices[hexahedra ?
                                GeometryInfo<3>::face_to_cell_vertices(f, v) :
                                tetrahedron_faces[f][v]]);
            face.key = face_key(face.vertices.data(), face.vertices.size());
            faces.push_back(face);
          }
      std::sort(faces.begin(), faces.end(), [](const auto &a, const auto &b) {
        return a.key < b.key;
      });
      return faces;
    }

    /// Those of @p faces that belong to only one cell.
    std::vector<OuterFace>
    outer_faces(const std::vector<OuterFace> &faces,
                const GmshModel              &model,
                CoarseMesh                   &mesh)
    {
      std::vector<OuterFace> boundary;
      for (std::size_t i = 0, next; i < faces.size(); i = next)
        {
          for (next = i + 1;
               next < faces.size() && faces[next].key == faces[i].key;)
            ++next;
          if (next == i + 1)
            boundary.push_back(faces[i]);
          if (next > i + 2)
            {
              std::set<std::size_t> numbers;
              for (std::size_t k = i; k < next; ++k)
                numbers.insert(mesh.cell_numbers[faces[k].cell]);
              std::vector<std::string> cells;
              for (const std::size_t number : numbers)
                cells.push_back(std::to_string(number));
              mesh.findings
                .error("faces of more than two cells",
                       "allowed: two, so cells must not overlap")
                .at("cells " + join_names(cells),
                    middle(model.nodes, faces[i].vertices));
            }
        }
      return boundary;
    }

    /// Call @p action(block, e, key) for each element of a physical surface.
    template <typename Action>
    void
    for_each_surface_element(const GmshModel &model, const Action &action)
    {
      for (const GmshElements &block : model.elements)
        if (block.dimension == 2 && !block.groups.empty())
          for (std::size_t e = 0; e < block.size(); ++e)
            action(block,
                   e,
                   face_key(&block.nodes[e * block.reference.size()],
                            block.n_vertices));
    }

    /// Physical surfaces of each face that is in one.
    std::map<FaceKey, std::set<int>>
    surface_tags(const GmshModel &model)
    {
      std::map<FaceKey, std::set<int>> tags;
      for_each_surface_element(
        model,
        [&](const GmshElements &block, const std::size_t, const FaceKey &key) {
          tags[key].insert(block.groups.begin(), block.groups.end());
        });
      return tags;
    }

    /// Cells of all parts at each node: blocks of the model and places in them.
    using CellsAtNodes =
      std::vector<std::vector<std::pair<const GmshElements *, std::size_t>>>;

    CellsAtNodes
    cells_at_nodes(const GmshModel &model)
    {
      CellsAtNodes cells(model.nodes.size());
      for (const GmshElements &block : model.elements)
        if (block.dimension == 3)
          for (std::size_t e = 0; e < block.size(); ++e)
            for (unsigned int v = 0; v < block.n_vertices; ++v)
              cells[block.nodes[e * block.reference.size() + v]].emplace_back(
                &block, e);
      return cells;
    }

    /// Is the element with @p key a face of a cell of another part, all of whose
    /// vertices are this part's as well?
    bool
    is_face_of_another_part(const FaceKey           &key,
                            const CellsAtNodes      &cells,
                            const std::vector<bool> &of_part)
    {
      const auto n = std::count_if(key.begin(), key.end(), [](const auto v) {
        return v != numbers::invalid_unsigned_int;
      });
      for (const auto &[block, e] : cells[key[0]])
        {
          const auto begin = block->nodes.begin() + e * block->reference.size();
          const auto end   = begin + block->n_vertices;
          const bool holds =
            std::all_of(key.begin(), key.begin() + n, [&](const auto v) {
              return std::find(begin, end, v) != end;
            });
          // three vertices of a tetrahedron are a face, which would be
          // known if it were this part's
          if (holds && ((block->n_vertices == 4 && n == 3) ||
                        std::any_of(begin, end, [&](const auto v) {
                          return !of_part[v];
                        })))
            return true;
        }
      return false;
    }

    /// An element of a physical surface between vertices of this part must be
    /// a face of its cells: else the surface that the file shows is not the
    /// one that is loaded or held.
    void
    check_surface_elements(const std::vector<OuterFace> &faces,
                           const GmshModel              &model,
                           CoarseMesh                   &mesh)
    {
      CellsAtNodes      cells; // when a first one asks
      std::vector<bool> of_part(model.nodes.size(), false);
      for (const OuterFace &face : faces)
        for (const unsigned int v : face.vertices)
          of_part[v] = true;
      for_each_surface_element(
        model,
        [&](const GmshElements &block,
            const std::size_t   e,
            const FaceKey      &key) {
          const auto less = [](const OuterFace &face, const FaceKey &k) {
            return face.key < k;
          };
          const auto found =
            std::lower_bound(faces.begin(), faces.end(), key, less);
          const unsigned int *nodes = &block.nodes[e * block.reference.size()];
          if ((found != faces.end() && found->key == key) ||
              !std::all_of(nodes, nodes + block.n_vertices, [&](const auto v) {
                return of_part[v];
              }))
            return;
          if (cells.empty())
            cells = cells_at_nodes(model);
          if (is_face_of_another_part(key, cells, of_part))
            return;
          std::vector<std::string> tags;
          for (unsigned int v = 0; v < block.n_vertices; ++v)
            tags.push_back(std::to_string(model.node_tags[nodes[v]]));
          mesh.findings
            .error("surface elements that are a face of no cell",
                   "allowed: faces of the body's cells")
            .at("element " + std::to_string(block.tags[e]) + " of " +
                  in_quotes(model.surface_names.at(block.groups[0]), '\'') +
                  " between the nodes " + join_names(tags) + ", the first",
                model.nodes[nodes[0]]);
        });
    }
  } // namespace

  namespace
  {
    /// @p tags by index of the boundary face. Groups that overlap others become
    /// overlapping_sets, the others boundaries.
    void
    name_disjoint_sets(const std::vector<std::set<int>> &tags,
                       const GmshModel                  &model,
                       CoarseMesh                       &mesh)
    {
      std::set<int> overlapping;
      for (const std::set<int> &groups : tags)
        if (groups.size() > 1)
          overlapping.insert(groups.begin(), groups.end());
      for (std::size_t f = 0; f < tags.size(); ++f)
        for (const int group : tags[f])
          {
            const std::string &name = model.surface_names.at(group);
            if (overlapping.count(group) > 0)
              mesh.overlapping_sets[name].push_back(f);
            else
              mesh.faces.boundary_quads[f].boundary_id =
                mesh.names.boundaries.emplace(name, group).first->second;
          }
      std::vector<std::string> names;
      for (const auto &set : mesh.overlapping_sets)
        names.push_back(set.first);
      if (!names.empty())
        mesh.remark =
          "the sets " + join_names(names) +
          " of the file share faces with others; Boundaries = " + names[0] +
          ": named " + names[0] + "; ... makes boundaries of them";
    }

    void
    add_two_groups(const std::set<int> &groups,
                   const GmshModel     &model,
                   const OuterFace     &face,
                   CoarseMesh          &mesh)
    {
      std::vector<std::string> names;
      for (const int group : groups)
        names.push_back(model.surface_names.at(group));
      mesh.findings
        .error("faces in several physical surfaces", "allowed: one each")
        .at("cell " + std::to_string(mesh.cell_numbers[face.cell]) + " in " +
              join_names(names),
            middle(model.nodes, face.vertices));
    }
  } // namespace

  void
  name_faces(const GmshModel &model, CoarseMesh &mesh)
  {
    const std::map<FaceKey, std::set<int>> tags  = surface_tags(model);
    const std::vector<OuterFace>           faces = all_faces(mesh);
    check_surface_elements(faces, model, mesh);
    std::vector<std::set<int>> groups_of_faces;
    for (const OuterFace &face : outer_faces(faces, model, mesh))
      {
        CellData<2> data(face.vertices.size());
        data.vertices    = face.vertices;
        data.boundary_id = 0;
        const auto tag   = tags.find(face.key);
        groups_of_faces.push_back(tag == tags.end() ? std::set<int>() :
                                                      tag->second);
        if (groups_of_faces.back().size() > 1 && !model.surfaces_may_overlap)
          {
            add_two_groups(groups_of_faces.back(), model, face, mesh);
            groups_of_faces.back() = {*groups_of_faces.back().begin()};
          }
        mesh.faces.boundary_quads.push_back(data);
      }
    name_disjoint_sets(groups_of_faces, model, mesh);
  }
} // namespace mortise
