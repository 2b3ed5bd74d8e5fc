// Points of curved tetrahedra from the manifolds of their lines, faces and
// insides. It never evaluates a mapping.
#pragma once

#include <deal.II/grid/tria.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/body/mesh/vertex_order.h>

#include <array>
#include <map>
#include <vector>

namespace mortise
{
  /// Places of the interpolation points of cells. Where all of a cell has one
  /// manifold, they are means of vertices on it. Else in the hierarchical
  /// basis: a line or face with a manifold takes its points from there; a face
  /// without takes the polynomial to which the modes of its lines extend, and
  /// the inside that to which the modes of lines and faces extend. Modes of
  /// degree k are of the size h^k on smooth boundaries, so that their
  /// extensions are smooth enough for the optimal rates: Ciarlet and Raviart,
  /// Interpolation theory over curved elements (1972); Lenoir (1986). Cells
  /// that share a line or a face have the same points on it.
  class SimplexBlending
  {
  public:
    using CellIterator = dealii::Triangulation<3>::cell_iterator;

    explicit SimplexBlending(unsigned int degree);

    /// At the points of simplex_interpolation_points().
    std::vector<dealii::Point<3>>
    points(const CellIterator &cell);

  private:
    /// What depends on the order of the vertices of a cell only.
    struct Layout
    {
      dealii::FullMatrix<double>                modes; ///< by node, mode
      std::array<std::vector<unsigned int>, 6>  line_nodes;
      std::array<std::vector<unsigned int>, 4>  face_nodes;
      std::vector<unsigned int>                 inner_nodes;
      std::array<dealii::FullMatrix<double>, 6> line_modes; ///< of its nodes
      std::array<dealii::FullMatrix<double>, 4> face_modes;

      /// Of the extension from a face's vertices (ascending) and the nodes of
      /// its lines to its own nodes.
      std::array<dealii::FullMatrix<double>, 4> face_weights;
      std::array<std::vector<unsigned int>, 4>  face_lines;
      std::array<std::vector<unsigned int>, 4>  face_vertices;
    };

    const Layout &
    layout(const VertexOrder &order);
    void
    add_face_weights(Layout &layout, unsigned int face) const;
    void
    bend_line(const CellIterator &cell,
              const Layout       &layout,
              unsigned int        line);
    void
    bend_face(const CellIterator &cell,
              const Layout       &layout,
              unsigned int        face);
    void
    bend_inside(const CellIterator &cell, const Layout &layout);

    const unsigned int                  degree;
    const std::vector<dealii::Point<3>> nodes;
    std::map<VertexOrder, Layout>       layouts;

    /// Of the cell at hand: places, which modes and where they put the nodes.
    std::vector<dealii::Tensor<1, 3>> positions;
  };
} // namespace mortise
