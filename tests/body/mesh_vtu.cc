// Unstructured XML files of VTK: all ways in which arrays are packed and all
// shapes of both orders give the same body, ids of cells are its parts and
// boundaries, and files that are damaged or of other kinds are refused.

#include <mortise/output/lagrange_cells.h>
#include <verdict.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "gmsh_meshes.h"
#include "three_shapes.h"

using namespace dealii;
using namespace gmsh_test;
using namespace three_shapes;
using mortise::CoarseMesh;

namespace
{
  /// How arrays are written.
  struct Packing
  {
    std::string name     = "ascii";
    bool        compress = false, appended = false, raw = false, wide = false;
  };

  const std::vector<Packing> packings = {
    {},
    {"in base 64"},
    {"in base 64, compressed", true},
    {"appended in base 64", false, true},
    {"appended in base 64, compressed", true, true},
    {"appended raw", false, true, true},
    {"appended raw, compressed, wide counts", true, true, true, true}};

  std::string
  base_64(const std::string &bytes)
  {
    const std::string digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3)
      {
        unsigned int bits = 0;
        for (std::size_t k = i; k < i + 3; ++k)
          bits = bits << 8 |
                 (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0);
        for (int k = 0; k < 4; ++k)
          text +=
            i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
      }
    return text;
  }

  class Writer
  {
  public:
    explicit Writer(const Packing &packing)
      : packing(packing)
    {}

    template <typename Number>
    std::string
    array(const std::string         &attributes,
          const std::string         &type,
          const std::vector<Number> &numbers)
    {
      std::string start = "<DataArray type=\"" + type + "\" " + attributes;
      if (packing.name == "ascii")
        {
          std::ostringstream text;
          text.precision(17);
          text << start << " format=\"ascii\">\n";
          for (const Number number : numbers)
            text << +number << "\n";
          return text.str() + "</DataArray>\n";
        }
      const std::string data(reinterpret_cast<const char *>(numbers.data()),
                             numbers.size() * sizeof(Number));
      const std::string packed = pack(data);
      if (!packing.appended)
        return start + " format=\"binary\">\n  " + packed + "\n</DataArray>\n";
      start += " format=\"appended\" offset=\"" +
               std::to_string(appended.size()) + "\"/>\n";
      appended += packed;
      return start;
    }

    std::string
    file(const std::string &inside, const std::string &version = "0.1") const
    {
      return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" "
             "version=\"" +
             version + "\" byte_order=\"LittleEndian\"" +
             (packing.wide ? " header_type=\"UInt64\"" : "") +
             (packing.compress ? " compressor=\"vtkZLibDataCompressor\"" : "") +
             ">\n<UnstructuredGrid>\n" + inside + "</UnstructuredGrid>\n" +
             (packing.appended ?
                std::string("<AppendedData encoding=\"") +
                  (packing.raw ? "raw" : "base64") + "\">\n _" + appended +
                  "\n</AppendedData>\n" :
                "") +
             "</VTKFile>\n";
    }

  private:
    std::string
    counts(const std::vector<std::uint64_t> &numbers) const
    {
      std::string bytes;
      for (const std::uint64_t number : numbers)
        bytes.append(reinterpret_cast<const char *>(&number),
                     packing.wide ? 8 : 4);
      return bytes;
    }

    /// Compressed in blocks of 64 bytes.
    std::string
    pack(const std::string &data) const
    {
      std::string head, body = data;
      if (packing.compress)
        {
          constexpr std::size_t      size    = 64;
          std::vector<std::uint64_t> numbers = {(data.size() + size - 1) / size,
                                                size,
                                                data.size() % size};
          body.clear();
          for (std::size_t at = 0; at < data.size(); at += size)
            {
              const std::string block = data.substr(at, size);
              std::string       packed(200, '\0');
              uLongf            n = packed.size();
              compress(reinterpret_cast<Bytef *>(&packed[0]),
                       &n,
                       reinterpret_cast<const Bytef *>(block.data()),
                       block.size());
              numbers.push_back(n);
              body += packed.substr(0, n);
            }
          head = counts(numbers);
          return packing.raw ? head + body : base_64(head) + base_64(body);
        }
      head = counts({data.size()});
      return packing.raw ? head + body : base_64(head + body);
    }

    const Packing packing;
    std::string   appended;
  };

  struct Grid
  {
    std::vector<double>        points;
    std::vector<std::int64_t>  connectivity, offsets;
    std::vector<unsigned char> types;
    std::vector<std::int32_t>  ids;

    void
    add(const unsigned char              type,
        const std::int32_t               id,
        const std::vector<std::int64_t> &nodes = {})
    {
      connectivity.insert(connectivity.end(), nodes.begin(), nodes.end());
      types.push_back(type);
      offsets.push_back(connectivity.size());
      ids.push_back(id);
    }
  };

  std::string
  text_of(const Grid        &grid,
          const Packing     &packing = {},
          const std::string &ids     = "material",
          const std::string &version = "0.1")
  {
    Writer writer(packing);
    // one after the other: each has its place among the appended ones
    std::string text = "<Piece NumberOfPoints=\"" +
                       std::to_string(grid.points.size() / 3) +
                       "\" NumberOfCells=\"" +
                       std::to_string(grid.types.size()) + "\">\n<Points>\n";
    text += writer.array("NumberOfComponents=\"3\"", "Float64", grid.points);
    text += "</Points>\n<Cells>\n";
    text += writer.array("Name=\"connectivity\"", "Int64", grid.connectivity);
    text += writer.array("Name=\"offsets\"", "Int64", grid.offsets);
    text += writer.array("Name=\"types\"", "UInt8", grid.types);
    text += "</Cells>\n<CellData>\n";
    if (!ids.empty())
      text += writer.array("Name=\"" + ids + "\"", "Int32", grid.ids);
    return writer.file(text + "</CellData>\n</Piece>\n", version);
  }

  /// The bent cube, wedge and tetrahedron with two sides.
  Grid
  deck_grid(const bool quadratic, const bool vtk_wedge)
  {
    Deck                  deck;
    std::vector<Point<3>> nodes = deck.vertices;
    if (vtk_wedge) // seen from its other side
      deck.cells[1] = {2, 3, 9, 6, 7, 10};
    std::map<std::pair<unsigned int, unsigned int>, unsigned> middles;
    Grid                                                      grid;
    const unsigned char types[2][3] = {{12, 13, 10}, {25, 26, 24}};
    for (unsigned int c = 0; c < 3; ++c)
      {
        for (const unsigned int v : deck.cells[c])
          grid.connectivity.push_back(v - 1);
        for (const auto &edge : edges[c])
          if (quadratic)
            {
              const auto key =
                std::minmax(deck.cells[c][edge[0]], deck.cells[c][edge[1]]);
              const auto place = middles.emplace(key, nodes.size());
              if (place.second)
                nodes.push_back(nodes[key.first - 1] +
                                (nodes[key.second - 1] - nodes[key.first - 1]) /
                                  2.);
              grid.connectivity.push_back(place.first->second);
            }
        grid.add(types[quadratic][c], c == 0 ? 1 : 7);
      }
    grid.add(9, 0, {0, 3, 7, 4});
    grid.add(5, 3, {5, 9, 10});
    grid.add(3, 9, {0, 1}); // a line, which is passed over
    for (const Point<3> &node : nodes)
      {
        const Point<3> x = bent(node);
        grid.points.insert(grid.points.end(), x.begin_raw(), x.end_raw());
      }
    return grid;
  }

  unsigned int
  n_faces(const CoarseMesh &mesh, const std::string &name)
  {
    unsigned int n = 0;
    for (const CellData<2> &face : mesh.faces.boundary_quads)
      n += mesh.names.boundaries.count(name) > 0 &&
           face.boundary_id == mesh.names.boundaries.at(name);
    return n;
  }

  void
  check_packings()
  {
    for (const Packing &packing : packings)
      {
        mortise::MeshParameters q = file_parameters(
          write_file("deck.vtu", text_of(deck_grid(true, false), packing)));
        const CoarseMesh mesh =
          mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD);
        verdict(mesh.cells.size() == 6 + 3 + 1 &&
                  std::fabs(volume_of(mesh) / exact_volume() - 1.) < 1e-13 &&
                  n_faces(mesh, "0") == 2 && n_faces(mesh, "3") == 1,
                packing.name + ": all shapes of second order, volume to 1e-13",
                mesh.remark + " " + std::to_string(volume_of(mesh)));
        q.part                = "7";
        const CoarseMesh part = mortise::read_contents(q, "Mesh").mesh;
        verdict(part.cells.size() == 4 && part.names.materials.at(7) == "7",
                packing.name + ": an id is a part",
                part.remark);
      }
  }

  double
  volume_of(const Grid &grid, const std::string &version = "0.1")
  {
    return three_shapes::volume_of(mortise::read_mesh_file(
      file_parameters(
        write_file("grid.vtu", text_of(grid, {}, "material", version))),
      "Mesh",
      MPI_COMM_WORLD));
  }

  void
  check_volume(const std::string &what,
               const Grid        &grid,
               const double       exact,
               const std::string &version = "0.1")
  {
    verdict(what + ": volume",
            std::fabs(volume_of(grid, version) - exact),
            1e-14);
  }

  void
  check_shapes()
  {
    check_volume("the wedge of VTK's documentation",
                 deck_grid(false, true),
                 volume_of(deck_grid(false, false)));
    check_volume("the same of second order",
                 deck_grid(true, true),
                 exact_volume());
    // a cube, bent, with the nodes that the program writes itself
    const QGauss<3> rule(4);
    double          exact = 0.;
    for (unsigned int q = 0; q < rule.size(); ++q)
      exact += rule.weight(q) * bent_determinant(rule.point(q));
    Grid grid;
    for (const auto &node :
         mortise::lagrange_nodes(mortise::LagrangeShape::hexahedron, 2))
      {
        const Point<3> x = bent({0.5 * node[0], 0.5 * node[1], 0.5 * node[2]});
        grid.connectivity.push_back(grid.connectivity.size());
        grid.points.insert(grid.points.end(), x.begin_raw(), x.end_raw());
      }
    grid.add(72, 1);
    grid.add(9, 2, {0, 3, 7, 4});
    check_volume("a hexahedron of Lagrange, version 1.0", grid, exact, "1.0");
    std::swap(grid.connectivity[18], grid.connectivity[19]);
    check_volume("a hexahedron of Lagrange, version 2.2", grid, exact, "2.2");
    grid.types[0] = 29;
    check_volume("a triquadratic hexahedron", grid, exact);
    // a pyramid on the unit square, its sides bent outwards do not count
    Grid pyramid;
    pyramid.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1};
    pyramid.add(14, 1, {0, 1, 2, 3, 4});
    pyramid.add(9, 2, {0, 3, 2, 1});
    check_volume("a pyramid", pyramid, 1. / 3.);
  }

  void
  refuse(const std::string &what,
         const std::string &text,
         const std::string &fragment)
  {
    refused(what, file_parameters(write_file("wrong.vtu", text)), fragment);
  }

  std::string
  replaced(std::string text, const std::string &what, const std::string &by)
  {
    return text.replace(text.find(what), what.size(), by);
  }

  /// What is written in place of what, and the message.
  struct Fault
  {
    const char *name, *what, *by, *message;
  };

  const std::vector<Fault> faults = {
    {"another kind of grid",
     "type=\"UnstructuredGrid\"",
     "type=\"PolyData\"",
     "is a VTK file of type 'PolyData'; allowed: UnstructuredGrid"},
    {"another byte order",
     "LittleEndian",
     "BigEndian",
     "has the byte order BigEndian"},
    {"another compressor",
     "byte_order",
     "compressor=\"vtkLZ4DataCompressor\" byte_order",
     "is compressed by 'vtkLZ4DataCompressor'; allowed: vtkZLib"},
    {"no cells", "Cells=\"6\"", "Cells=\"0\"", "holds no cells"},
    {"fewer cells than are said",
     "Cells=\"6\"",
     "Cells=\"7\"",
     "has the array 'types', which has 6 numbers; allowed: 7 here"},
    {"cells without number",
     "Cells=\"6\"",
     "Cells=\"-1\"",
     "NumberOfCells = '-1'; allowed: a number of things"},
    {"no types", "\"types\"", "\"kinds\"", "has no array 'types'"},
    {"types that are no integers",
     "\"UInt8\"",
     "\"Float64\"",
     "has the array 'types', whose type is Float64; allowed: integers"},
    {"a word among numbers",
     "\"types\" format=\"ascii\">\n12",
     "\"types\" format=\"ascii\">\nx",
     "has the array 'types', with 'x', which is no integer"},
    {"a node that is none",
     "\"connectivity\" format=\"ascii\">\n0",
     "\"connectivity\" format=\"ascii\">\n11",
     "has a cell 0 with the point 11; allowed: 0 to 10"}};

  void
  check_refusals()
  {
    const Grid        grid = deck_grid(false, false);
    const std::string text = text_of(grid);
    refuse("no XML", "solid cube\n", "is no XML file: ");
    refuse("another XML file", "<html></html>", "holds no <VTKFile>");
    for (const Fault &fault : faults)
      refuse(fault.name, replaced(text, fault.what, fault.by), fault.message);
    Grid other     = grid;
    other.types[0] = 42;
    refuse("a polyhedron",
           text_of(other),
           "has a cell 0 of VTK's type 42 with 8 nodes; allowed: triangles");
    other            = grid;
    other.offsets[1] = 3;
    refuse("offsets that go back",
           text_of(other),
           "has a cell 1 whose offset is 3");
    refuse("no ids", text_of(grid, {}, ""), "names no boundary");
    for (const std::string element : {"<a>", "<a b=\"/>\">"})
      {
        std::string deep;
        for (unsigned int i = 0; i < 100000; ++i)
          deep += element;
        refuse(element + " within each other",
               deep,
               "more than 100 elements within each other");
      }
    const std::string packed = text_of(grid, packings[2]);
    refuse("an array that is cut",
           replaced(packed, "<Cells>", "<!--").insert(packed.size() / 2, "-->"),
           "");
    std::mt19937 random(5);
    for (const Packing &packing : packings)
      {
        const std::string whole = text_of(grid, packing);
        unsigned int      bad   = 0;
        for (unsigned int i = 0; i < 100; ++i)
          {
            std::string damaged = whole;
            for (unsigned int k = 0; k < 3; ++k)
              damaged[random() % damaged.size()] =
                static_cast<char>(random() % 256);
            if (i % 4 == 0)
              damaged.resize(random() % damaged.size());
            const std::string message =
              message_of(file_parameters(write_file("wrong.vtu", damaged)));
            bad += message != "(no error)" &&
                   message.find("Mesh: the mesh file '") != 0;
          }
        verdict(bad == 0, "damaged at random: " + packing.name);
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_packings();
  check_shapes();
  check_refusals();
}
