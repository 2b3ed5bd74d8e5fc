#include "mesh_file_parts.h"

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/cell_cutting.h>
#include <mortise/body/mesh/surface_patches.h>
#include <mortise/body/mesh/vertex_order.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// "tetrahedra", or gmsh's name.
    std::string
    shape_name(const GmshElements &block)
    {
      switch (block.n_vertices)
        {
          case 4:
            return "tetrahedra";
          case 5:
            return "pyramids";
          case 6:
            return "wedges";
          case 8:
            return "hexahedra";
          default:
            return block.type;
        }
    }

    /// Physical volumes by name with the shapes of their cells: "core
    /// (hexahedra), skin (tetrahedra)".
    std::string
    list_parts(const GmshModel &model)
    {
      std::vector<std::string> parts;
      for (const auto &[tag, name] : model.volume_names)
        {
          std::set<std::string> shapes;
          for (const GmshElements &block : model.elements)
            if (block.dimension == 3 &&
                std::count(block.groups.begin(), block.groups.end(), tag) > 0)
              shapes.insert(shape_name(block));
          parts.push_back(
            name + " (" +
            join_names(std::vector<std::string>(shapes.begin(), shapes.end())) +
            ")");
        }
      return join_names(parts);
    }

    std::vector<const GmshElements *>
    selected_blocks(const GmshModel      &model,
                    const MeshParameters &parameters,
                    const FileError      &fail)
    {
      std::set<int> tags;
      for (const auto &[tag, name] : model.volume_names)
        if (parameters.part == name || parameters.part == std::to_string(tag))
          tags.insert(tag);
      if (!parameters.part.empty() && tags.empty())
        fail("has no physical volume " + in_quotes(parameters.part, '\'') +
             ", which Part names; it has: " + list_parts(model));
      std::vector<const GmshElements *> blocks;
      for (const GmshElements &block : model.elements)
        if (block.dimension == 3 &&
            (parameters.part.empty() ||
             std::any_of(block.groups.begin(),
                         block.groups.end(),
                         [&](const int tag) { return tags.count(tag) > 0; })))
          blocks.push_back(&block);
      if (blocks.empty())
        fail(
          parameters.part.empty() ?
            "holds no volume elements; allowed: a mesh of volume elements (is there a "
            "physical volume, or were all elements saved; was a geometry meshed in 3D?)" :
            "holds no cells of Part = " + shortened(parameters.part));
      return blocks;
    }

    /// One order; shapes that can become cells of a body. Are they to be cut
    /// into tetrahedra?
    bool
    check_shapes(const std::vector<const GmshElements *> &blocks,
                 const MeshParameters                    &parameters,
                 const FileError                         &fail)
    {
      std::set<std::string>  shapes;
      std::set<unsigned int> orders;
      for (const GmshElements *block : blocks)
        {
          const std::string shape = shape_name(*block);
          if (shape == block->type)
            fail("holds " + std::to_string(block->size()) +
                 " elements of type " + shape +
                 "; allowed: tetrahedra, pyramids, wedges and hexahedra");
          if (block->order > 2)
            fail("holds cells of order " + std::to_string(block->order) + " (" +
                 block->type +
                 "); allowed: first and second order (gmsh -order 2); higher "
                 "degrees are a matter of the body's Degree");
          shapes.insert(shape);
          orders.insert(block->order);
        }
      if (orders.size() > 1)
        fail(
          "holds cells of first and of second order in one body; allowed: one order");
      const bool hexahedra = shapes == std::set<std::string>{"hexahedra"};
      if (parameters.cells == "hexahedra" && !hexahedra)
        fail(
          "holds " +
          join_names(std::vector<std::string>(shapes.begin(), shapes.end())) +
          ", but Cells = hexahedra; allowed: auto or tetrahedra, which cut "
          "what is no tetrahedron, or a Part of hexahedra alone");
      return shapes != std::set<std::string>{"tetrahedra"} &&
             !(hexahedra && parameters.cells != "tetrahedra");
    }

    /// "8 pyramids, 30 wedges".
    std::string
    count_cells(const std::vector<const GmshElements *> &blocks)
    {
      std::map<std::string, std::size_t> numbers;
      for (const GmshElements *block : blocks)
        numbers[shape_name(*block)] += block->size();
      std::vector<std::string> texts;
      for (const auto &[shape, n] : numbers)
        texts.push_back(std::to_string(n) + " " + shape);
      return join_names(texts);
    }

    /// Where the nodes of gmsh's element are in a cell of ours.
    struct NodePositions
    {
      std::vector<unsigned int> vertices; ///< gmsh's node at our vertex
      std::vector<unsigned int> nodes;    ///< our node (of 27 or 10) of gmsh's
    };

    NodePositions
    node_positions(const GmshElements &block)
    {
      NodePositions positions;
      positions.vertices.resize(block.n_vertices);
      const bool cube = block.n_vertices == 8 ||
                        (block.dimension == 2 && block.n_vertices == 4);
      for (unsigned int i = 0; i < block.reference.size(); ++i)
        {
          const Point<3>             &x = block.reference[i];
          std::array<unsigned int, 3> at; // 0, 1, 2: start, middle, end
          for (unsigned int d = 0; d < 3; ++d)
            at[d] = static_cast<unsigned int>(
              std::lround(cube && d < block.dimension ? x[d] + 1. : 2. * x[d]));
          if (cube)
            {
              if (i < block.n_vertices)
                positions.vertices[at[0] / 2 + at[1] + 2 * at[2]] = i;
              positions.nodes.push_back(at[0] + 3 * at[1] + 9 * at[2]);
              continue;
            }
          unsigned int vertex = 0, line = numbers::invalid_unsigned_int;
          for (unsigned int d = 0; d < 3; ++d)
            if (at[d] == 2)
              vertex = d + 1;
          for (unsigned int l = 0; l < 6; ++l)
            {
              bool middle = true;
              for (unsigned int d = 0; d < 3; ++d)
                middle =
                  middle && (at[d] == 1) == (tetrahedron_lines[l][0] == d + 1 ||
                                             tetrahedron_lines[l][1] == d + 1);
              if (middle)
                line = l;
            }
          if (i < block.n_vertices)
            positions.vertices[vertex] = i;
          positions.nodes.push_back(i < block.n_vertices ? vertex : 4 + line);
        }
      return positions;
    }

    /// Append the cells of @p block, with the model's numbers of nodes.
    void
    add_cells(const GmshElements    &block,
              const GmshModel       &model,
              const MeshParameters  &parameters,
              CoarseMesh            &mesh,
              std::vector<Point<3>> &curved_nodes)
    {
      const NodePositions positions = node_positions(block);
      // of the groups that a volume is in, the one that was asked for
      int material = block.groups.empty() ? 0 : block.groups[0];
      for (const int tag : block.groups)
        if (!parameters.part.empty() &&
            model.volume_names.at(tag) == parameters.part)
          material = tag;
      const auto name                = model.volume_names.find(material);
      mesh.names.materials[material] = name == model.volume_names.end() ?
                                         std::to_string(material) :
                                         name->second;
      const unsigned int n           = block.reference.size();
      const unsigned int n_nodes     = block.n_vertices == 8 ? 27 : 10;
      for (std::size_t e = 0; e < block.size(); ++e)
        {
          const unsigned int *element = &block.nodes[e * n];
          CellData<3>         cell(block.n_vertices);
          for (unsigned int v = 0; v < block.n_vertices; ++v)
            cell.vertices[v] = element[positions.vertices[v]];
          cell.material_id = material;
          mesh.cells.push_back(cell);
          mesh.cell_numbers.push_back(block.tags[e]);
          if (block.order == 1)
            continue;
          std::vector<Point<3>> nodes(n_nodes);
          for (unsigned int i = 0; i < n; ++i)
            nodes[positions.nodes[i]] = model.nodes[element[i]];
          if (n == 20)
            complete_serendipity(nodes);
          curved_nodes.insert(curved_nodes.end(), nodes.begin(), nodes.end());
        }
    }

    /// Drop all but one of cells with the same vertices, and tell of those that
    /// are not repeated because they are in several physical volumes.
    void
    drop_repeated_cells(const GmshModel &model, CoarseMesh &mesh)
    {
      std::vector<std::pair<std::vector<unsigned int>, std::size_t>> keys;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          keys.emplace_back(mesh.cells[c].vertices, c);
          std::sort(keys.back().first.begin(), keys.back().first.end());
        }
      std::sort(keys.begin(), keys.end());
      std::vector<std::size_t> kept;
      for (std::size_t k = 0; k < keys.size(); ++k)
        if (k == 0 || keys[k].first != keys[k - 1].first)
          kept.push_back(keys[k].second);
        else if (const std::size_t c = keys[k].second, d = kept.back();
                 !model.cells_are_in_one_group ||
                 mesh.cells[c].material_id == mesh.cells[d].material_id)
          mesh.findings
            .warning("cells with the same nodes as another one",
                     "one of each is kept")
            .at("cells " + std::to_string(mesh.cell_numbers[d]) + " and " +
                  std::to_string(mesh.cell_numbers[c]),
                middle(model.nodes, mesh.cells[c].vertices));
      if (kept.size() == mesh.cells.size())
        return;
      std::sort(kept.begin(), kept.end());
      std::vector<CellData<3>> cells;
      std::vector<std::size_t> cell_numbers;
      for (const std::size_t c : kept)
        {
          cells.push_back(mesh.cells[c]);
          cell_numbers.push_back(mesh.cell_numbers[c]);
        }
      mesh.cells        = cells;
      mesh.cell_numbers = cell_numbers;
      if (mesh.geometry != nullptr)
        mesh.geometry =
          std::make_shared<CoarseGeometry>(mesh.geometry->selected(kept));
    }

    /// Number the nodes that are vertices of cells, in the order of the file.
    void
    number_vertices(const GmshModel &model, CoarseMesh &mesh)
    {
      std::vector<unsigned int> place(model.nodes.size(), 0);
      for (const CellData<3> &cell : mesh.cells)
        for (const unsigned int v : cell.vertices)
          place[v] = 1;
      for (std::size_t node = 0; node < place.size(); ++node)
        if (place[node] == 1)
          {
            place[node] = mesh.vertices.size();
            mesh.vertices.push_back(model.nodes[node]);
            mesh.vertex_numbers.push_back(model.node_tags[node]);
          }
      for (CellData<3> &cell : mesh.cells)
        for (unsigned int &v : cell.vertices)
          v = place[v];
      for (CellData<2> &face : mesh.faces.boundary_quads)
        for (unsigned int &v : face.vertices)
          v = place[v];
    }
  } // namespace

  std::string
  count_cells(const GmshModel      &model,
              const MeshParameters &parameters,
              const FileError      &fail)
  {
    return count_cells(selected_blocks(model, parameters, fail));
  }

  CoarseMesh
  select_part(const GmshModel      &model,
              const MeshParameters &parameters,
              const FileError      &fail)
  {
    const auto blocks = selected_blocks(model, parameters, fail);
    if (check_shapes(blocks, parameters, fail))
      {
        CoarseMesh mesh =
          select_part(cut_into_tetrahedra(model), parameters, fail);
        mesh.remark = count_cells(blocks) + " are cut into " +
                      std::to_string(mesh.cells.size()) + " tetrahedra" +
                      (mesh.remark.empty() ? "" : "; " + mesh.remark);
        return mesh;
      }
    CoarseMesh            mesh;
    std::vector<Point<3>> curved_nodes;
    for (const GmshElements *block : blocks)
      add_cells(*block, model, parameters, mesh, curved_nodes);
    if (!curved_nodes.empty())
      mesh.geometry = std::make_shared<CoarseGeometry>(
        mesh.cells.front().vertices.size() == 8 ? 27 : 10, curved_nodes);
    drop_repeated_cells(model, mesh);
    name_faces(model, mesh);
    number_vertices(model, mesh);
    return mesh;
  }
} // namespace mortise
