#include <mortise/adapt/neighbour_face.h>
#include <mortise/body/elements/face_topology.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/body/mesh/vertex_order.h>
#include <mortise/operators/cells/face_values.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Corners of face @p f at (0, 0), (1, 0) and (0, 1) of its coordinates.
    std::array<unsigned int, 3>
    corners_of_face(const bool simplex, const unsigned int f)
    {
      if (simplex)
        return {{tetrahedron_faces[f][0],
                 tetrahedron_faces[f][1],
                 tetrahedron_faces[f][2]}};
      return {{face_topology::vertex(f, 0, 0),
               face_topology::vertex(f, 1, 0),
               face_topology::vertex(f, 0, 1)}};
    }

    /// The points of face_rule() on face @p f of @p element, in its coordinates.
    std::vector<Point<2>>
    points_in_face(const FiniteElement<dim> &element,
                   const unsigned int        f,
                   const unsigned int        n)
    {
      if (element.reference_cell().is_simplex())
        return gauss_quadrature<dim - 1>(element, n).get_points();
      std::vector<Point<2>> result;
      const Quadrature<dim> rule = face_rule(element, f, n);
      for (const Point<dim> &x : rule.get_points())
        result.emplace_back(x[face_topology::direction(f, 0)],
                            x[face_topology::direction(f, 1)]);
      return result;
    }
  } // namespace

  NeighbourFace
  neighbour_face(const Body::CellIterator &cell,
                 const unsigned int        f,
                 const Body::CellIterator &neighbour)
  {
    const bool    simplex = cell->reference_cell().is_simplex();
    NeighbourFace result;
    Triangulation<dim>::cell_iterator whole = cell;
    if (neighbour->level() < cell->level())
      {
        whole        = cell->parent();
        result.child = 0;
        while (whole->child_index(*result.child) != cell->index())
          ++*result.child;
      }
    const auto given = corners_of_face(simplex, f);
    for (unsigned int i = 0; i < 3; ++i)
      for (const unsigned int v : neighbour->vertex_indices())
        if (neighbour->vertex_index(v) == whole->vertex_index(given[i]))
          result.corners[i] = v;
    const auto holds = [&](const unsigned int g, const unsigned int v) {
      return simplex ?
               v != 6 - tetrahedron_faces[g][0] - tetrahedron_faces[g][1] -
                      tetrahedron_faces[g][2] :
               ((v >> (g / 2)) & 1u) == g % 2;
    };
    for (const unsigned int g : neighbour->face_indices())
      if (holds(g, result.corners[0]) && holds(g, result.corners[1]) &&
          holds(g, result.corners[2]))
        result.number = g;
    return result;
  }

  std::vector<Point<dim>>
  points_in_neighbour(const FiniteElement<dim> &element,
                      const unsigned int        f,
                      const unsigned int        n,
                      const NeighbourFace      &beyond)
  {
    std::array<Point<dim>, 3> corners;
    for (unsigned int i = 0; i < 3; ++i)
      corners[i] =
        element.reference_cell().template vertex<dim>(beyond.corners[i]);
    std::vector<Point<dim>> result;
    for (Point<2> xi : points_in_face(element, f, n))
      {
        if (beyond.child)
          for (unsigned int a = 0; a < 2; ++a)
            xi[a] =
              0.5 * (xi[a] +
                     ((*beyond.child >> face_topology::direction(f, a)) & 1u));
        result.push_back(corners[0] + xi[0] * (corners[1] - corners[0]) +
                         xi[1] * (corners[2] - corners[0]));
      }
    return result;
  }
} // namespace mortise
