#include <deal.II/base/bounding_box.h>

#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/body/mesh/cell_cutting.h>
#include <mortise/body/mesh/surface_patches.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <tuple>

#include "surface_fit.h"

namespace mortise
{
  using namespace dealii;

  Tensor<1, 3>
  area_vector(const std::vector<Point<3>>     &x,
              const std::vector<unsigned int> &v)
  {
    return v.size() == 4 ?
             cross_product_3d(x[v[2]] - x[v[0]], x[v[3]] - x[v[1]]) / 2. :
             cross_product_3d(x[v[1]] - x[v[0]], x[v[2]] - x[v[0]]) / 2.;
  }

  Point<3>
  middle(const std::vector<Point<3>>     &x,
         const std::vector<unsigned int> &vertices)
  {
    Tensor<1, 3> sum;
    for (const unsigned int v : vertices)
      sum += x[v];
    return Point<3>(sum / double(vertices.size()));
  }

  std::set<unsigned int>
  vertices_of(const CoarseMesh &mesh, const SurfacePatch &patch)
  {
    std::set<unsigned int> vertices;
    for (const std::size_t f : patch.faces)
      vertices.insert(mesh.faces.boundary_quads[f].vertices.begin(),
                      mesh.faces.boundary_quads[f].vertices.end());
    return vertices;
  }

  namespace
  {
    /// Vertices of a vertex, edge or face in ascending order.
    using EdgeKey = std::pair<unsigned int, unsigned int>;

    Tensor<1, 3>
    area_vector(const CoarseMesh &mesh, const CellData<2> &face)
    {
      return mortise::area_vector(mesh.vertices, around(face.vertices));
    }

    Point<3>
    middle(const CoarseMesh &mesh, const CellData<2> &face)
    {
      return mortise::middle(mesh.vertices, face.vertices);
    }

    /// By face: the first one in its patch.
    std::vector<std::size_t>
    smooth_parts(const CoarseMesh &mesh)
    {
      const double least_cosine = std::cos(numbers::PI * 40. / 180.);
      const auto  &faces        = mesh.faces.boundary_quads;
      std::vector<std::size_t> root(faces.size());
      std::iota(root.begin(), root.end(), 0);
      const auto find = [&root](std::size_t f) {
        while (root[f] != f)
          f = root[f] = root[root[f]];
        return f;
      };
      std::map<EdgeKey, std::vector<std::size_t>> at_edge;
      for (std::size_t f = 0; f < faces.size(); ++f)
        {
          const auto v = around(faces[f].vertices);
          for (std::size_t i = 0; i < v.size(); ++i)
            at_edge[std::minmax(v[i], v[(i + 1) % v.size()])].push_back(f);
        }
      for (const auto &[edge, neighbours] : at_edge)
        for (std::size_t i = 1; i < neighbours.size(); ++i)
          {
            const std::size_t  f = neighbours[0], g = neighbours[i];
            const Tensor<1, 3> n = area_vector(mesh, faces[f]),
                               m = area_vector(mesh, faces[g]);
            // the order of vertices need not go around outer normals
            if (faces[f].boundary_id == faces[g].boundary_id &&
                std::fabs(n * m) > least_cosine * n.norm() * m.norm())
              {
                const std::size_t a = find(f), b = find(g);
                root[std::max(a, b)] = std::min(a, b);
              }
          }
      for (std::size_t f = 0; f < faces.size(); ++f)
        root[f] = find(f);
      return root;
    }

    /// Faces by the patch that they are in, in the order of the patches' first
    /// faces.
    std::vector<std::vector<std::size_t>>
    faces_of_patches(const CoarseMesh &mesh, const bool cad)
    {
      const auto &faces = mesh.faces.boundary_quads;
      std::map<std::size_t, std::vector<std::size_t>> parts;
      const auto root = cad ? std::vector<std::size_t>() : smooth_parts(mesh);
      for (std::size_t f = 0; f < faces.size(); ++f)
        parts[cad ? faces[f].boundary_id : root[f]].push_back(f);
      std::vector<std::vector<std::size_t>> result;
      for (auto &part : parts)
        result.push_back(std::move(part.second));
      return result;
    }

