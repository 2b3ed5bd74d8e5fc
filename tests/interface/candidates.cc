// Proves that the search leaves out no partner: random wavy surfaces at any
// distance, of any ratio of faces, where all other pairs have no overlap; and
// faces whose mean normals oppose each other at one vertex alone.
#include <random>

#include "synthetic_surface.h"

using namespace synthetic;

namespace
{
  /// The slave below the master, over the unit square and its surroundings.
  struct Scene
  {
    Surface        slave, master;
    Grid           slave_grid, master_grid;
    SearchDistance distance;
  };

  Scene
  draw(const unsigned int seed)
  {
    std::mt19937 engine(seed);
    const auto   in = [&](const double a, const double b) {
      return a + (b - a) * (engine() / 4294967296.);
    };
    const auto any = [&](const double a, const double b) {
      return std::exp(in(std::log(a), std::log(b)));
    };
    const auto paraboloid = [](const double a, const double b) {
      return [=](const double u, const double v) {
        return a * std::pow(u - 0.5, 2) + b * std::pow(v - 0.5, 2);
      };
    };
    const double gap = any(1e-3, 0.5), a_1 = in(-0.8, 0.8), b_1 = in(-0.8, 0.8),
                 a_2 = in(-0.5, 0.5), b_2 = in(-0.5, 0.5), tilt = in(-0.6, 0.6),
                 wave = in(0., 0.2), number = in(1., 9.);
    const auto bump = paraboloid(a_1, b_1), bowl = paraboloid(a_2, b_2);

    Scene scene;
    scene.master = [=](const double u, const double v) {
      return Point<3>(u, v, bowl(u, v) + tilt * u);
    };
    scene.slave = [=](const double u, const double v) {
      return Point<3>(u,
                      v,
                      bowl(u, v) + tilt * u - gap - bump(u, v) -
                        wave * std::sin(number * u) * std::cos(number * v));
    };
    const auto up_to = [&](const unsigned int most) {
      return 1 + static_cast<unsigned int>(engine() % most);
    };
    scene.slave_grid  = {up_to(12), up_to(12), up_to(3)};
    scene.master_grid = {
      up_to(40), up_to(40), up_to(3), -0.7, 1.7, -0.7, 1.7, -1., true};
    const Pairing shapes    = pairings()[engine() % 4];
    scene.slave_grid.shape  = shapes.slave,
    scene.master_grid.shape = shapes.master;
    for (Grid *grid : {&scene.slave_grid, &scene.master_grid})
      grid->distortion = in(0., 0.25);
    if (engine() % 2 == 0)
      scene.distance.length = any(1e-3, 1.);
    else
      scene.distance.by_size = in(0.1, 2.);
    return scene;
  }

  /// Of the face itself, not of the mean normals of its vertices.
  Tensor<1, 3>
  normal_in_the_middle(const SurfaceFace &face)
  {
    return face_normal(face,
                       Point<2>(face.frame.center_xi, face.frame.center_xi));
  }

  /// A clipped loop far outside of the master is no overlap.
  bool
  lie_on_master(const IntegrationPoints &points)
  {
    for (const auto &eta : points.master_eta)
      for (const double coordinate : eta)
        if (std::fabs(coordinate - 0.5) > 0.51)
          return false;
    return true;
  }

  /// Largest part of a slave face that pairs beside the candidates cover.
  double
  left_out(const unsigned int seed)
  {
    const Scene scene  = draw(seed);
    const auto  slaves = faces(scene.slave, scene.slave_grid),
               masters = faces(scene.master, scene.master_grid);
    const FaceTree            tree(masters, scene.distance);
    PairIntegrator            integrator(scene.distance);
    IntegrationPoints         points;
    std::vector<unsigned int> candidates;
    double                    worst = 0.;
    for (const SurfaceFace &slave : slaves)
      {
        integrator.reinit(slave);
        tree.candidates(slave, candidates);
        double area = 0.;
        for (unsigned int m = 0; m < masters.size(); ++m)
          if (!std::binary_search(candidates.begin(), candidates.end(), m) &&
              normal_in_the_middle(slave) * normal_in_the_middle(masters[m]) <
                -0.1)
            {
              const PairResult pair =
                integrator.integrate(masters[m], 2, 2, points);
              if (pair.status == PairStatus::accepted && lie_on_master(points))
                area += pair.area;
            }
        worst = std::max(worst, area / integrator.slave_area());
      }
    return worst;
  }

  /// Partners of a face below another, of @p shapes, whose normals oppose each
  /// other at the vertices @p v and @p w alone: beside a sharp edge the mean
  /// normals belong to what lies around it.
  unsigned int
  n_partners(const Pairing &shapes, const unsigned int v, const unsigned int w)
  {
    Grid below, above;
    below.shape       = shapes.slave;
    above.shape       = shapes.master;
    above.orientation = -1.;
    const auto plane  = [](const double z) {
      return [=](const double x, const double y) { return Point<3>(x, y, z); };
    };
    SurfaceFace slave  = faces(plane(0.), below)[0],
                master = faces(plane(0.1), above)[0];
    const auto turn    = [](SurfaceFace &face, const unsigned int all_but) {
      for (unsigned int k = 0; k < n_vertices(face.shape); ++k)
        if (k != all_but)
          face.vertex_normals[k] = Tensor<1, 3>(
            {std::sqrt(0.99), 0., -0.1 * face.vertex_normals[k][2]});
      face.finalize();
    };
    turn(slave, v);
    turn(master, w);
    std::vector<unsigned int> candidates;
    FaceTree({master}, {}).candidates(slave, candidates);
    return candidates.size();
  }
} // namespace

int
main()
{
  double worst = 0.;
  for (unsigned int seed = 0; seed < 40; ++seed)
    worst = std::max(worst, left_out(seed));
  verdict(
    "forty random pairs of surfaces: area of partners that are no candidates",
    worst,
    1e-9);
  for (const Pairing &shapes : pairings())
    {
      unsigned int missing = 0;
      for (unsigned int v = 0; v < n_vertices(shapes.slave); ++v)
        for (unsigned int w = 0; w < n_vertices(shapes.master); ++w)
          missing += 1 - n_partners(shapes, v, w);
      verdict("opposite at a vertex, " + shapes.name +
                ": pairs without partner",
              missing,
              0.);
    }
  return 0;
}
