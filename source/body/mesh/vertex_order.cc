#include <mortise/body/mesh/vertex_order.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    bool
    lower(const Point<3> &a, const Point<3> &b)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (a[d] != b[d])
          return a[d] < b[d];
      return false;
    }
  } // namespace

  VertexOrder
  vertex_order(const std::array<Point<3>, 4> &points)
  {
    VertexOrder order = {{0, 1, 2, 3}};
    std::sort(order.begin(),
              order.end(),
              [&](const unsigned int v, const unsigned int w) {
                return lower(points[v], points[w]);
              });
    return order;
  }

  VertexOrder
  vertex_order(const Triangulation<3>::cell_iterator &cell)
  {
    AssertThrow(cell->reference_cell() == ReferenceCells::Tetrahedron,
                ExcMessage("vertex_order: the cell is a " +
                           cell->reference_cell().to_string() +
                           ", allowed are tetrahedra"));
    return vertex_order(std::array<Point<3>, 4>{
      {cell->vertex(0), cell->vertex(1), cell->vertex(2), cell->vertex(3)}});
  }

  VertexOrder
  vertex_ranks(const VertexOrder &order)
  {
    VertexOrder ranks;
    for (unsigned int r = 0; r < 4; ++r)
      ranks[order[r]] = r;
    return ranks;
  }

  const std::vector<VertexOrder> &
  standard_vertex_orders()
  {
    static const std::vector<VertexOrder> orders = {{{0, 1, 2, 3}},
                                                    {{0, 1, 3, 2}}};
    return orders;
  }

  void
  order_vertices(const std::vector<Point<3>> &vertices,
                 std::vector<CellData<3>>    &cells)
  {
    for (CellData<3> &cell : cells)
      {
        auto &v = cell.vertices;
        AssertThrow(v.size() == 4,
                    ExcMessage("order_vertices: a cell has " +
                               std::to_string(v.size()) +
                               " vertices, allowed are tetrahedra"));
        std::sort(v.begin(),
                  v.end(),
                  [&](const unsigned int a, const unsigned int b) {
                    return lower(vertices[a], vertices[b]);
                  });
        const Tensor<1, 3> x = vertices[v[1]] - vertices[v[0]],
                           y = vertices[v[2]] - vertices[v[0]],
                           z = vertices[v[3]] - vertices[v[0]];
        if (cross_product_3d(x, y) * z < 0.)
          std::swap(v[2], v[3]);
      }
  }
} // namespace mortise
