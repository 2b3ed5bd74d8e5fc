#include <algorithm>

#include "pair_scratch.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// A convex polygon with few corners.
    struct ConvexPolygon
    {
      static constexpr unsigned int max_corners = 16;

      unsigned int n = 0;
      double       x[max_corners][2];
    };

    /// One step of Sutherland and Hodgman for straight edges.
    template <unsigned int side>
    void
    clip_to_side(const ConvexPolygon &polygon, ConvexPolygon &result)
    {
      result.n = 0;
      for (unsigned int i = 0; i < polygon.n; ++i)
        {
          const double(&p)[2] = polygon.x[i];
          const double(&q)[2] = polygon.x[i + 1 < polygon.n ? i + 1 : 0];
          const double f_p = inside_by(p, side), f_q = inside_by(q, side);
          if (f_p >= 0)
            {
              result.x[result.n][0]   = p[0];
              result.x[result.n++][1] = p[1];
            }
          if ((f_p > 0 && f_q < 0) || (f_p < 0 && f_q > 0))
            {
              // From the inner to the outer end, whichever way the edge is run
              // through.
              const double(&in)[2] = f_p > 0 ? p : q,
                    (&out)[2]      = f_p > 0 ? q : p;
              const double f_in    = std::max(f_p, f_q),
                           f_out   = std::min(f_p, f_q);
              const double t       = f_in / (f_in - f_out);
              double(&cut)[2]      = result.x[result.n++];
              for (unsigned int d = 0; d < 2; ++d)
                cut[d] = in[d] + t * (out[d] - in[d]);
              put_on_side(cut, side);
            }
        }
    }

    /// The part of @p polygon in the reference domain of a face.
    void
    clip_to_shape(const FaceShape shape, ConvexPolygon &polygon)
    {
      ConvexPolygon other;
      if (shape == FaceShape::triangle)
        {
          clip_to_side<0>(polygon, other);
          clip_to_side<2>(other, polygon);
          clip_to_side<hypotenuse>(polygon, other);
          polygon = other;
        }
      else
        {
          clip_to_side<0>(polygon, other);
          clip_to_side<1>(other, polygon);
          clip_to_side<2>(polygon, other);
          clip_to_side<3>(other, polygon);
        }
    }

    double
    area_of(const ConvexPolygon &polygon)
    {
      double twice = 0;
      for (unsigned int i = 1; i + 1 < polygon.n; ++i)
        twice += (polygon.x[i][0] - polygon.x[0][0]) *
                   (polygon.x[i + 1][1] - polygon.x[0][1]) -
                 (polygon.x[i][1] - polygon.x[0][1]) *
                   (polygon.x[i + 1][0] - polygon.x[0][0]);
      return 0.5 * std::abs(twice);
    }

    // Corners of a cell: bilinear from (s,t) in the unit square. a + s b + t c
    // + s t d.
    struct Cell
    {
      double a[2], b[2], c[2], d[2];
    };

    // A convex polygon as a fan of quadrilaterals from its first corner; an odd
    // corner left over makes a triangle, a quadrilateral with two corners in
    // one.
    unsigned int
    cut_into_cells(const ConvexPolygon &polygon,
                   Cell (&cells)[ConvexPolygon::max_corners])
    {
      unsigned int n_cells = 0;
      for (unsigned int i = 1; i + 1 < polygon.n; i += 2)
        {
          const auto &p_0 = polygon.x[0], &p_1 = polygon.x[i],
                     &p_2 = polygon.x[i + 1];
          const auto &p_3 = i + 2 < polygon.n ? polygon.x[i + 2] : polygon.x[0];
          Cell       &cell = cells[n_cells++];
          for (unsigned int d = 0; d < 2; ++d)
            {
              cell.a[d] = p_0[d];
              cell.b[d] = p_1[d] - p_0[d];
              cell.c[d] = p_3[d] - p_0[d];
              cell.d[d] = p_2[d] - p_1[d] - cell.c[d];
            }
        }
      return n_cells;
    }

    // An affine function of xi: value at the slave's centre and slopes.
    struct Affine
    {
      double value, slope[2];
    };

    struct PointMaps
    {
      double center_xi; ///< of the slave
      Affine eta[2], slave_x[3], master_x[3], gap;
    };

    // The maps of a pair from xi - c_s = shift + A (eta - c_m), c the centres.
    PointMaps
    point_maps(const FaceFrame &s_frame,
               const FaceFrame &m_frame,
               const double (&shift)[2],
               const double (&A)[2][2])
    {
      const Tensor<1, 3> center = m_frame.center - s_frame.center;
      const Tensor<1, 3> s_area =
        cross_product_3d(s_frame.tangent[0], s_frame.tangent[1]);
      PointMaps maps;
      maps.center_xi         = s_frame.center_xi;
      const double det       = A[0][0] * A[1][1] - A[0][1] * A[1][0];
      const double B[2][2]   = {{A[1][1] / det, -A[0][1] / det},
                                {-A[1][0] / det, A[0][0] / det}};
      const double to_height = 1. / (s_area * s_frame.normal);
      for (unsigned int i = 0; i < 2; ++i)
        maps.eta[i] = {m_frame.center_xi - B[i][0] * shift[0] -
                         B[i][1] * shift[1],
                       {B[i][0], B[i][1]}};
      maps.gap = {0., {0., 0.}};
      for (unsigned int d = 0; d < 3; ++d)
        {
          const double *e_0 = maps.eta[0].slope, *e_1 = maps.eta[1].slope;
          const double t_0 = m_frame.tangent[0][d], t_1 = m_frame.tangent[1][d];
          maps.slave_x[d]  = {s_frame.center[d],
                              {s_frame.tangent[0][d], s_frame.tangent[1][d]}};
          maps.master_x[d] = {center[d] +
                                (maps.eta[0].value - m_frame.center_xi) * t_0 +
                                (maps.eta[1].value - m_frame.center_xi) * t_1,
                              {e_0[0] * t_0 + e_1[0] * t_1,
                               e_0[1] * t_0 + e_1[1] * t_1}};
          maps.gap.value += s_area[d] * to_height * maps.master_x[d].value;
          for (unsigned int i = 0; i < 2; ++i)
            maps.gap.slope[i] +=
              s_area[d] * to_height * maps.master_x[d].slope[i];
          maps.master_x[d].value += s_frame.center[d];
        }
      return maps;
    }

    void
    fill_cell(const Cell        &cell,
              const GaussRule   &rule,
              const PointMaps   &maps,
              const double       surface_jacobian,
              const unsigned int offset,
              IntegrationPoints &points)
    {
      const unsigned int n       = rule.square.weight.size();
      const double *__restrict s = rule.square.xi_1.data();
      const double *__restrict t = rule.square.xi_2.data();
      const double *__restrict w = rule.square.weight.data();
      double *__restrict xi_1    = points.slave_xi[0].data() + offset;
      double *__restrict xi_2    = points.slave_xi[1].data() + offset;
      double *__restrict weight  = points.weight.data() + offset;
      for (unsigned int q = 0; q < n; ++q)
        {
          const double st = s[q] * t[q];
          xi_1[q] =
            cell.a[0] + s[q] * cell.b[0] + t[q] * cell.c[0] + st * cell.d[0];
          xi_2[q] =
            cell.a[1] + s[q] * cell.b[1] + t[q] * cell.c[1] + st * cell.d[1];
          const double determinant =
            (cell.b[0] + t[q] * cell.d[0]) * (cell.c[1] + s[q] * cell.d[1]) -
            (cell.b[1] + t[q] * cell.d[1]) * (cell.c[0] + s[q] * cell.d[0]);
          weight[q] = std::abs(determinant) * w[q] * surface_jacobian;
        }
      const double c    = maps.center_xi;
      const auto   fill = [&](const Affine &map, std::vector<double> &values) {
        double *__restrict value = values.data() + offset;
        for (unsigned int q = 0; q < n; ++q)
          value[q] = map.value + (xi_1[q] - c) * map.slope[0] +
                     (xi_2[q] - c) * map.slope[1];
      };
      for (unsigned int i = 0; i < 2; ++i)
        fill(maps.eta[i], points.master_eta[i]);
      for (unsigned int d = 0; d < 3; ++d)
        {
          fill(maps.slave_x[d], points.slave_x[d]);
          fill(maps.master_x[d], points.master_x[d]);
        }
      fill(maps.gap, points.gap);
    }
  } // namespace



  PairResult
  integrate_linear_pair(PairIntegrator::Scratch &scratch,
                        const SurfaceFace       &master,
                        IntegrationPoints       &points)
  {
    PairResult          result;
    const FaceFrame    &s_frame = scratch.slave_frame, &m_frame = master.frame;
    const Tensor<1, 3> &n = s_frame.normal;
    const Tensor<1, 3>  s_area =
      cross_product_3d(s_frame.tangent[0], s_frame.tangent[1]);
    const Tensor<1, 3> m_area =
      cross_product_3d(m_frame.tangent[0], m_frame.tangent[1]);

    // xi - c_s = shift + A (eta - c_m)
    const Tensor<1, 3> center = m_frame.center - s_frame.center;
    double             shift[2], A[2][2];
    for (unsigned int i = 0; i < 2; ++i)
      {
        shift[i] = s_frame.dual[i] * center;
        for (unsigned int j = 0; j < 2; ++j)
          A[i][j] = s_frame.dual[i] * m_frame.tangent[j];
      }
    ConvexPolygon polygon;
    polygon.n = n_vertices(master.shape);
    for (unsigned int v = 0; v < polygon.n; ++v)
      {
        const auto   eta = edge_coordinates(master.shape, v, 0.);
        const double a   = eta[0] - m_frame.center_xi,
                     b   = eta[1] - m_frame.center_xi;
        for (unsigned int i = 0; i < 2; ++i)
          polygon.x[v][i] =
            s_frame.center_xi + shift[i] + A[i][0] * a + A[i][1] * b;
      }
    clip_to_shape(scratch.slave.shape(), polygon);
    const double area = polygon.n < 3 ? 0. : area_of(polygon);
    if (area <= empty_area)
      return result;
    if (!(master.orientation * (n * m_area) < 0))
      {
        result.status = PairStatus::normals_agree;
        return result;
      }

    const PointMaps maps = point_maps(s_frame, m_frame, shift, A);
    for (unsigned int v = 0; v < polygon.n; ++v)
      result.max_gap =
        std::max(result.max_gap,
                 std::abs(
                   maps.gap.value +
                   (polygon.x[v][0] - s_frame.center_xi) * maps.gap.slope[0] +
                   (polygon.x[v][1] - s_frame.center_xi) * maps.gap.slope[1]));
    if (!(result.max_gap <= scratch.gap_limit))
      {
        result.status = PairStatus::too_far;
        return result;
      }

    Cell cells[ConvexPolygon::max_corners];
    result.n_cells          = cut_into_cells(polygon, cells);
    const GaussRule   &rule = scratch.rule(0.);
    const unsigned int n_q  = rule.square.weight.size();
    points.resize(result.n_cells * n_q);
    for (unsigned int c = 0; c < result.n_cells; ++c)
      fill_cell(cells[c], rule, maps, s_area.norm(), c * n_q, points);
    result.area   = area * s_area.norm();
    result.status = PairStatus::accepted;
    return result;
  }
} // namespace mortise
