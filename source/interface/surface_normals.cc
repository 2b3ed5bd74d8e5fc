// Normals of a surface at the vertices of its faces and the field between them,
// see surface_face.h.
#include <mortise/interface/surface_evaluation.h>
#include <mortise/interface/surface_face.h>

#include <unordered_map>

namespace mortise
{
  using namespace dealii;



  std::array<Tensor<1, 3>, 4>
  corner_normals(const SurfaceFace &face)
  {
    FacePolynomial polynomial;
    polynomial.reinit(face, face.points[0]);
    // The derivatives along the two edges that meet, one after the other.
    const unsigned int n = n_vertices(face.shape);
    Tensor<1, 3>       begin[4], end[4];
    for (unsigned int k = 0; k < n; ++k)
      {
        EdgePolynomial edges[4];
        edges[0].reinit(polynomial, face.shape, k);
        const unsigned int edge[n_lanes] = {};
        Vec3<Lanes>        x, dx;
        evaluate_edges(edges, edge, Lanes{0., 1.}, x, dx);
        for (unsigned int d = 0; d < 3; ++d)
          {
            begin[k][d] = dx[d][0];
            end[k][d]   = dx[d][1];
          }
      }
    std::array<Tensor<1, 3>, 4> result;
    for (unsigned int k = 0; k < n; ++k)
      {
        const auto         xi = edge_coordinates(face.shape, k, 0.);
        const unsigned int v  = xi[0] + 2. * xi[1];
        result[v] =
          face.orientation * cross_product_3d(end[(k + n - 1) % n], begin[k]);
      }
    return result;
  }



  void
  average_vertex_normals(
    std::vector<SurfaceFace>                        &faces,
    const std::vector<std::array<std::uint64_t, 4>> &vertices)
  {
    AssertDimension(faces.size(), vertices.size());
    // The sum must not depend on the order of the faces beyond rounding of a
    // few additions.
    std::unordered_map<std::uint64_t, Tensor<1, 3>> sums;
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        const auto normals = corner_normals(faces[f]);
        for (unsigned int v = 0; v < n_vertices(faces[f].shape); ++v)
          sums[vertices[f][v]] += normals[v];
      }
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (unsigned int v = 0; v < n_vertices(faces[f].shape); ++v)
        {
          const Tensor<1, 3> &sum    = sums[vertices[f][v]];
          faces[f].vertex_normals[v] = sum / sum.norm();
        }
  }



  Tensor<1, 3>
  averaged_normal(const SurfaceFace &face, const Point<2> &xi)
  {
    const auto &n = face.vertex_normals;
    return (1 - xi[1]) * ((1 - xi[0]) * n[0] + xi[0] * n[1]) +
           xi[1] * ((1 - xi[0]) * n[2] + xi[0] * n[3]);
  }
} // namespace mortise