    std::vector<Point<3>>
    points_of(const CoarseMesh &mesh, const SurfacePatch &patch)
    {
      std::vector<Point<3>> points;
      for (const unsigned int v : vertices_of(mesh, patch))
        points.push_back(mesh.vertices[v]);
      return points;
    }

    /// Are all points on @p shape, but for rounding?
    bool
    lies_on(const std::vector<Point<3>> &points,
            const Surface               &shape,
            const double                 size)
    {
      return std::all_of(points.begin(), points.end(), [&](const auto &x) {
        return std::fabs(shape.distance(x).value) < 1e-6 * size;
      });
    }

    /// Least cosine of the angle between faces and @p shape in their middles: the
    /// points of a cylinder's ends are on a sphere, too.
    double
    agreement(const CoarseMesh   &mesh,
              const SurfacePatch &patch,
              const Surface      &shape)
    {
      double least = 1.;
      for (const std::size_t f : patch.faces)
        {
          const CellData<2> &face = mesh.faces.boundary_quads[f];
          const Tensor<1, 3> n    = area_vector(mesh, face);
          least =
            std::min(least,
                     std::fabs(n * shape.distance(middle(mesh, face)).normal) /
                       n.norm());
        }
      return least;
    }

    void
    recognise_shape(const CoarseMesh &mesh, SurfacePatch &patch)
    {
      const std::vector<Point<3>> points = points_of(mesh, patch);
      const double                size   = patch.low.distance(patch.high);
      Tensor<1, 3>                normal;
      std::vector<Tensor<1, 3>>   normals;
      for (const std::size_t f : patch.faces)
        {
          normals.push_back(area_vector(mesh, mesh.faces.boundary_quads[f]));
          normal += (normal * normals.back() < 0. ? -1. : 1.) * normals.back();
        }
      patch.kind      = "free";
      const auto take = [&](const std::string    &kind,
                            const SurfacePointer &shape) {
        patch.kind   = kind;
        patch.shape  = shape;
        patch.radius = kind == "plane" ? 0. : shape->size();
      };
      const SurfacePointer plane = make_plane(patch.centre, normal);
      if (lies_on(points, *plane, size))
        return take("plane", plane);
      double best = std::cos(numbers::PI / 4.);
      for (const std::string kind : {"cylinder", "sphere"})
        try
          {
            if (points.size() < 6)
              break; // as many as unknowns
            const SurfacePointer shape =
              kind == "sphere" ? fit_sphere(points, {}, "") :
                                 fit_cylinder(points, normals, {}, "");
            const double good = agreement(mesh, patch, *shape);
            if (lies_on(points, *shape, shape->size()) && good > best)
              {
                best = good;
                take(kind, shape);
              }
          }
        catch (const InputError &)
          {} // the points determine none
    }

    void
    measure(const CoarseMesh &mesh, SurfacePatch &patch)
    {
      std::tie(patch.low, patch.high) =
        BoundingBox<3>(points_of(mesh, patch)).get_boundary_points();
      Tensor<1, 3> moment, sum;
      for (const std::size_t f : patch.faces)
        {
          const CellData<2> &face = mesh.faces.boundary_quads[f];
          const double       area = area_vector(mesh, face).norm();
          patch.area += area;
          moment += area * middle(mesh, face);
          sum += middle(mesh, face);
        }
      // a broken mesh may have a face without area
      patch.centre = patch.area > 0. ?
                       Point<3>(moment / patch.area) :
                       Point<3>(sum / double(patch.faces.size()));
    }
  } // namespace

  std::string
  SurfacePatch::text() const
  {
    std::ostringstream text;
    text << kind;
    if (radius > 0.)
      text << " of radius " << radius;
    return text.str();
  }

  std::vector<SurfacePatch>
  surface_patches(const CoarseMesh &mesh, const bool cad)
  {
    std::vector<SurfacePatch> patches;
    for (const auto &faces : faces_of_patches(mesh, cad))
      {
        SurfacePatch patch;
        patch.faces  = faces;
        patch.id     = mesh.faces.boundary_quads[faces[0]].boundary_id;
        patch.number = cad ? patch.id : patches.size() + 1;
        measure(mesh, patch);
        recognise_shape(mesh, patch);
        patches.push_back(patch);
      }
    return patches;
  }
} // namespace mortise
