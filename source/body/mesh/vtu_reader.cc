#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/inp_shapes.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "mesh_file_parts.h"
#include "vtu_arrays.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Tree = VtuArrays::Tree;

    struct VtuType
    {
      unsigned int dimension, n_vertices, n_nodes;
    };

    /// By VTK's number, what is of dimension 2 and 3. Lagrangian cells (69 to
    /// 72) are of the orders that their numbers of nodes tell.
    const std::map<int, VtuType> vtu_types = {{5, {2, 3, 3}},
                                              {9, {2, 4, 4}},
                                              {10, {3, 4, 4}},
                                              {12, {3, 8, 8}},
                                              {13, {3, 6, 6}},
                                              {14, {3, 5, 5}},
                                              {22, {2, 3, 6}},
                                              {23, {2, 4, 8}},
                                              {24, {3, 4, 10}},
                                              {25, {3, 8, 20}},
                                              {26, {3, 6, 15}},
                                              {27, {3, 5, 13}},
                                              {28, {2, 4, 9}},
                                              {29, {3, 8, 27}}};

    /// Points, lines and what has them.
    const std::set<int> vtu_lower = {1, 2, 3, 4, 21, 35, 68};

    /// The type that a Lagrangian cell of @p n nodes is like; else itself.
    int
    plain_type(const int type, const std::size_t n)
    {
      static const std::map<std::pair<int, std::size_t>, int> plain = {
        {{69, 3}, 5},
        {{69, 6}, 22},
        {{70, 4}, 9},
        {{70, 9}, 28},
        {{71, 4}, 10},
        {{71, 10}, 24},
        {{72, 8}, 12},
        {{72, 27}, 29}};
      const auto found = plain.find({type, n});
      return found == plain.end() ? type : found->second;
    }

    std::vector<Point<3>>
    reference_nodes(const VtuType &type)
    {
      if (type.dimension == 2)
        return std::vector<Point<3>>(type.n_vertices);
      const InpShape       &shape = inp_shape(type.n_vertices);
      std::vector<Point<3>> nodes = shape.vertices;
      for (const auto &edge : shape.edges)
        nodes.push_back(nodes[edge[0]] +
                        (nodes[edge[1]] - nodes[edge[0]]) / 2.);
      if (type.n_nodes == 27)
        nodes.insert(nodes.end(),
                     {{-1, 0, 0},
                      {1, 0, 0},
                      {0, -1, 0},
                      {0, 1, 0},
                      {0, 0, -1},
                      {0, 0, 1},
                      {0, 0, 0}});
      nodes.resize(type.n_nodes);
      return nodes;
    }

    class VtuReader
    {
    public:
      VtuReader(const std::string &content, const FileError &fail)
        : arrays(content, fail)
        , fail(fail)
      {}

      GmshModel
      read()
      {
        const std::string version =
          VtuArrays::attribute(arrays.root(), "version");
        // of Lagrangian hexahedra (VTK 9.0)
        edges_are_exchanged = std::strtod(version.c_str(), nullptr) < 2.05;
        for (const auto &[name, piece] :
             arrays.child(arrays.root(), "UnstructuredGrid"))
          if (name == "Piece")
            read_piece(piece);
        if (model.nodes.empty() || n_cells == 0)
          fail("holds no cells");
        finish();
        return std::move(model);
      }

    private:
      std::size_t
      count(const Tree &piece, const std::string &name) const
      {
        const std::string text = VtuArrays::attribute(piece, name);
        const ReadNumber  n    = read_number(text);
        if (!n.problem.empty() || !(n.value >= 0. && n.value < 4e9) ||
            n.value != std::floor(n.value))
          fail("has a <Piece> with " + name + " = " + in_quotes(text, '\'') +
               "; allowed: a number of things");
        return static_cast<std::size_t>(n.value);
      }

      void
      read_piece(const Tree &piece)
      {
        const std::size_t first    = model.nodes.size();
        const std::size_t n_points = count(piece, "NumberOfPoints");
        const std::size_t n        = count(piece, "NumberOfCells");
        if (n_points == 0 || n == 0)
          return;
        const auto x =
          arrays.reals(arrays.child(arrays.child(piece, "Points"), "DataArray"),
                       3 * n_points);
        for (std::size_t i = 0; i < n_points; ++i)
          {
            const Point<3> point(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
            for (unsigned int d = 0; d < 3; ++d)
              if (!(std::fabs(point[d]) <= largest_length))
                fail("has a coordinate of point " + std::to_string(first + i) +
                     " that is not finite or beyond what is allowed: " +
                     allowed_lengths());
            model.nodes.push_back(point);
            model.node_tags.push_back(first + i);
          }
        const Tree &cells  = arrays.child(piece, "Cells");
        const auto  types  = arrays.integers(arrays.array(cells, "types"), n);
        const auto offsets = arrays.integers(arrays.array(cells, "offsets"), n);
        const auto nodes = arrays.integers(arrays.array(cells, "connectivity"));
        const auto ids_2 = ids(piece, boundary_names, n),
                   ids_3 = ids(piece, material_names, n);
        for (std::size_t c = 0, begin = 0; c < n; ++c)
          {
            if (offsets[c] < static_cast<std::int64_t>(begin) ||
                offsets[c] > static_cast<std::int64_t>(nodes.size()))
              fail("has a cell " + std::to_string(n_cells) +
                   " whose offset is " + std::to_string(offsets[c]) +
                   "; allowed: ascending, up to " +
                   std::to_string(nodes.size()));
            std::vector<unsigned int> of_cell;
            for (; begin < static_cast<std::size_t>(offsets[c]); ++begin)
              {
                if (nodes[begin] < 0 ||
                    nodes[begin] >= static_cast<std::int64_t>(n_points))
                  fail("has a cell " + std::to_string(n_cells) +
                       " with the point " + std::to_string(nodes[begin]) +
                       "; allowed: 0 to " + std::to_string(n_points - 1));
                of_cell.push_back(first + nodes[begin]);
              }
            add_cell(types[c],
                     std::move(of_cell),
                     ids_2.empty() ? -1 : ids_2[c],
                     ids_3.empty() ? -1 : ids_3[c]);
          }
      }

      /// Of the cells of @p piece: the first array of integers of these names,
      /// or else of any; empty: there is none.
      std::vector<std::int64_t>
      ids(const Tree                     &piece,
          const std::vector<std::string> &names,
          const std::size_t               n) const
      {
        const auto data = piece.find("CellData");
        if (data == piece.not_found())
          return {};
        const Tree *chosen = nullptr;
        std::size_t rank   = names.size() + 1;
        for (const auto &[kind, array] : data->second)
          {
            const std::string type = VtuArrays::attribute(array, "type");
            const std::string components =
              VtuArrays::attribute(array, "NumberOfComponents");
            if (kind != "DataArray" || type.find("Int") == std::string::npos ||
                (!components.empty() && components != "1"))
              continue;
            const std::size_t mine =
              std::find(names.begin(),
                        names.end(),
                        VtuArrays::attribute(array, "Name")) -
              names.begin();
            if (mine < rank)
              {
                rank   = mine;
                chosen = &array;
              }
          }
        return chosen == nullptr ? std::vector<std::int64_t>() :
                                   arrays.integers(*chosen, n);
      }

      void
      add_cell(const int                 type,
               std::vector<unsigned int> nodes,
               const std::int64_t        boundary,
               const std::int64_t        material)
      {
        const std::size_t number = n_cells++;
        if (vtu_lower.count(type) > 0)
          return;
        const int  plain = plain_type(type, nodes.size());
        const auto known = vtu_types.find(plain);
        if (known == vtu_types.end() || known->second.n_nodes != nodes.size())
          fail("has a cell " + std::to_string(number) + " of VTK's type " +
               std::to_string(type) + " with " + std::to_string(nodes.size()) +
               " nodes; allowed: triangles, quadrilaterals, tetrahedra, "
               "pyramids, wedges and hexahedra of first or second order (5, 9, "
               "10, 12 to 14, 22 to 29 and, but for wedges, 69 to 72)");
        if (type == 72 && plain == 29 && edges_are_exchanged)
          std::swap(nodes[18], nodes[19]);
        if (known->second.n_vertices == 6)
          turn_wedge(nodes);
        const std::int64_t id =
          known->second.dimension == 2 ? boundary : material;
        if (id > std::numeric_limits<int>::max() - 1)
          fail("has a cell " + std::to_string(number) + " with the id " +
               std::to_string(id) + "; allowed: up to 2147483646");
        const int     group = id < 0 ? -1 : static_cast<int>(id);
        GmshElements &block = blocks[{plain, group}];
        if (block.reference.empty())
          {
            block.dimension  = known->second.dimension;
            block.n_vertices = known->second.n_vertices;
            block.order      = nodes.size() > block.n_vertices ? 2 : 1;
            block.type       = "VTK " + std::to_string(type);
            block.reference  = reference_nodes(known->second);
          }
        block.nodes.insert(block.nodes.end(),
                           nodes.begin(),
                           nodes.begin() + block.reference.size());
        block.tags.push_back(number);
      }

      /// VTK has the first three vertices the other way round than gmsh, but
      /// not all who write files do.
      void
      turn_wedge(std::vector<unsigned int> &nodes) const
      {
        const auto edge = [&](const unsigned int v) {
          return model.nodes[nodes[v]] - model.nodes[nodes[0]];
        };
        if (cross_product_3d(edge(1), edge(2)) * edge(3) >= 0.)
          return;
        std::swap(nodes[1], nodes[2]);
        std::swap(nodes[4], nodes[5]);
        if (nodes.size() == 15)
          {
            std::swap(nodes[6], nodes[8]);
            std::swap(nodes[9], nodes[11]);
            std::swap(nodes[13], nodes[14]);
          }
      }

      /// Blocks with their groups. A boundary 0 is none in the program: it gets
      /// the next free number, and keeps its name.
      void
      finish()
      {
        int largest = 0;
        for (const auto &block : blocks)
          largest = std::max(largest, block.first.second);
        for (const unsigned int dimension : {2, 3})
          for (auto &[key, block] : blocks)
            if (block.dimension == dimension)
              {
                const int id = key.second;
                if (id >= 0)
                  {
                    const int tag =
                      dimension == 2 && id == 0 ? largest + 1 : id;
                    block.groups = {tag};
                    (dimension == 2 ? model.surface_names :
                                      model.volume_names)[tag] =
                      std::to_string(id);
                  }
                model.elements.push_back(std::move(block));
              }
      }

      const std::vector<std::string> boundary_names = {"boundary_id",
                                                       "boundary",
                                                       "gmsh:physical",
                                                       "CellEntityIds",
                                                       "medit:ref"};
      const std::vector<std::string> material_names = {"material_id",
                                                       "material",
                                                       "MaterialIDs",
                                                       "gmsh:physical",
                                                       "CellEntityIds",
                                                       "medit:ref"};

      const VtuArrays  arrays;
      const FileError &fail;
      bool             edges_are_exchanged = false;
      std::size_t      n_cells             = 0;
      GmshModel        model;
      /// By type and id of the cells, -1: none.
      std::map<std::pair<int, int>, GmshElements> blocks;
    };
  } // namespace

  GmshModel
  read_vtu(const std::string &content, const FileError &fail)
  {
    return VtuReader(content, fail).read();
  }
} // namespace mortise
