// Proves which displacements lead where a slave is finer than its master, and
// what their followers add to the diagonal of K, on nested meshes of degrees 2
// to 4, where the projection face by face is interpolation: the sum of K_ii
// N_j(x_i)^2 over the slave's nodes. None leads beside a slave that cannot
// follow, none with a slave that is coarser. The same on every number of ranks.
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>

#include <cmath>

#include "nodal_scene.h"

namespace mortise::testing
{
  using namespace dealii;

  MeshParameters
  box(const double lower, const unsigned int n)
  {
    MeshParameters result;
    result.source       = "box";
    result.extent       = {0., 0., lower, 1., 1., lower + 1.};
    result.subdivisions = {n, n, 1};
    return result;
  }

  /// The unit squares of two boxes, the slave's of @p n x n cells, the master's
  /// of one; one component of an edge of the master is held, with @p hold_slave
  /// that of all the slave, too.
  struct NestedSquares
  {
    NestedSquares(const unsigned int p,
                  const unsigned int n,
                  const bool         hold_slave,
                  const bool         swap)
      : scene(
          {box(0., n), box(1., 1)},
          [p](Body &body) { body.create_space(p, {}, ""); },
          [&](const Body &body, AffineConstraints<double> &constraints) {
            ComponentMask mask(dim, false);
            mask.set(1, true);
            if (body.index == 1 || hold_slave)
              DoFTools::make_zero_boundary_constraints(
                body.dof_handler,
                body.boundary_id(body.index == 1 ? "xmin" : "zmax", ""),
                constraints,
                mask);
          })
    {
      std::vector<const Body *> pointers;
      for (const auto &body : scene.bodies)
        pointers.push_back(body.get());
      NodalSpaces spaces = make_nodal_spaces(pointers, MPI_COMM_WORLD);
      const auto  side   = [&](const unsigned int b) {
        return extract_surface(*pointers[b],
                               boundary_faces(*pointers[b],
                                              pointers[b]->boundary_id(
                                                b == 0 ? "zmax" : "zmin", "")),
                               scene.fields.displacement.numbering,
                               scene.fields.displacement.constraints,
                               spaces);
      };
      couplings.emplace_back();
      couplings[0].interface =
        std::make_unique<InterfaceHandler>("glue",
                                           side(swap ? 1 : 0),
                                           side(swap ? 0 : 1),
                                           InterfaceOptions(),
                                           MPI_COMM_WORLD);
      couplings[0].local = integrate_coupling(*couplings[0].interface,
                                              true,
                                              MultiplierBasis::standard);
      level              = make_multigrid_level(spaces[0],
                                   scene.fields.displacement.numbering,
                                   scene.fields.displacement.constraints,
                                   MPI_COMM_WORLD);
      const LevelOperator<double> stiffness(level, false);
      stiffness.initialize(diagonal);
      stiffness.diagonal(diagonal);
      stiffness.average_components(diagonal);
      leading = find_independent_displacements(level, diagonal, couplings);
    }

    /// visit(place of the first component, x, y) for the owned nodes at z = 1
    /// of one body, each once.
    template <typename Visit>
    void
    for_each_node(const unsigned int b, const Visit &visit) const
    {
      std::set<unsigned int> seen;
      level.space->for_each_cell(
        [&](const Body &body, const auto &cell, const auto &nodes) {
          const FE_Q<dim> fe(body.max_degree());
          for (unsigned int k = 0; k < nodes.size(); ++k)
            {
              Point<dim> x;
              for (unsigned int v = 0; v < 8; ++v)
                x += GeometryInfo<dim>::d_linear_shape_function(
                       fe.get_unit_support_points()[k], v) *
                     cell->vertex(v);
              const auto index = dim * nodes[k];
              if (body.index != b || std::fabs(x[2] - 1.) > 1e-9 ||
                  !level.layout->in_local_range(index))
                continue;
              const unsigned int place = level.layout->global_to_local(index);
              if (seen.insert(place).second)
                visit(place, x[0], x[1]);
            }
        });
    }

    NodalScene                           scene;
    std::vector<Coupling>                couplings;
    MultigridLevel                       level;
    LevelVector<double>                  diagonal;
    std::vector<IndependentDisplacement> leading;
  };

  /// Lagrange's polynomials on the Gauss-Lobatto points of [0, 1].
  double
  lagrange(const std::vector<double> &points,
           const unsigned int         i,
           const double               x)
  {
    double value = 1.;
    for (unsigned int j = 0; j < points.size(); ++j)
      if (j != i)
        value *= (x - points[j]) / (points[i] - points[j]);
    return value;
  }

  void
  check(const unsigned int p, const unsigned int n)
  {
    const std::string      name = "p = " + std::to_string(p);
    const NestedSquares    squares(p, n, false, false);
    std::vector<double>    points;
    const QGaussLobatto<1> lobatto(p + 1);
    for (const auto &x : lobatto.get_points())
      points.push_back(x[0]);
    const unsigned int  n_nodes = (p + 1) * (p + 1);
    std::vector<double> expected(n_nodes);
    squares.for_each_node(
      0, [&](const unsigned int place, const double x, const double y) {
        for (unsigned int j = 0; j < n_nodes; ++j)
          expected[j] += squares.diagonal.local_element(place) *
                         std::pow(lagrange(points, j % (p + 1), x) *
                                    lagrange(points, j / (p + 1), y),
                                  2);
      });
    Utilities::MPI::sum(expected, MPI_COMM_WORLD, expected);
    std::map<unsigned int, double> dependent_stiffness; // by place
    for (const auto &leading : squares.leading)
      dependent_stiffness[leading.index] = leading.dependent_stiffness;
    const unsigned int n_leading =
      Utilities::MPI::sum<unsigned int>(dependent_stiffness.size(),
                                        MPI_COMM_WORLD);
    // one component of the nodes at x = 0 is held
    verdict(name + ": all that are free lead",
            std::fabs(double(n_leading) - (3. * n_nodes - (p + 1.))),
            0);
    double error = 0.;
    squares.for_each_node(
      1, [&](const unsigned int place, const double x, const double y) {
        const auto at = [&](const double t) {
          return std::min_element(points.begin(),
                                  points.end(),
                                  [t](const double a, const double b) {
                                    return std::fabs(a - t) < std::fabs(b - t);
                                  }) -
                 points.begin();
        };
        const double sum = expected[at(x) + (p + 1) * at(y)];
        for (unsigned int c = 0; c < dim; ++c)
          if (const auto found = dependent_stiffness.find(place + c);
              found != dependent_stiffness.end())
            error = std::max(error, std::fabs(found->second / sum - 1.));
      });
    verdict(name + ": what follows",
            Utilities::MPI::max(error, MPI_COMM_WORLD),
            1e-10);
    const auto count = [](const NestedSquares &other) {
      return Utilities::MPI::sum<double>(other.leading.size(), MPI_COMM_WORLD);
    };
    verdict(name + ": none beside a slave that is held",
            count(NestedSquares(p, n, true, false)),
            0);
    verdict(name + ": none with a coarser slave",
            count(NestedSquares(p, n, false, true)),
            0);
  }
} // namespace mortise::testing

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int p : {2, 3, 4})
    mortise::testing::check(p, 3);
}
