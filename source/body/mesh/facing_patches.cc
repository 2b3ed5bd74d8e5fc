#include <mortise/body/mesh/facing_patches.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    struct Facet
    {
      std::vector<Point<3>> x;
      Tensor<1, 3>          normal; ///< outer, as long as the area
      Point<3>              middle;
    };

    Facet
    facet_of(const MeshSurface &body, const std::size_t f)
    {
      const std::vector<unsigned int> &outer = body.outer[f];
      Facet                            facet;
      for (const unsigned int v : outer)
        facet.x.push_back(body.mesh.vertices[v]);
      facet.normal = area_vector(body.mesh.vertices, outer);
      facet.middle = middle(body.mesh.vertices, outer);
      return facet;
    }

    /// How far @p direction (a unit vector) leads from @p x to the triangle; no
    /// value if it passes it. Source: Moeller and Trumbore (1997).
    std::optional<double>
    way_to(const Point<3>     &a,
           const Point<3>     &b,
           const Point<3>     &c,
           const Point<3>     &x,
           const Tensor<1, 3> &direction)
    {
      constexpr double   rounding = 1e-9;
      const Tensor<1, 3> across   = cross_product_3d(direction, c - a);
      const double       volume   = (b - a) * across;
      if (volume == 0.)
        return {};
      const double       u = (x - a) * across / volume;
      const Tensor<1, 3> q = cross_product_3d(x - a, b - a);
      const double       v = direction * q / volume;
      if (u < -rounding || v < -rounding || u + v > 1. + rounding)
        return {};
      return (c - a) * q / volume;
    }

    /// The shortest way along the normal of @p facet to one of @p others that
    /// looks back at it.
    std::optional<double>
    way_to_nearest(const Facet              &facet,
                   const std::vector<Facet> &others,
                   const double              reach)
    {
      const Tensor<1, 3>    n = facet.normal / facet.normal.norm();
      std::optional<double> nearest;
      for (const Facet &other : others)
        {
          if (other.normal * n > -std::sqrt(0.5) * other.normal.norm())
            continue;
          for (std::size_t t = 2; t < other.x.size(); ++t)
            {
              const auto way =
                way_to(other.x[0], other.x[t - 1], other.x[t], facet.middle, n);
              if (way && std::fabs(*way) <= reach &&
                  (!nearest || std::fabs(*way) < std::fabs(*nearest)))
                nearest = way;
            }
        }
      return nearest;
    }

    bool
    boxes_meet(const SurfacePatch &a, const SurfacePatch &b, const double reach)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (a.low[d] > b.high[d] + reach || b.low[d] > a.high[d] + reach)
          return false;
      return true;
    }

    std::vector<Facet>
    facets_of(const MeshSurface &body, const SurfacePatch &patch)
    {
      std::vector<Facet> facets;
      for (const std::size_t f : patch.faces)
        facets.push_back(facet_of(body, f));
      return facets;
    }

    /// Adds to @p pair what the slave's @p facet sees.
    void
    add_facet(const Facet              &facet,
              const std::vector<Facet> &masters,
              const SurfacePatch       &master,
              const double              reach,
              FacingPatches            &pair)
    {
      const double area = facet.normal.norm();
      const auto   way =
        area > 0. ? way_to_nearest(facet, masters, reach) : std::nullopt;
      if (!way)
        return;
      std::vector<double> distances;
      if (master.shape == nullptr)
        distances = {std::fabs(*way)};
      else
        for (const Point<3> &x : facet.x)
          distances.push_back(std::fabs(master.shape->distance(x).value));
      pair.area += area;
      for (const double distance : distances)
        {
          pair.least_distance   = std::min(pair.least_distance, distance);
          pair.largest_distance = std::max(pair.largest_distance, distance);
          pair.mean_distance += area * distance / distances.size();
        }
    }
  } // namespace

  std::vector<FacingPatches>
  facing_patches(const std::vector<MeshSurface> &bodies, const double reach)
  {
    std::vector<FacingPatches> pairs;
    for (std::size_t a = 0; a < bodies.size(); ++a)
      for (std::size_t b = a + 1; b < bodies.size(); ++b)
        for (std::size_t i = 0; i < bodies[a].patches.size(); ++i)
          for (std::size_t j = 0; j < bodies[b].patches.size(); ++j)
            {
              const SurfacePatch &of_a = bodies[a].patches[i],
                                 &of_b = bodies[b].patches[j];
              if (!boxes_meet(of_a, of_b, reach))
                continue;
              FacingPatches pair;
              const bool    first        = of_a.area <= of_b.area;
              pair.slave_body            = first ? a : b;
              pair.master_body           = first ? b : a;
              pair.slave                 = first ? i : j;
              pair.master                = first ? j : i;
              pair.least_distance        = std::numeric_limits<double>::max();
              const SurfacePatch &slave  = first ? of_a : of_b,
                                 &master = first ? of_b : of_a;
              const auto masters = facets_of(bodies[pair.master_body], master);
              for (const Facet &facet :
                   facets_of(bodies[pair.slave_body], slave))
                add_facet(facet, masters, master, reach, pair);
              if (pair.area < 0.01 * slave.area || pair.area == 0.)
                continue;
              pair.mean_distance /= pair.area;
              pairs.push_back(pair);
            }
    return pairs;
  }
} // namespace mortise
