#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <mortise/base/error.h>
#include <mortise/body/mesh_file.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <tuple>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    [[noreturn]] void
    fail(const std::string &where,
         const std::string &file_name,
         const std::string &what)
    {
      throw InputError(where + ": the mesh file '" + file_name + "' " + what);
    }

    /// Read $PhysicalNames: a count, then lines: dimension tag "name".
    void
    read_names(std::istream &in, MeshFileSections &sections)
    {
      std::size_t n = 0;
      in >> n;
      for (std::size_t i = 0; i < n && in; ++i)
        {
          int         dimension = 0, tag = 0;
          std::string line;
          in >> dimension >> tag;
          std::getline(in, line);
          const std::size_t begin = line.find('"'), end = line.rfind('"');
          if (!in || begin == std::string::npos || end <= begin)
            continue;
          const std::string name = line.substr(begin + 1, end - begin - 1);
          if (dimension == 2)
            sections.surface_names[tag] = name;
          else if (dimension == 3)
            sections.volume_names[tag] = name;
        }
    }

    /// Count the elements by type. Version 2: a count, then a line per element:
    /// index type ...; version 4.1: blocks, each headed by: dimension tag type
    /// count.
    void
    read_elements(std::istream     &in,
                  const double      version,
                  MeshFileSections &sections)
    {
      std::string line;
      std::size_t n = 0;
      std::getline(in, line);
      std::istringstream(line) >> n;
      for (std::size_t i = 0; i < n && std::getline(in, line); ++i)
        {
          std::istringstream numbers(line);
          int                first = 0, second = 0, type = 0;
          std::size_t        count = 1;
          if (version < 4.)
            numbers >> first >> type;
          else
            {
              numbers >> first >> second >> type >> count;
              for (std::size_t skipped = 0; skipped < count; ++skipped)
                std::getline(in, line);
            }
          sections.elements[type] += count;
        }
    }

    /// gmsh's element types that a mesh of hexahedra may hold, and names for
    /// some others.
    void
    check_elements(const MeshFileSections &sections,
                   const std::string      &file_name,
                   const std::string      &where)
    {
      static const std::map<int, std::string> others = {
        {2, "triangles"},
        {4, "tetrahedra"},
        {6, "prisms"},
        {7, "pyramids"},
        {10, "9-node quadrilaterals"},
        {11, "10-node tetrahedra"},
        {12, "27-node hexahedra"},
        {16, "8-node quadrilaterals"},
        {17, "20-node hexahedra"}};
      for (const auto &[type, count] : sections.elements)
        if (type != 1 && type != 3 && type != 5 && type != 15)
          {
            const auto name = others.find(type);
            fail(
              where,
              file_name,
              "holds " + std::to_string(count) + " " +
                (name != others.end() ?
                   name->second :
                   "elements of gmsh's type " + std::to_string(type)) +
                "; allowed: 8-node hexahedra with 4-node quadrilaterals on the boundary "
                "(in gmsh: recombine, transfinite or extruded volumes, first order)");
          }
      if (sections.elements.count(5) == 0)
        fail(
          where,
          file_name,
          "holds no volume elements; allowed: a mesh of 8-node hexahedra (were all elements "
          "saved, or a physical volume defined?)");
    }
  } // namespace

  MeshFileSections
  scan_mesh_file(const std::string &file_name, const std::string &where)
  {
    if (file_name.empty())
      throw InputError(
        where + ": Source = file needs File = the name of a gmsh file (.msh)");
    std::ifstream in(file_name);
    std::string   line;
    if (!in || (std::getline(in, line), in.bad()))
      fail(where,
           file_name,
           "cannot be read; does it exist, and is it readable?");
    if (line.substr(0, 11) != "$MeshFormat")
      fail(
        where,
        file_name,
        "does not begin with $MeshFormat; allowed: gmsh's .msh format, version 2.2 or 4.1, "
        "ASCII");
    double version = 0.;
    int    binary  = 1;
    in >> version >> binary;
    if ((version != 2.2 && version != 4.1) || binary != 0)
      fail(
        where,
        file_name,
        "has format version " + std::to_string(version).substr(0, 3) +
          (binary != 0 ? ", binary" : ", ASCII") +
          "; allowed: version 2.2 or 4.1, ASCII (gmsh -format msh41 -bin 0)");
    MeshFileSections sections;
    bool             nodes = false, elements = false;
    while (std::getline(in, line))
      if (line.substr(0, 9) == "$EndNodes")
        nodes = true;
      else if (line.substr(0, 12) == "$EndElements")
        elements = true;
      else if (line.substr(0, 14) == "$PhysicalNames")
        read_names(in, sections);
      else if (line.substr(0, 9) == "$Elements")
        read_elements(in, version, sections);
    if (!nodes || !elements)
      fail(where,
           file_name,
           std::string("ends before ") +
             (nodes ? "$EndElements" : "$EndNodes") +
             "; allowed: a complete file");
    check_elements(sections, file_name, where);
    return sections;
  }

  CoarseMesh
  read_mesh_file(const std::string &file_name, const std::string &where)
  {
    const MeshFileSections sections = scan_mesh_file(file_name, where);
    Triangulation<3>       serial;
    try
      {
        GridIn<3> grid_in(serial);
        grid_in.read(file_name, GridIn<3>::msh);
      }
    catch (const std::exception &error)
      {
        std::string       what = error.what();
        const std::size_t info = what.find("Additional information:");
        what = info == std::string::npos ? "" : what.substr(info + 23);
        what = what.substr(0, what.find("Stacktrace"));
        std::replace(what.begin(), what.end(), '\n', ' ');
        fail(where, file_name, "is not a complete mesh: " + what);
      }
    CoarseMesh mesh;
    std::tie(mesh.vertices, mesh.cells, mesh.faces) =
      GridTools::get_coarse_mesh_description(serial);
    for (const auto &face : mesh.faces.boundary_quads)
      {
        const auto name = sections.surface_names.find(face.boundary_id);
        if (name != sections.surface_names.end())
          mesh.names.boundaries[name->second] = face.boundary_id;
        else if (face.boundary_id !=
                 0) // 0: faces that belong to no physical surface
          mesh.names.boundaries[std::to_string(face.boundary_id)] =
            face.boundary_id;
      }
    for (const auto &cell : mesh.cells)
      {
        const auto name = sections.volume_names.find(cell.material_id);
        mesh.names.materials[cell.material_id] =
          name != sections.volume_names.end() ?
            name->second :
            std::to_string(cell.material_id);
      }
    return mesh;
  }
} // namespace mortise
