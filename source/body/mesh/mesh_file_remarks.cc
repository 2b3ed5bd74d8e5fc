// What may be meant as it is in the mesh of a file, but most often is not.
#include <deal.II/base/bounding_box.h>
#include <deal.II/base/geometry_info.h>

#include <mortise/body/mesh/surface_patches.h>
#include <mortise/body/mesh/vertex_order.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "mesh_file_parts.h"

namespace mortise
{
  using namespace dealii;

  std::vector<std::array<unsigned int, 2>>
  cell_edges(const std::vector<unsigned int> &vertices)
  {
    std::vector<std::array<unsigned int, 2>> edges;
    if (vertices.size() == 8)
      for (unsigned int line = 0; line < 12; ++line)
        edges.push_back(
          {{vertices[GeometryInfo<3>::line_to_cell_vertices(line, 0)],
            vertices[GeometryInfo<3>::line_to_cell_vertices(line, 1)]}});
    else
      for (const auto &line : tetrahedron_lines)
        edges.push_back({{vertices[line[0]], vertices[line[1]]}});
    return edges;
  }

  namespace
  {
    /// Each edge once, at its first cell.
    void
    check_edges(CoarseMesh &mesh)
    {
      constexpr double tiny = 1e-5;
      const auto   box  = BoundingBox<3>(mesh.vertices).get_boundary_points();
      const double size = box.first.distance(box.second);
      std::set<std::pair<unsigned int, unsigned int>> found;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (const auto &[v, w] : cell_edges(mesh.cells[c].vertices))
          if (v != w &&
              mesh.vertices[v].distance(mesh.vertices[w]) < tiny * size &&
              found.insert(std::minmax(v, w)).second)
            mesh.findings
              .warning("edges shorter than 1e-5 of the body",
                       "are they meant to be?")
              .at("cell " + std::to_string(mesh.cell_numbers[c]) +
                    " between the nodes " +
                    std::to_string(mesh.vertex_numbers[v]) + " and " +
                    std::to_string(mesh.vertex_numbers[w]),
                  mesh.vertices[v]);
    }

    /// As find_pieces() does: cells that share a vertex are connected.
    void
    check_parts(CoarseMesh &mesh)
    {
      std::vector<unsigned int> parents(mesh.vertices.size());
      std::iota(parents.begin(), parents.end(), 0);
      const auto root = [&parents](unsigned int v) {
        while (parents[v] != v)
          v = parents[v] = parents[parents[v]];
        return v;
      };
      for (const CellData<3> &cell : mesh.cells)
        for (const unsigned int v : cell.vertices)
          parents[root(v)] = root(cell.vertices[0]);
      std::map<unsigned int, std::vector<std::size_t>> parts;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        parts[root(mesh.cells[c].vertices[0])].push_back(c);
      const auto largest =
        std::max_element(parts.begin(),
                         parts.end(),
                         [](const auto &a, const auto &b) {
                           return a.second.size() < b.second.size();
                         });
      for (auto part = parts.begin(); part != parts.end(); ++part)
        if (part != largest)
          mesh.findings
            .warning("parts that are not connected with the rest of the body",
                     "each needs supports or interfaces of its own")
            .at("cell " + std::to_string(mesh.cell_numbers[part->second[0]]) +
                  " and " + std::to_string(part->second.size() - 1) + " more",
                middle(mesh.vertices, mesh.cells[part->second[0]].vertices));
    }
  } // namespace

  void
  check_edges_and_parts(CoarseMesh &mesh)
  {
    check_edges(mesh);
    check_parts(mesh);
  }

  void
  check_orphan_nodes(const GmshModel &model, CoarseMesh &mesh)
  {
    std::vector<bool> used(model.nodes.size(), false);
    for (const GmshElements &block : model.elements)
      for (const unsigned int node : block.nodes)
        used[node] = true;
    for (std::size_t node = 0; node < used.size(); ++node)
      if (!used[node])
        mesh.findings
          .warning("nodes that no cell and no face has", "they are passed over")
          .at("node " + std::to_string(model.node_tags[node]),
              model.nodes[node]);
  }
} // namespace mortise
