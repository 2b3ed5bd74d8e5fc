#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/text_table.h>
#include <mortise/body/mesh/mesh_file.h>
#include <mortise/output/face_picture.h>
#include <mortise/output/vtu_file.h>
#include <mortise/output/whole_file.h>
#include <mortise/problem/boundary_list.h>
#include <mortise/problem/mesh_request.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::string
    point_text(const Point<3> &x, const double size)
    {
      std::ostringstream text;
      text.precision(5);
      for (unsigned int d = 0; d < 3; ++d)
        text << (d > 0 ? ", " : "")
             << (std::fabs(x[d]) < 1e-9 * size ? 0. : x[d]);
      return text.str();
    }

    std::string
    name_of(const types::boundary_id id, const CoarseMesh &mesh)
    {
      for (const auto &[name, named_id] : mesh.names.boundaries)
        if (named_id == id)
          return name;
      return "";
    }

    /// Numbers of faces by boundary face of the mesh.
    std::vector<unsigned int>
    numbers_of_faces(const MeshSurface &surface)
    {
      std::vector<unsigned int> numbers(
        surface.mesh.faces.boundary_quads.size());
      for (const SurfacePatch &patch : surface.patches)
        for (const std::size_t f : patch.faces)
          numbers[f] = patch.number;
      return numbers;
    }

    std::string
    picture(const MeshSurface &surface)
    {
      const auto               numbers = numbers_of_faces(surface);
      std::vector<PictureFace> faces;
      for (std::size_t f = 0; f < numbers.size(); ++f)
        {
          PictureFace face;
          face.number = numbers[f];
          for (const unsigned int v : surface.outer[f])
            face.vertices.push_back(surface.mesh.vertices[v]);
          faces.push_back(face);
        }
      return face_picture(faces);
    }

    VtuPiece
    vtu_piece(const MeshSurface &surface)
    {
      const auto numbers = numbers_of_faces(surface);
      VtuPiece   piece;
      piece.of_cells.push_back(
        {"face", 1, std::vector<float>(numbers.begin(), numbers.end())});
      for (const std::vector<unsigned int> &vertices : surface.outer)
        {
          piece.begin_cell(vertices.size() == 4 ? LagrangeShape::quadrilateral :
                                                  LagrangeShape::triangle,
                           1);
          for (const unsigned int v : vertices)
            piece.add_point(surface.mesh.vertices[v]);
        }
      return piece;
    }

    std::string
    description(const MeshSurface &surface, const std::string &file)
    {
      const auto [low, high] =
        BoundingBox<3>(surface.mesh.vertices).get_boundary_points();
      const double                          size = low.distance(high);
      std::vector<std::vector<std::string>> rows = {
        {"face", "shape", "area", "centre", "from", "to", "name"}};
      for (const SurfacePatch &patch : surface.patches)
        {
          std::ostringstream area;
          area.precision(5);
          area << patch.area;
          rows.push_back({std::to_string(patch.number),
                          patch.text(),
                          area.str(),
                          point_text(patch.centre, size),
                          point_text(patch.low, size),
                          point_text(patch.high, size),
                          name_of(patch.id, surface.mesh)});
        }
      std::string parts;
      for (const auto &part : surface.mesh.names.materials)
        parts += (parts.empty() ? "" : ", ") + part.second;
      return file + ": " + std::to_string(surface.mesh.cells.size()) +
             " cells in a box from " + point_text(low, size) + " to " +
             point_text(high, size) + "; parts: " + parts +
             "\nAreas are those of flat faces of the mesh.\n\n" +
             text_table(rows, false);
    }
  } // namespace

  std::string
  list_boundaries(const std::string &file,
                  const Settings    &settings,
                  const MPI_Comm     comm)
  {
    const MeshRequest request =
      read_mesh_request("--boundaries", file, settings);
    const bool        reads = Utilities::MPI::this_mpi_process(comm) == 0;
    const std::string start =
      (std::filesystem::path(request.directory) /
       (std::filesystem::path(file).stem().string() + "-faces"))
        .string();
    std::string problem, text, drawing;
    VtuPiece    piece;
    piece.of_cells.push_back({"face", 1, {}});
    if (reads)
      try
        {
          const MeshSurface surface =
            read_surface(request.mesh, "--boundaries");
          text    = description(surface, file);
          drawing = picture(surface);
          piece   = vtu_piece(surface);
        }
      catch (const InputError &error)
        {
          problem = error.what();
        }
    throw_if_any(problem, comm);
    write_vtu_file(piece, start + ".vtu", comm);
    write_whole_file(start + ".svg", drawing, comm);
    return text + "\nPicture: " + start + ".svg; for ParaView: " + start +
           ".vtu. In a scene: Boundaries = NAME: faces 1, 2; or by shape, as "
           "in hole: cylinder radius 5 near 10, 0, 0\n";
  }
} // namespace mortise
