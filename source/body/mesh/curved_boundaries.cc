#include <deal.II/base/geometry_info.h>
#include <deal.II/base/utilities.h>

#include <deal.II/grid/manifold_lib.h>

#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/curved_boundaries.h>
#include <mortise/body/mesh/mesh_file.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "surface_fit.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    const std::string allowed_entries =
      "entries \"boundary: shape\" separated by ';', the shape one of: sphere, sphere x, y, z "
      "(centre), sphere x, y, z, radius; cylinder, cylinder x, y, z, ax, ay, az (point and "
      "direction of the axis), cylinder x, y, z, ax, ay, az, radius; step FILE";

    std::vector<double>
    read_numbers(const std::string &text)
    {
      std::vector<double> numbers;
      for (const std::string &part : Utilities::split_string_list(text, ','))
        {
          const ReadNumber number = read_number(part);
          if (!number.problem.empty())
            return {std::nan("")};
          numbers.push_back(number.value);
        }
      return numbers;
    }

    bool
    sensible(const CurvedBoundary &entry)
    {
      const auto &x = entry.numbers;
      if (entry.boundary.empty() ||
          !std::all_of(x.begin(), x.end(), [](const double number) {
            return std::isfinite(number);
          }))
        return false;
      if (entry.kind == "step")
        return !entry.file.empty();
      if (entry.kind == "sphere")
        return x.empty() || x.size() == 3 || (x.size() == 4 && x[3] > 0.);
      return entry.kind == "cylinder" &&
             (x.empty() || ((x.size() == 6 || (x.size() == 7 && x[6] > 0.)) &&
                            x[3] * x[3] + x[4] * x[4] + x[5] * x[5] > 0.));
    }

    /// Faces of a boundary in parts that have no vertex in common.
    std::vector<std::vector<const CellData<2> *>>
    connected_parts(const CoarseMesh &mesh, const types::boundary_id id)
    {
      std::vector<unsigned int> root(mesh.vertices.size());
      for (unsigned int v = 0; v < root.size(); ++v)
        root[v] = v;
      const auto find = [&](unsigned int v) {
        while (root[v] != v)
          v = root[v] = root[root[v]];
        return v;
      };
      for (const CellData<2> &face : mesh.faces.boundary_quads)
        if (face.boundary_id == id)
          for (const unsigned int v : face.vertices)
            root[find(v)] = find(face.vertices[0]);
      std::map<unsigned int, std::vector<const CellData<2> *>> parts;
      for (const CellData<2> &face : mesh.faces.boundary_quads)
        if (face.boundary_id == id)
          parts[find(face.vertices[0])].push_back(&face);
      std::vector<std::vector<const CellData<2> *>> result;
      for (const auto &part : parts)
        result.push_back(part.second);
      return result;
    }

    std::set<unsigned int>
    vertices_of(const std::vector<const CellData<2> *> &faces)
    {
      std::set<unsigned int> vertices;
      for (const CellData<2> *face : faces)
        vertices.insert(face->vertices.begin(), face->vertices.end());
      return vertices;
    }

    /// The faces of a STEP file that hold some face of the mesh, else all.
    SurfacePointer
    choose_step_faces(const std::vector<SurfacePointer>      &candidates,
                      const CoarseMesh                       &mesh,
                      const std::vector<const CellData<2> *> &faces)
    {
      std::set<std::size_t> used;
      for (const CellData<2> *face : faces)
        {
          double      least   = std::numeric_limits<double>::max();
          std::size_t nearest = 0;
          for (std::size_t s = 0; s < candidates.size(); ++s)
            {
              double worst = 0.;
              for (const unsigned int v : face->vertices)
                worst =
                  std::max(worst,
                           std::fabs(
                             candidates[s]->distance(mesh.vertices[v]).value));
              if (worst < least)
                {
                  least   = worst;
                  nearest = s;
                }
            }
          used.insert(nearest);
        }
      std::vector<SurfacePointer> chosen;
      for (const std::size_t s : used)
        chosen.push_back(candidates[s]);
      return make_nearest_of(chosen);
    }

    SurfacePointer
    shape_of(const CurvedBoundary                   &entry,
             const CoarseMesh                       &mesh,
             const std::vector<const CellData<2> *> &faces,
             const std::string                      &where)
    {
      std::vector<Point<3>> points;
      for (const unsigned int v : vertices_of(faces))
        points.push_back(mesh.vertices[v]);
      if (entry.kind == "sphere")
        return fit_sphere(points, entry.numbers, where);
      std::vector<Tensor<1, 3>> normals;
      for (const CellData<2> *face : faces)
        {
          const auto &v = face->vertices;
          normals.push_back(
            cross_product_3d(mesh.vertices[v[1]] - mesh.vertices[v[0]],
                             mesh.vertices[v[2]] - mesh.vertices[v[0]]));
        }
      return fit_cylinder(points, normals, entry.numbers, where);
    }

    /// All vertices are on @p surface but for rounding.
    void
    check_distances(const Surface                &surface,
                    const CoarseMesh             &mesh,
                    const std::set<unsigned int> &vertices,
                    const std::string            &where)
    {
      constexpr double rounding = 1e-6;
      double           worst    = 0.;
      unsigned int     at       = 0;
      for (const unsigned int v : vertices)
        {
          const double off =
            std::fabs(surface.distance(mesh.vertices[v]).value);
          if (!(off <= worst))
            {
              worst = off;
              at    = v;
            }
        }
      if (worst <= rounding * surface.size())
        return;
      std::ostringstream message;
      message
        << where << ": the vertex (" << mesh.vertices[at] << ") is " << worst
        << " off the " << surface.text()
        << "; allowed: " << rounding * surface.size()
        << ". Is this boundary one such surface in the coordinates of the file?";
      throw InputError(message.str());
    }

    types::boundary_id
    find_boundary(const CurvedBoundary &entry,
                  const CoarseMesh     &mesh,
                  const std::string    &where)
    {
      const auto found = mesh.names.boundaries.find(entry.boundary);
      if (found != mesh.names.boundaries.end())
        return found->second;
      std::vector<std::string> existing;
      for (const auto &boundary : mesh.names.boundaries)
        existing.push_back(boundary.first);
      const std::string nearest = nearest_name(entry.boundary, existing);
      throw InputError(
        where + ": Curved boundaries names " + in_quotes(entry.boundary, '\'') +
        (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)") +
        ", which the mesh does not have; it has: " + join_names(existing));
    }

    /// Put the vertices of curved boundaries on all of their surfaces.
    void
    place_vertices(CoarseMesh &mesh)
    {
      std::map<unsigned int, std::vector<SurfacePointer>> surfaces;
      for (const CellData<2> &face : mesh.faces.boundary_quads)
        {
          const auto shape = mesh.shapes.find(face.boundary_id);
          if (shape != mesh.shapes.end())
            for (const unsigned int v : face.vertices)
              {
                auto &all = surfaces[v];
                if (all.size() < 2 &&
                    std::count(all.begin(), all.end(), shape->second) == 0)
                  all.push_back(shape->second);
              }
        }
      for (const auto &[v, all] : surfaces)
        mesh.vertices[v] = project(all, mesh.vertices[v]);
    }
  } // namespace

  std::vector<CurvedBoundary>
  parse_curved_boundaries(const std::string &text, const std::string &where)
  {
    std::vector<CurvedBoundary> entries;
    for (const std::string &part : Utilities::split_string_list(text, ';'))
      {
        if (part.empty())
          continue;
        const std::size_t colon = part.rfind(": ") == std::string::npos ?
                                    part.find(':') :
                                    part.find(": ");
        CurvedBoundary    entry;
        entry.boundary = Utilities::trim(part.substr(0, colon));
        std::istringstream rest(
          colon == std::string::npos ? "" : part.substr(colon + 1));
        rest >> entry.kind;
        std::string numbers;
        std::getline(rest, numbers);
        if (entry.kind == "step")
          entry.file = Utilities::trim(numbers);
        else
          entry.numbers = read_numbers(numbers);
        if (!sensible(entry))
          throw InputError(where + ": Curved boundaries has the entry " +
                           in_quotes(part, '\'') +
                           "; allowed: " + allowed_entries);
        for (const CurvedBoundary &other : entries)
          if (other.boundary == entry.boundary)
            throw InputError(where + ": Curved boundaries names " +
                             in_quotes(entry.boundary, '\'') +
                             " twice; allowed: each boundary once");
        entries.push_back(entry);
      }
    return entries;
  }

  void
  fit_curved_boundaries(CoarseMesh           &mesh,
                        const MeshParameters &parameters,
                        const std::string    &where)
  {
    for (const CurvedBoundary &entry :
         parse_curved_boundaries(parameters.curved_boundaries, where))
      {
        if (mesh.geometry != nullptr)
          throw InputError(
            where +
            ": Curved boundaries = " + shortened(parameters.curved_boundaries) +
            ", but the file " + file_in_quotes(parameters.file, '\'') +
            " is of second order, whose own curved geometry is kept; allowed: a file "
            "of first order (gmsh -order 1), or no Curved boundaries");
        const auto        id = find_boundary(entry, mesh, where);
        const std::string here =
          where + ", Curved boundaries, " +
          in_quotes(entry.boundary + ": " + entry.kind, '\'');
        const auto                  parts = connected_parts(mesh, id);
        std::vector<SurfacePointer> candidates, shapes;
        if (entry.kind == "step")
          candidates =
            read_step_faces(located_file(entry.file, parameters.directory),
                            here);
        for (const auto &faces : parts)
          {
            shapes.push_back(entry.kind == "step" ?
                               choose_step_faces(candidates, mesh, faces) :
                               shape_of(entry, mesh, faces, here));
            check_distances(*shapes.back(), mesh, vertices_of(faces), here);
          }
        mesh.shapes[id] = make_nearest_of(shapes);
      }
    place_vertices(mesh);
  }
} // namespace mortise
