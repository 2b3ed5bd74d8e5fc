#include <deal.II/base/geometry_info.h>

#include <mortise/base/error.h>
#include <mortise/body/vertex_order.h>

#include <algorithm>
#include <array>
#include <sstream>

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
    };

    /// The faces of only one cell, by ascending key.
    std::vector<OuterFace>
    outer_faces(const CoarseMesh &mesh,
                const GmshModel  &model,
                const FileError  &fail)
    {
      const bool hexahedra = mesh.cells.front().vertices.size() == 8;
      std::vector<OuterFace> faces;
      for (const CellData<3> &cell : mesh.cells)
        for (unsigned int f = 0; f < (hexahedra ? 6 : 4); ++f)
          {
            OuterFace face;
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
              const Point<3> &at = model.nodes[faces[i].key[0]];
              fail("has " + std::to_string(next - i) +
                   " cells at one face, near " + place_name(at) +
                   "; allowed: two, so cells must not overlap");
            }
        }
      return boundary;
    }

    /// Physical surface of each face that is in one.
    std::map<FaceKey, int>
    surface_tags(const GmshModel &model)
    {
      std::map<FaceKey, int> tags;
      for (const GmshElements &block : model.elements)
        if (block.dimension == 2 && !block.groups.empty())
          for (std::size_t e = 0; e < block.size(); ++e)
            tags[face_key(&block.nodes[e * block.reference.size()],
                          block.n_vertices)] =
              block.groups.size() == 1 ? block.groups[0] : -block.entity;
      return tags;
    }
  } // namespace

  void
  name_faces(const GmshModel &model, CoarseMesh &mesh, const FileError &fail)
  {
    const std::map<FaceKey, int> tags = surface_tags(model);
    for (const OuterFace &face : outer_faces(mesh, model, fail))
      {
        CellData<2> data(face.vertices.size());
        data.vertices    = face.vertices;
        data.boundary_id = 0;
        const auto tag   = tags.find(face.key);
        if (tag == tags.end())
          {
            mesh.faces.boundary_quads.push_back(data);
            continue;
          }
        if (tag->second < 0)
          for (const GmshElements &block : model.elements)
            if (block.dimension == 2 && block.entity == -tag->second)
              {
                std::vector<std::string> names;
                for (const int group : block.groups)
                  names.push_back(model.surface_names.at(group));
                fail("has the surface " + std::to_string(block.entity) +
                     " in " + std::to_string(names.size()) +
                     " physical surfaces, " + join_names(names) +
                     "; allowed: one each");
              }
        const std::string &name = model.surface_names.at(tag->second);
        // groups of one name are one boundary
        data.boundary_id =
          mesh.names.boundaries.emplace(name, tag->second).first->second;
        mesh.faces.boundary_quads.push_back(data);
      }
    if (mesh.names.boundaries.empty())
      fail(
        "names no boundary" +
        std::string(
          model.surface_names.empty() ?
            "" :
            " of this part: none of its faces is in a physical surface of "
            "the file") +
        "; allowed: a mesh with physical surfaces, by whose names (or tags) a scene "
        "refers to boundaries, as in gmsh's Physical Surface(\"name\") = {...};");
  }
} // namespace mortise
