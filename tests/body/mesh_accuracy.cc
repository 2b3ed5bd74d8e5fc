// Curved meshes are as accurate as the mapping: with MappingQ of degree p
// = 1..8 the distance of the mapped surface from the true one, the area and the
// volume converge with order p+1 or more, under uniform refinement, and locally
// refined meshes stay as accurate; far away and at any scale. Nodes on edges of
// spheres are at equal angles.

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

#include <mortise/body/mesh/manifolds.h>
#include <mortise/body/mesh/mesh_source.h>
#include <verdict.h>

#include <cmath>
#include <functional>
#include <iostream>

using namespace mortise;
using namespace dealii;

namespace
{
  /// Distance (or height) of a point in body coordinates from the true surface.
  using Distance = std::function<double(const Point<3> &x)>;

  struct Errors
  {
    double distance = 0., area = 0., volume = 0.;
  };

  struct Body
  {
    std::string    name;
    MeshParameters parameters;
    std::string curved; ///< the boundary whose distance and area are measured
    Distance    distance;
    double      area, volume;
  };

  Errors
  errors(const Triangulation<3> &tria,
         const MeshNames        &names,
         const Body             &body,
         const unsigned int      p,
         const unsigned int      least_level = 0)
  {
    const MappingQ<3>   mapping(p);
    const FE_Nothing<3> fe;
    const QGauss<3>     cell_rule(p + 3);
    const QGauss<2>     face_rule(p + 3);
    FEValues<3>         values(mapping, fe, cell_rule, update_JxW_values);
    FEFaceValues<3>     faces(mapping,
                          fe,
                          face_rule,
                          update_JxW_values | update_quadrature_points);
    const RigidMotion   motion = rigid_motion(body.parameters);
    const auto          id     = names.boundaries.at(body.curved);
    Errors              e;
    double              area = 0., volume = 0.;
    for (const auto &cell : tria.active_cell_iterators())
      {
        values.reinit(cell);
        for (unsigned int q = 0; q < cell_rule.size(); ++q)
          volume += values.JxW(q);
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == id &&
              static_cast<unsigned int>(cell->level()) >= least_level)
            {
              faces.reinit(cell, face);
              for (unsigned int q = 0; q < face_rule.size(); ++q)
                {
                  area += faces.JxW(q);
                  e.distance = std::max(e.distance,
                                        std::fabs(body.distance(motion.inverse(
                                          faces.quadrature_point(q)))));
                }
            }
      }
    e.area   = std::fabs(area / body.area - 1.);
    e.volume = std::fabs(volume / body.volume - 1.);
    return e;
  }

  void
  place(MeshParameters &q, const double scale, const double away)
  {
    for (double &length : q.extent)
      length *= scale;
    q.amplitude *= scale;
    q.rotate    = {{25., -40., 65.}};
    q.translate = {{away * scale, -0.5 * away * scale, 0.3 * away * scale}};
  }

  std::vector<Body>
  bodies(const double scale, const double away)
  {
    const double pi = numbers::PI, area = scale * scale, volume = area * scale;
    std::vector<Body> result(4);

    MeshParameters q;
    q.source       = "shell octant";
    q.extent       = {1., 1.5};
    q.subdivisions = {1, 1};
    place(q, scale, away);
    result[0] = {"shell octant",
                 q,
                 "outside",
                 [scale](const Point<3> &x) { return x.norm() / scale - 1.5; },
                 pi / 2. * 2.25 * area,
                 pi / 6. * 2.375 * volume};

    q.source       = "cylinder sector";
    q.extent       = {1., 1.5, 1.};
    q.subdivisions = {1, 1, 1};
    place(q, scale, away);
    result[1] = {"cylinder sector",
                 q,
                 "inside",
                 [scale](const Point<3> &x) {
                   return std::hypot(x[0], x[1]) / scale - 1.;
                 },
                 pi / 2. * area,
                 pi / 4. * 1.25 * volume};

    for (const unsigned int half : {0, 1})
      {
        q              = MeshParameters();
        q.source       = "curved block";
        q.extent       = {0., 0., 0., 2., 2., 2.};
        q.subdivisions = {1, 1, 1};
        q.half         = half == 0 ? "lower" : "upper";
        q.surface      = half == 0 ? "wave" : "bump";
        q.amplitude    = 0.3;
        place(q, scale, away);
        const CurvedBlockManifold::Shape shape{
          0.,
          0.,
          0.,
          2.,
          2.,
          2.,
          1.,
          0.3,
          half == 0 ? CurvedBlockManifold::Surface::wave :
                      CurvedBlockManifold::Surface::bump};
        const QGauss<2> rule(30);
        double          under = 0., surface = 0.;
        for (unsigned int i = 0; i < rule.size(); ++i)
          {
            const auto h =
              shape.height(2. * rule.point(i)[0], 2. * rule.point(i)[1]);
            under += 4. * rule.weight(i) * (1. + h.value);
            surface +=
              4. * rule.weight(i) * std::sqrt(1. + h.dx * h.dx + h.dy * h.dy);
          }
        result[2 + half] = {
          half == 0 ? "wave, lower" : "bump, upper",
          q,
          "interface",
          [scale, shape](const Point<3> &x) {
            return x[2] / scale - 1. -
                   shape.height(x[0] / scale, x[1] / scale).value;
          },
          surface * area,
          (half == 0 ? under : 8. - under) * volume};
      }
    return result;
  }

  /// Order between the two finest meshes that stand clear of rounding.
  double
  order(const std::vector<double> &errors, const double floor)
  {
    for (unsigned int level = errors.size() - 1; level > 0; --level)
      if (errors[level] > floor)
        return std::log2(errors[level - 1] / errors[level]);
    return std::numeric_limits<double>::infinity();
  }

  void
  check_orders(const Body &body, const double away)
  {
    const unsigned int step =
      away > 0. ? 7 : 1; // far away degrees 1 and 8 are enough
    std::vector<double> distance[max_degree + 1], area[max_degree + 1],
      volume[max_degree + 1];
    for (unsigned int refinements = 1; refinements < 4; ++refinements)
      {
        MeshParameters q  = body.parameters;
        q.refinements     = refinements;
        const Mesh  mesh  = create_mesh(q, MPI_COMM_WORLD);
        const auto &tria  = *mesh.triangulation;
        const auto &names = mesh.names;
        for (unsigned int p = 1; p <= max_degree; p += step)
          {
            const Errors e = errors(tria, names, body, p);
            distance[p].push_back(e.distance);
            area[p].push_back(e.area);
            volume[p].push_back(e.volume);
          }
      }
    // Rounding of coordinates for the distance, of sums over points for the
    // others.
    const double floor_distance = 1e-13 + 4e-14 * away,
                 floor_sum      = 2e-12 + 4e-14 * away;
    double least[3]             = {1e3, 1e3, 1e3};
    for (unsigned int p = 1; p <= max_degree; p += step)
      {
        least[0] =
          std::min(least[0], order(distance[p], floor_distance) - (p + 1.));
        least[1] = std::min(least[1], order(area[p], floor_sum) - (p + 1.));
        least[2] = std::min(least[2], order(volume[p], floor_sum) - (p + 1.));
      }
    const std::string name = body.name + (away > 100. ? ", far away: " : ": ");
    verdict(least[0] > -0.25,
            name + "distance from the surface, order at least p + 0.75",
            least[0]);
    verdict(least[1] > -0.2, name + "area, order at least p + 0.8", least[1]);
    verdict(least[2] > -0.2, name + "volume, order at least p + 0.8", least[2]);
    verdict(distance[max_degree].back() < floor_distance &&
              area[max_degree].back() < floor_sum &&
              volume[max_degree].back() < floor_sum,
            name + "degree 8 on 8 x 8 faces is exact to rounding",
            distance[max_degree].back());
  }

  /// Cells made by local refinement lie on the surface as well as those of
  /// uniform refinement.
  void
  check_local(const Body &body)
  {
    const unsigned int p       = 4;
    MeshParameters     uniform = body.parameters, local = body.parameters;
    uniform.refinements = 3;
    const Mesh   mesh   = create_mesh(uniform, MPI_COMM_WORLD);
    const auto  &tria   = *mesh.triangulation;
    const auto  &names  = mesh.names;
    const double fine   = errors(tria, names, body, p).distance;

    // A vertex of the curved boundary after one refinement, where the body
    // stands.
    Point<3> corner;
    for (const auto &cell : tria.cell_iterators_on_level(1))
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary() &&
            face->boundary_id() == names.boundaries.at(body.curved))
          corner = face->vertex(0);
    std::ostringstream text;
    text.precision(17);
    text << corner[0] << ", " << corner[1] << ", " << corner[2] << ", 0.1, 2";
    local.refinements      = 1;
    local.refine_near      = text.str();
    const Mesh  local_mesh = create_mesh(local, MPI_COMM_WORLD);
    const auto &refined    = *local_mesh.triangulation;
    verdict(
      refined.n_global_levels() == 4 && refined.has_hanging_nodes() &&
        errors(refined, names, body, p, 3).distance < 1.000001 * fine,
      body.name +
        ": locally refined cells as near the surface as uniformly refined ones",
      errors(refined, names, body, p, 3).distance / fine);
  }

  /// Distance from the unit circle of the polynomial of degree @p p through
  /// points of an arc of @p angle, which divide it as Gauss-Lobatto points do.
  double
  distance_from_arc(const unsigned int p, const double angle)
  {
    const QGaussLobatto<1> nodes(p + 1);
    double                 result = 0.;
    for (double t = 0.; t <= 1.; t += 1. / 256.)
      {
        Tensor<1, 2> x;
        for (unsigned int i = 0; i <= p; ++i)
          {
            double value = 1.;
            for (unsigned int j = 0; j <= p; ++j)
              if (j != i)
                value *= (t - nodes.point(j)[0]) /
                         (nodes.point(i)[0] - nodes.point(j)[0]);
            x[0] += value * std::cos(angle * nodes.point(i)[0]);
            x[1] += value * std::sin(angle * nodes.point(i)[0]);
          }
        result = std::max(result, std::fabs(x.norm() - 1.));
      }
    return result;
  }

  void
  check_arcs(const Body &sphere)
  {
    MeshParameters q    = sphere.parameters;
    q.subdivisions      = {2, 1};
    const Mesh   mesh   = create_mesh(q, MPI_COMM_WORLD);
    const double radius = q.extent[1];
    double       angle  = 0.; // the largest of an edge
    for (const auto &cell : mesh.triangulation->active_cell_iterators())
      for (const unsigned int i : cell->line_indices())
        {
          const RigidMotion motion = rigid_motion(q);
          const Point<3>    a      = motion.inverse(cell->line(i)->vertex(0)),
                         b         = motion.inverse(cell->line(i)->vertex(1));
          if (std::fabs(a.norm() - b.norm()) < 1e-6)
            angle =
              std::max(angle, 2. * std::asin(0.5 * (b - a).norm() / a.norm()));
        }
    // the errors of two directions add up, and inside of faces lines are no
    // arcs
    for (const auto &[p, allowed] : {std::pair(3, 2.5), std::pair(5, 10.)})
      verdict(sphere.name + ", degree " + std::to_string(p) +
                ": distance beside that of arcs of equal angles",
              errors(*mesh.triangulation, mesh.names, sphere, p).distance /
                (radius * distance_from_arc(p, angle)),
              allowed);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const Body &body : bodies(1., 0.))
    {
      check_orders(body, 0.);
      check_local(body);
    }
  check_arcs(bodies(1., 0.)[0]);
  for (const Body &body : bodies(1e6, 3e3))
    check_orders(body, 3e3);
}
