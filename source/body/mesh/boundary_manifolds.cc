#include <deal.II/grid/manifold_lib.h>

#include <mortise/body/mesh/curved_boundaries.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of everything but curved boundaries, where it is blended.
    constexpr types::manifold_id inside_id = 0;

    /// Planes of faces, equal ones only once.
    class Planes
    {
    public:
      /// None if the vertices of @p face are in no plane.
      SurfacePointer
      of(const CoarseMesh &mesh, const CellData<2> &face)
      {
        constexpr double rounding = 1e-9;

        const auto        &v     = face.vertices;
        const Point<3>    &point = mesh.vertices[v[0]];
        const Tensor<1, 3> normal =
          cross_product_3d(mesh.vertices[v[1]] - point,
                           mesh.vertices[v[2]] - point);
        const double size      = std::sqrt(normal.norm());
        const auto   new_plane = make_plane(point, normal);
        if (v.size() == 4 &&
            std::fabs(new_plane->distance(mesh.vertices[v[3]]).value) >
              rounding * size)
          return nullptr;
        for (const SurfacePointer &plane : planes)
          if (std::all_of(v.begin(), v.end(), [&](const unsigned int w) {
                return std::fabs(plane->distance(mesh.vertices[w]).value) <=
                       rounding * size;
              }))
            return plane;
        planes.push_back(new_plane);
        return new_plane;
      }

    private:
      std::vector<SurfacePointer> planes;
    };

    std::array<unsigned int, 2>
    edge_key(const unsigned int a, const unsigned int b)
    {
      return {{std::min(a, b), std::max(a, b)}};
    }

    /// Neighbouring vertices around a face.
    std::vector<std::array<unsigned int, 2>>
    edges_of(const CellData<2> &face)
    {
      const auto &v = face.vertices;
      if (v.size() == 3)
        return {edge_key(v[0], v[1]),
                edge_key(v[1], v[2]),
                edge_key(v[2], v[0])};
      return {edge_key(v[0], v[1]),
              edge_key(v[2], v[3]),
              edge_key(v[0], v[2]),
              edge_key(v[1], v[3])};
    }

    void
    add_once(std::vector<SurfacePointer> &surfaces,
             const SurfacePointer        &surface)
    {
      if (surface != nullptr && surfaces.size() < 2 &&
          std::count(surfaces.begin(), surfaces.end(), surface) == 0)
        surfaces.push_back(surface);
    }

    /// A manifold and its id for each different list of surfaces.
    class Registry
    {
    public:
      types::manifold_id
      id(const std::vector<SurfacePointer> &surfaces)
      {
        const auto known = ids.find(surfaces);
        if (known != ids.end())
          return known->second;
        const types::manifold_id id = inside_id + 1 + ids.size();
        ids[surfaces]               = id;
        manifolds[id] = std::make_shared<SurfaceManifold>(surfaces);
        return id;
      }

      Manifolds manifolds;

    private:
      std::map<std::vector<SurfacePointer>, types::manifold_id> ids;
    };
  } // namespace

  SurfaceManifold::SurfaceManifold(const std::vector<SurfacePointer> &surfaces)
    : surfaces(surfaces)
  {}

  CurvedEdges
  curved_edges(const CoarseMesh &mesh)
  {
    CurvedEdges edges;
    for (const CellData<2> &face : mesh.faces.boundary_quads)
      {
        const auto shape = mesh.shapes.find(face.boundary_id);
        if (shape != mesh.shapes.end())
          for (const auto &edge : edges_of(face))
            add_once(edges[edge], shape->second);
      }
    Planes planes;
    for (const CellData<2> &face : mesh.faces.boundary_quads)
      if (mesh.shapes.count(face.boundary_id) == 0)
        for (const auto &edge : edges_of(face))
          {
            const auto curved = edges.find(edge);
            if (curved != edges.end())
              add_once(curved->second, planes.of(mesh, face));
          }
    return edges;
  }

  Manifolds
  create_coarse_triangulation(const CoarseMesh &mesh,
                              Triangulation<3> &triangulation)
  {
    triangulation.create_triangulation(mesh.vertices, mesh.cells, mesh.faces);
    if (mesh.manifold != nullptr)
      {
        triangulation.set_all_manifold_ids(0);
        triangulation.set_manifold(0, *mesh.manifold);
      }
    if (mesh.shapes.empty())
      return {};
    const CurvedEdges edges = curved_edges(mesh);
    Registry          registry;
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
        {
          if (!cell->face(f)->at_boundary())
            continue;
          const auto shape = mesh.shapes.find(cell->face(f)->boundary_id());
          if (shape == mesh.shapes.end())
            continue;
          cell->face(f)->set_manifold_id(registry.id({shape->second}));
          for (unsigned int l = 0; l < cell->face(f)->n_lines(); ++l)
            {
              const auto line = cell->face(f)->line(l);
              const auto edge = edges.find(
                edge_key(line->vertex_index(0), line->vertex_index(1)));
              line->set_manifold_id(
                registry.id(edge == edges.end() ?
                              std::vector<SurfacePointer>{shape->second} :
                              edge->second));
            }
        }
    for (const auto &[id, manifold] : registry.manifolds)
      triangulation.set_manifold(id, *manifold);
    return registry.manifolds;
  }

  void
  blend_into_cells(Triangulation<3> &triangulation)
  {
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      {
        cell->set_manifold_id(inside_id);
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->manifold_id() == numbers::flat_manifold_id)
            cell->face(f)->set_manifold_id(inside_id);
        for (const unsigned int l : cell->line_indices())
          if (cell->line(l)->manifold_id() == numbers::flat_manifold_id)
            cell->line(l)->set_manifold_id(inside_id);
      }
    TransfiniteInterpolationManifold<3> inside;
    inside.initialize(triangulation);
    triangulation.set_manifold(inside_id, inside);
  }
} // namespace mortise
