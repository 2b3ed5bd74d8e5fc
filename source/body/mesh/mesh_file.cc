#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/boundary_selection.h>
#include <mortise/body/mesh/cell_cutting.h>
#include <mortise/body/mesh/curved_boundaries.h>
#include <mortise/body/mesh/mesh_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "mesh_file_parts.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::string
    file_problem(const std::string &where,
                 const std::string &file_name,
                 const std::string &what)
    {
      return where + ": the mesh file " + file_in_quotes(file_name, '\'') +
             " " + what;
    }

    bool
    is_mesh_file(const std::string &file_name)
    {
      return std::filesystem::path(file_name).extension() == ".msh";
    }

    bool
    is_inp_file(const std::string &file_name)
    {
      return std::filesystem::path(file_name).extension() == ".inp";
    }

    bool
    is_vtu_file(const std::string &file_name)
    {
      return std::filesystem::path(file_name).extension() == ".vtu";
    }

    /// OpenCASCADE takes anything, and says so on the terminal.
    void
    check_cad_content(const std::string &file,
                      const std::string &content,
                      const FileError   &fail)
    {
      const std::string extension =
        std::filesystem::path(file).extension().string();
      const std::string mark = extension == ".geo"  ? "" :
                               extension == ".brep" ? "CASCADE Topology" :
                                                      "ISO-10303-21";
      if (content.find(mark) == std::string::npos)
        fail("does not hold the words " + mark +
             "; allowed: a CAD file of the format that its name tells");
    }

    GmshModel
    read_model(const MeshParameters &parameters, const std::string &where)
    {
      const std::string file =
        located_file(parameters.file, parameters.directory);
      const FileError fail = [&](const std::string &what) {
        throw InputError(file_problem(where, file, what));
      };
      if (is_inp_file(file))
        return read_inp(file, fail);
      const std::string content = content_of(file, fail);
      if (is_mesh_file(file))
        return read_msh(content, fail);
      if (is_vtu_file(file))
        return read_vtu(content, fail);
      if (is_geometry_file(file))
        check_cad_content(file, content, fail);
      try
        {
          return mesh_geometry(file,
                               parameters.mesh_size,
                               parameters.sizes.get());
        }
      catch (const std::runtime_error &error)
        {
          fail(std::string(is_geometry_file(file) ? "cannot be meshed" :
                                                    "cannot be read") +
               "; gmsh says: " + error.what());
        }
      return {};
    }

    /// A body that nothing can refer to is not what anybody wants.
    void
    check_names(const GmshModel &model, CoarseMesh &mesh)
    {
      if (mesh.names.boundaries.empty() && mesh.overlapping_sets.empty())
        mesh.findings.error(
          "the file names no boundary" +
            std::string(
              model.surface_names.empty() ?
                "" :
                " of this part: none of its faces is in a physical surface of "
                "the file"),
          "allowed: a mesh with physical surfaces, by whose names (or tags) a scene "
          "refers to boundaries, as in gmsh's Physical Surface(\"name\") = {...}; or "
          "Boundaries = name: plane z = 0; ..., which names faces by where they are");
    }

    /// All that can be wrong with a mesh but not with the file as such.
    void
    check_mesh(const GmshModel      &model,
               const MeshParameters &parameters,
               const std::string    &where,
               CoarseMesh           &mesh)
    {
      check_volumes(mesh);
      select_boundaries(mesh,
                        parameters.boundaries,
                        model.surfaces_of_geometry,
                        where);
      check_names(model, mesh);
      check_coinciding_nodes(mesh);
      check_edges_and_parts(mesh);
      // points that help to draw have nodes, too
      if (!is_geometry_file(parameters.file))
        check_orphan_nodes(model, mesh);
    }

    CoarseMesh
    read_part(const MeshParameters &parameters, const std::string &where)
    {
      const FileError fail = [&](const std::string &what) {
        throw InputError(file_problem(where, parameters.file, what));
      };
      const GmshModel model = read_model(parameters, where);
      CoarseMesh      mesh  = select_part(model, parameters, fail);
      check_size(mesh, fail);
      check_mesh(model, parameters, where, mesh);
      sort_cells(mesh);
      return mesh;
    }

    /// See MeshSurface::outer.
    std::vector<std::vector<unsigned int>>
    outer_faces(const CoarseMesh &mesh)
    {
      std::vector<std::vector<std::size_t>> cells_at(mesh.vertices.size());
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (const unsigned int v : mesh.cells[c].vertices)
          cells_at[v].push_back(c);
      std::vector<std::vector<unsigned int>> result;
      for (const CellData<2> &face : mesh.faces.boundary_quads)
        {
          std::vector<unsigned int> outer = around(face.vertices);
          const auto               &x     = mesh.vertices;
          for (const std::size_t c : cells_at[outer[0]])
            {
              const auto &cell = mesh.cells[c].vertices;
              if (!std::all_of(outer.begin(), outer.end(), [&](const auto v) {
                    return std::count(cell.begin(), cell.end(), v) > 0;
                  }))
                continue;
              Tensor<1, 3> inwards;
              for (const unsigned int v : cell)
                inwards += x[v] - x[outer[0]];
              if (cross_product_3d(x[outer[1]] - x[outer[0]],
                                   x[outer[2]] - x[outer[0]]) *
                    inwards >
                  0.)
                std::reverse(outer.begin(), outer.end());
            }
          result.push_back(outer);
        }
      return result;
    }

    void
    move(CoarseMesh &mesh, const RigidMotion &motion)
    {
      for (Point<3> &vertex : mesh.vertices)
        vertex = motion(vertex);
      for (auto &shape : mesh.shapes)
        shape.second = shape.second->moved(motion);
      if (mesh.geometry != nullptr)
        {
          auto moved = std::make_shared<CoarseGeometry>(*mesh.geometry);
          moved->move(motion);
          mesh.geometry = moved;
        }
    }
  } // namespace

  std::string
  content_of(const std::string &file, const FileError &fail)
  {
    std::ifstream     in(file, std::ios::binary);
    const std::string content((std::istreambuf_iterator<char>(in)),
                              std::istreambuf_iterator<char>());
    std::error_code   none; // a name that is too long has no status
    if (!std::filesystem::is_regular_file(file, none) || !in.is_open() ||
        in.bad())
      fail("cannot be read; does it exist, and is it readable?");
    if (content.empty())
      fail("is empty");
    return content;
  }

  std::string
  located_file(const std::string &file_name, const std::string &directory)
  {
    namespace fs = std::filesystem;
    std::error_code none;
    const fs::path  beside = fs::path(directory) / file_name;
    return !fs::exists(file_name, none) && fs::exists(beside, none) ?
             beside.string() :
             file_name;
  }

  void
  check_file_parameters(const MeshParameters &parameters,
                        const std::string    &where)
  {
    const std::string &file = parameters.file;
    if (file.empty())
      throw InputError(
        where +
        ": Source = file needs File = the name of a mesh (.msh, .inp, .vtu, .unv, .bdf, .nas, .vtk) or of a "
        "geometry (.geo, .step, .stp, .brep)");
    const bool is_meshed = is_mesh_file(file) || is_inp_file(file) ||
                           is_vtu_file(file) || is_foreign_mesh_file(file);
    if (!is_meshed && !is_geometry_file(file))
      throw InputError(file_problem(
        where,
        file,
        "has a name of no known format; allowed: .msh, .geo, .step, .stp, .brep, "
        ".inp, .vtu, .unv, .bdf, .nas, .vtk"));
    parse_boundaries(parameters.boundaries, where);
    const double size = parameters.mesh_size;
    if (!(size >= 0.) || !std::isfinite(size) || (size > 0. && is_meshed))
      {
        std::ostringstream message;
        message << where << ": Mesh size = " << size << "; allowed: "
                << (is_meshed ?
                      "nothing for a file that is a mesh already" :
                      "a positive length, or 0 for what the geometry says");
        throw InputError(message.str());
      }
  }

  CoarseMesh
  read_mesh_file(const MeshParameters &parameters,
                 const std::string    &where,
                 const MPI_Comm        comm)
  {
    check_file_parameters(parameters, where);
    CoarseMesh  mesh;
    std::string problem;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          mesh = read_part(parameters, where);
        }
      catch (const InputError &error)
        {
          problem = error.what();
        }
    throw_if_any(problem, comm);
    mesh = broadcast(mesh, comm);
    if (mesh.findings.has_errors())
      {
        std::vector<std::string> names;
        for (const auto &name : mesh.names.boundaries)
          names.push_back(name.first);
        throw MeshError(file_problem(where, parameters.file, "has faults:") +
                          "\n" + join_lines(mesh.findings.lines(), 30),
                        names);
      }
    try
      {
        fit_curved_boundaries(mesh, parameters, where);
      }
    catch (const InputError &error)
      {
        problem = error.what(); // a STEP file that is missing on this rank
      }
    throw_if_any(problem, comm);
    move(mesh, rigid_motion(parameters));
    return mesh;
  }

  namespace
  {
    MeshSurface
    surface_of(const GmshModel      &model,
               const MeshParameters &parameters,
               const std::string    &where)
    {
      MeshSurface surface;
      surface.mesh =
        select_part(model, parameters, [&](const std::string &what) {
          throw InputError(file_problem(where, parameters.file, what));
        });
      surface.patches =
        surface_patches(surface.mesh, model.surfaces_of_geometry);
      surface.outer = outer_faces(surface.mesh);
      return surface;
    }
  } // namespace

  MeshSurface
  read_surface(const MeshParameters &parameters, const std::string &where)
  {
    check_file_parameters(parameters, where);
    return surface_of(read_model(parameters, where), parameters, where);
  }

  MeshContents
  read_contents(const MeshParameters &parameters, const std::string &where)
  {
    check_file_parameters(parameters, where);
    const FileError fail = [&](const std::string &what) {
      throw InputError(file_problem(where, parameters.file, what));
    };
    const GmshModel model = read_model(parameters, where);
    MeshContents    contents;
    contents.cells   = count_cells(model, parameters, fail);
    contents.n_nodes = model.nodes.size();
    contents.mesh    = select_part(model, parameters, fail);
    check_mesh(model, parameters, where, contents.mesh);
    return contents;
  }

  std::vector<MeshSurface>
  read_parts(const MeshParameters &parameters, const std::string &where)
  {
    check_file_parameters(parameters, where);
    const GmshModel          model = read_model(parameters, where);
    std::vector<MeshSurface> parts;
    std::set<std::string>    known;
    for (const auto &[tag, name] : model.volume_names)
      if (known.insert(name).second)
        {
          MeshParameters part = parameters;
          part.part           = name;
          parts.push_back(surface_of(model, part, where));
        }
    if (parts.size() < 2)
      throw InputError(file_problem(
        where,
        parameters.file,
        "has " + std::to_string(parts.size()) +
          " bodies (physical volumes, or solids of a CAD file); allowed: two or "
          "more"));
    return parts;
  }
} // namespace mortise
