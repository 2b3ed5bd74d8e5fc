// Faces with the same points: what the general case finds by clipping and
// projection is known.
#include <algorithm>
#include <limits>
#include <optional>

#include "pair_scratch.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Scratch = PairIntegrator::Scratch;

    /// Points closer than this, relative to the size of the face, are one.
    constexpr double coincidence = 1e-13;

    /// eta = origin + along[0] xi_1 + along[1] xi_2: the reference coordinates
    /// of the master in those of the slave.
    struct ReferenceMap
    {
      std::array<int, 2>                origin;
      std::array<std::array<int, 2>, 2> along;

      template <typename Number>
      Number
      coordinate(const unsigned int d,
                 const Number      &xi_1,
                 const Number      &xi_2) const
      {
        return xi_1 * along[0][d] + xi_2 * along[1][d] + origin[d];
      }

      int
      determinant() const
      {
        return along[0][0] * along[1][1] - along[0][1] * along[1][0];
      }
    };

    /// All maps of a reference shape onto itself.
    std::vector<ReferenceMap>
    symmetries(const FaceShape shape)
    {
      const auto make = [](const int o, const int a, const int b) {
        const auto vertex = [](const int v) {
          return std::array<int, 2>{{v % 2, v / 2}};
        };
        ReferenceMap map{vertex(o), {}};
        for (unsigned int d = 0; d < 2; ++d)
          {
            map.along[0][d] = vertex(a)[d] - vertex(o)[d];
            map.along[1][d] = vertex(b)[d] - vertex(o)[d];
          }
        return map;
      };
      std::vector<ReferenceMap> result;
      for (int o = 0; o < static_cast<int>(n_vertices(shape)); ++o)
        {
          const bool triangle = shape == FaceShape::triangle;
          const int  a        = triangle ? (o + 1) % 3 : o ^ 1,
                    b         = triangle ? (o + 2) % 3 : o ^ 2;
          result.push_back(make(o, a, b));
          result.push_back(make(o, b, a));
        }
      return result;
    }

    bool
    maps_to_same_points(const SurfaceFace  &slave,
                        const SurfaceFace  &master,
                        const ReferenceMap &map)
    {
      // coordinates far from the origin have fewer digits
      const double tolerance =
        coincidence * slave.size +
        4. * std::numeric_limits<double>::epsilon() * slave.frame.center.norm();
      const int  g      = slave.degree;
      const auto corner = [&](const int i, const int j) {
        const Tensor<1, 3> difference =
          slave.points[g * (i + (g + 1) * j)] -
          master.points[g * (map.coordinate(0, i, j) +
                             (g + 1) * map.coordinate(1, i, j))];
        return difference.norm_square() <= tolerance * tolerance;
      };
      if (!corner(0, 0) || !corner(1, 0) || !corner(0, 1))
        return false;
      // the nodes of a triangle are not the same in every order of vertices
      FacePolynomial polynomial;
      polynomial.reinit(master, slave.frame.center);
      const LagrangeBasis &basis = lagrange_basis(g);
      for (unsigned int k = 0; k < slave.points.size(); k += n_lanes)
        {
          Lanes       xi[2];
          Vec3<Lanes> x, dx[2];
          for (unsigned int l = 0; l < n_lanes; ++l)
            {
              const unsigned int i =
                std::min<unsigned int>(k + l, slave.points.size() - 1);
              xi[0][l] = basis.node[i % (g + 1)];
              xi[1][l] = basis.node[i / (g + 1)];
            }
          polynomial.evaluate(map.coordinate(0, xi[0], xi[1]),
                              map.coordinate(1, xi[0], xi[1]),
                              x,
                              dx);
          for (unsigned int l = 0;
               l < std::min<unsigned int>(n_lanes, slave.points.size() - k);
               ++l)
            {
              const Tensor<1, 3> other({x[0][l], x[1][l], x[2][l]});
              const bool         beyond = slave.shape == FaceShape::triangle &&
                                  xi[0][l] + xi[1][l] > 1. + 1e-12;
              if (!beyond &&
                  (slave.points[k + l] - slave.frame.center - other).norm() >
                    tolerance)
                return false;
            }
        }
      return true;
    }

    std::optional<ReferenceMap>
    find_map(const SurfaceFace &slave, const SurfaceFace &master)
    {
      static const std::array<std::vector<ReferenceMap>, 2> all = {
        {symmetries(FaceShape::triangle),
         symmetries(FaceShape::quadrilateral)}};
      if (slave.shape != master.shape || slave.degree != master.degree ||
          (slave.frame.center - master.frame.center).norm() > 1e-6 * slave.size)
        return {};
      for (const ReferenceMap &map :
           all[slave.shape == FaceShape::triangle ? 0 : 1])
        if (slave.orientation * master.orientation * map.determinant() < 0. &&
            maps_to_same_points(slave, master, map))
          return map;
      return {};
    }

    /// (max - min) / (max + min) of the surface element.
    double
    distortion(const Scratch &scratch)
    {
      if (scratch.slave_linear)
        return 0.;
      const ReferenceRule &rule = gauss_rule(8).on(scratch.slave.shape());
      double               high = 0., low = std::numeric_limits<double>::max();
      for (unsigned int q = 0; q < rule.weight.size(); q += n_lanes)
        {
          Lanes       xi[2];
          Vec3<Lanes> x, dx[2];
          for (unsigned int l = 0; l < n_lanes; ++l)
            {
              xi[0][l] = rule.xi_1[q + l];
              xi[1][l] = rule.xi_2[q + l];
            }
          scratch.slave.evaluate(xi, x, dx);
          const Vec3<Lanes> area = cross(dx[0], dx[1]);
          const Lanes       size = square_root(dot(area, area));
          high                   = std::max(high, largest(size));
          low                    = std::min(low, -largest(-size));
        }
      return (high - low) / (high + low);
    }
  } // namespace

  std::optional<PairResult>
  integrate_coinciding_pair(Scratch           &scratch,
                            const SurfaceFace &slave,
                            const SurfaceFace &master,
                            IntegrationPoints &points)
  {
    const auto map = find_map(slave, master);
    if (!map)
      return {};
    const ReferenceRule &rule =
      scratch.rule(distortion(scratch)).on(slave.shape);
    const unsigned int n      = rule.weight.size();
    const Point<3>    &origin = scratch.slave.origin();
    PairResult         result{PairStatus::accepted, 0., 1, 0.};
    points.resize(n);
    for (unsigned int begin = 0; begin < n; begin += n_lanes)
      {
        const unsigned int count = std::min(n_lanes, n - begin);
        Lanes              xi[2];
        Vec3<Lanes>        x, dx[2];
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            const unsigned int q = begin + std::min(l, count - 1);
            xi[0][l]             = rule.xi_1[q];
            xi[1][l]             = rule.xi_2[q];
          }
        scratch.slave.evaluate(xi, x, dx);
        const Vec3<Lanes> area = cross(dx[0], dx[1]);
        const Lanes       size = square_root(dot(area, area));
        for (unsigned int l = 0; l < count; ++l)
          {
            const unsigned int q = begin + l;
            points.weight[q]     = rule.weight[q] * size[l];
            points.gap[q]        = 0.;
            result.area += points.weight[q];
            for (unsigned int i = 0; i < 2; ++i)
              {
                points.slave_xi[i][q] = xi[i][l];
                points.master_eta[i][q] =
                  map->coordinate(i, xi[0][l], xi[1][l]);
              }
            for (unsigned int d = 0; d < 3; ++d)
              points.slave_x[d][q] = points.master_x[d][q] =
                origin[d] + x[d][l];
          }
      }
    return result;
  }
} // namespace mortise
