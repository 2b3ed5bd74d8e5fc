// Proves what is known of the nodes of contact: their areas add up to what is
// covered, their forces and moments to those of a constant traction, gaps are
// those between the meshes; normals stand across the surface, in the components
// that a node has, and are zero where the normal one is prescribed. With
// friction, areas, gaps and complementarity parameters are those without.
// Hexahedra and tetrahedra, several degrees, surfaces turned in space, partly
// covered, sides held. The same on any number of ranks.
#include <deal.II/physics/transformations.h>

#include <mortise/mortar/contact_nodes.h>
#include <verdict.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tied_scene.h"

namespace mortise::testing
{
  using namespace dealii;
  using Vec = Tensor<1, dim>;

  constexpr double gap = 0.01;

  struct Case
  {
    std::string       name;
    unsigned int      degree;
    bool              tetrahedra = false;
    std::vector<Held> held       = {};
    double            covered    = 1.; ///< length of the master, 1 wide
    bool              turned     = false;
    MultiplierBasis   basis      = MultiplierBasis::standard;
  };

  MeshParameters
  mesh(const std::vector<double>       &extent,
       const std::vector<unsigned int> &subdivisions,
       const bool                       tetrahedra,
       const bool                       turned)
  {
    MeshParameters result = box_mesh(extent, subdivisions, tetrahedra);
    if (turned)
      result.rotate = {20., 35., 50.};
    return result;
  }

  /// As Rotate turns meshes.
  Vec
  turn(const Case &given, const Vec &v)
  {
    if (!given.turned)
      return v;
    Vec          result   = v;
    const double angles[] = {20., 35., 50.};
    for (unsigned int a = 0; a < dim; ++a)
      {
        Vec axis;
        axis[a] = 1.;
        result  = Physics::Transformations::Rotations::rotation_matrix_3d(
                   Point<3>(axis), angles[a] * numbers::PI / 180.) *
                 result;
      }
    return result;
  }

  TiedScene
  scene(const Case &given, const bool friction)
  {
    return {{mesh({0., 0., 0., 1., 1., 1.},
                  {3, 2, 1},
                  given.tetrahedra,
                  given.turned),
             "zmax",
             given.degree,
             given.held,
             {}},
            {mesh({0., 0., 1. + gap, given.covered, 1., 2.},
                  {2, 4, 1},
                  false,
                  given.turned),
             "zmin",
             given.degree,
             {},
             {}},
            MPI_COMM_WORLD,
            false,
            given.basis,
            true,
            friction};
  }

  /// By place, since their order depends on the multipliers of each.
  std::vector<ContactNode>
  nodes_of(const TiedScene &scene)
  {
    auto nodes =
      contact_nodes(scene.coupling(), scene.owned_multiplier, scene.comm);
    const auto key = [](const ContactNode &node) {
      std::array<long, dim> result;
      for (unsigned int c = 0; c < dim; ++c)
        result[c] = std::lround(1e8 * node.position[c]);
      return result;
    };
    std::sort(nodes.begin(), nodes.end(), [&](const auto &a, const auto &b) {
      return key(a) < key(b);
    });
    return nodes;
  }

  template <typename Value>
  auto
  sum(const std::vector<ContactNode> &nodes, const Value &value)
  {
    decltype(value(nodes[0])) result{};
    for (const ContactNode &node : nodes)
      result += value(node);
    return Utilities::MPI::sum(result, MPI_COMM_WORLD);
  }

  template <typename Value>
  double
  largest(const std::vector<ContactNode> &nodes, const Value &value)
  {
    double result = 0.;
    for (const ContactNode &node : nodes)
      result = std::max(result, value(node));
    return Utilities::MPI::max(result, MPI_COMM_WORLD);
  }

  /// The direction of multiplier @p r.
  Vec
  direction(const ContactNode &node, const unsigned int r)
  {
    return node.forces[r] / node.forces[r].norm();
  }

  /// Its normal in space.
  Vec
  normal(const ContactNode &node)
  {
    Vec result;
    for (unsigned int r = 0; r < node.n_multipliers; ++r)
      result += node.normal[r] * direction(node, r);
    return result;
  }

  void
  check(const Case &given)
  {
    const TiedScene with = scene(given, true), without = scene(given, false);
    const auto      nodes = nodes_of(with), plain = nodes_of(without);
    const auto     &name = given.name;
    const Vec       up   = turn(given, Vec({0., 0., 1.})),
              centre     = turn(given, Vec({0.5 * given.covered, 0.5, 1.}));
    const double area    = given.covered;

    for (const auto *of : {&nodes, &plain})
      {
        const std::string what =
          name + (of == &nodes ? ", friction" : ", no friction");
        verdict(what + ": areas 1e-12",
                std::fabs(sum(*of, [](const auto &node) { return node.area; }) -
                          area),
                1e-12);
        verdict(what + ": centre 1e-12",
                (sum(*of,
                     [](const auto &node) {
                       return node.area * Vec(node.position);
                     }) /
                   area -
                 centre)
                  .norm(),
                1e-12);
        verdict(what + ": gaps 1e-12",
                largest(*of,
                        [&](const auto &node) {
                          return std::fabs(node.gap() - gap);
                        }),
                1e-12);
        verdict(what + ": normals 1e-12",
                largest(*of,
                        [&](const auto &node) {
                          return (normal(node) - up).norm();
                        }),
                1e-12);
        // of the pressure 1
        Vec force, moment;
        for (const ContactNode &node : *of)
          for (unsigned int r = 0; r < node.n_multipliers; ++r)
            {
              force += node.normal[r] * node.forces[r];
              moment += node.normal[r] * node.moments[r];
            }
        verdict(what + ": force 1e-12",
                (Utilities::MPI::sum(force, MPI_COMM_WORLD) - area * up).norm(),
                1e-12);
        verdict(what + ": moment 1e-12",
                (Utilities::MPI::sum(moment, MPI_COMM_WORLD) -
                 area * cross_product_3d(centre, up))
                  .norm(),
                1e-12);
      }
    // a constant traction along each axis
    double errors[2] = {0., 0.};
    for (unsigned int c = 0; c < dim; ++c)
      {
        Vec axis, force, moment;
        axis[c] = 1.;
        for (const ContactNode &node : nodes)
          for (unsigned int r = 0; r < node.n_multipliers; ++r)
            if (direction(node, r) * axis > 0.5)
              {
                force += node.forces[r];
                moment += node.moments[r];
              }
        errors[0] = std::max(
          errors[0],
          (Utilities::MPI::sum(force, MPI_COMM_WORLD) - area * axis).norm());
        errors[1] = std::max(errors[1],
                             (Utilities::MPI::sum(moment, MPI_COMM_WORLD) -
                              area * cross_product_3d(centre, axis))
                               .norm());
      }
    verdict(name + ": forces along the axes 1e-12", errors[0], 1e-12);
    verdict(name + ": moments along the axes 1e-12", errors[1], 1e-12);

    double worst = nodes.size() == plain.size() ? 0. : 1.;
    for (unsigned int i = 0; i < nodes.size() && worst < 1.; ++i)
      worst = std::max(
        {worst,
         nodes[i].position.distance(plain[i].position),
         std::fabs(nodes[i].area - plain[i].area),
         std::fabs(nodes[i].gap() - plain[i].gap()),
         std::fabs(nodes[i].complementarity / plain[i].complementarity - 1.)});
    verdict(name + ": places, areas, gaps as without friction 1e-12",
            Utilities::MPI::max(worst, MPI_COMM_WORLD),
            1e-12);
  }

  /// As many nodes as a held side has have two multipliers, since traces of the
  /// held component are of less degree beside it.
  void
  check_symmetry(const std::string &name, const unsigned int degree)
  {
    const auto count = [](const auto &nodes, const auto &is) {
      std::uint64_t n = 0;
      for (const ContactNode &node : nodes)
        n += is(node) ? 1 : 0;
      return double(Utilities::MPI::sum(n, MPI_COMM_WORLD));
    };
    const auto has_two = [](const ContactNode &node) {
      return node.n_multipliers == 2;
    };
    const unsigned int at_edge = 2 * degree + 1;
    for (const unsigned int held : {0, 1, 2})
      {
        Case given{name + ", held along " + std::string(1, 'x' + held), degree};
        std::array<bool, dim> components{};
        components[held] = true;
        given.held       = {{"xmin", components}};
        const auto nodes = nodes_of(scene(given, true));
        verdict(given.name +
                  ": as many have two multipliers as are at the side",
                std::fabs(count(nodes, has_two) - at_edge),
                0.);
        verdict(given.name + ": all others have three",
                std::fabs(count(nodes,
                                [](const auto &node) {
                                  return node.n_multipliers == dim;
                                }) +
                          at_edge - (3 * degree + 1) * (2 * degree + 1)),
                0.);
        // of two, e_y and e_z or e_x and e_z, the last one is the normal
        verdict(given.name + ": normals 1e-12",
                largest(nodes,
                        [&](const auto &node) {
                          const Vec expected =
                            has_two(node) && held == 2 ? Vec() :
                            has_two(node)              ? Vec({0., 1., 0.}) :
                                                         Vec({0., 0., 1.});
                          return (node.normal - expected).norm();
                        }),
                1e-12);
        verdict(given.name + ": none has the prescribed component",
                largest(nodes,
                        [&](const auto &node) {
                          double force = 0.;
                          for (unsigned int r = 0; r < node.n_multipliers; ++r)
                            if (has_two(node))
                              force = std::max(force,
                                               std::fabs(node.forces[r][held]));
                          return force;
                        }),
                1e-15);
        verdict(given.name + ": areas 1e-12",
                std::fabs(sum(nodes,
                              [](const auto &node) {
                                return node.normal.norm() * node.area;
                              }) -
                          1.),
                1e-12);
      }
  }

  void
  check_all()
  {
    for (const unsigned int p : {1, 2, 3})
      {
        const std::string of = ", p = " + std::to_string(p);
        check({"quadrilaterals" + of, p});
        check({"triangles" + of, p, true});
        check({"turned" + of, p, p == 2, {}, 1., true});
        check({"covered in part" + of, p, false, {}, 0.8});
        check({"dual" + of, p, false, {}, 1., false, MultiplierBasis::dual});
        for (const unsigned int held : {0, 1})
          {
            std::array<bool, dim> components{};
            components[held] = true;
            check({"held along " + std::string(1, 'x' + held) + of,
                   p,
                   p == 2,
                   {{"xmin", components}}});
          }
        check_symmetry("symmetry" + of, p);
      }
  }
} // namespace mortise::testing

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mortise::testing::check_all();
}
