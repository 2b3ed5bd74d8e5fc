// Proves that forces of contact that follows the bodies are the derivatives of
// the gaps, and that force_stiffness() is the derivative of these forces at
// fixed multipliers, by differences in random directions where the sides touch:
// hexahedra on hexahedra, tetrahedra on hexahedra, stretched and turned.
#include <deal.II/base/mpi.h>

#include <mortise/mortar/force_stiffness.h>
#include <verdict.h>

#include <algorithm>
#include <cmath>

#include "scenes/active_sets.h"

using namespace dealii;
using namespace mortise;
using namespace mortise::testing;

namespace
{
  std::string
  block(const std::string &name,
        const std::string &extent,
        const std::string &cells,
        const bool         tetrahedra,
        const unsigned int degree,
        const std::string &held)
  {
    return "subsection Body " + name +
           "\n  set Degree = " + std::to_string(degree) +
           "\n  subsection Mesh\n    set Source = box\n    set Extent = " +
           extent + "\n    set Subdivisions = " + cells +
           (tetrahedra ? "\n    set Cells = tetrahedra" : "") +
           "\n  end\n  subsection Material\n    set Law = neo-Hookean\n"
           "    set Young modulus = 10\n  end\n  subsection Boundary " +
           held + "\n    set Displacement = 0, 0, 0\n  end\nend\n";
  }

  std::string
  scene(const bool tetrahedra, const unsigned int degree)
  {
    return "set Bodies = lower, upper\nset Interfaces = touch\n" +
           block(
             "lower", "0, 0, 0, 3, 2, 1", "5, 3, 1", false, degree, "zmin") +
           block("upper",
                 "0.6, 0.4, 1, 2.1, 1.5, 2",
                 "3, 2, 1",
                 tetrahedra,
                 degree,
                 "zmax") +
           "subsection Interface touch\n  set Slave = upper: zmin\n"
           "  set Master = lower: zmax\n  set Law = contact\n"
           "  set Sliding = finite\n  set Quadrature points = 12\nend\n";
  }

  /// A number for each unknown, as good as random.
  mortise::Vector
  random(const mortise::Vector &layout, const double seed)
  {
    mortise::Vector result(layout);
    for (const auto i : result.locally_owned_elements())
      result(i) = std::sin(12.9898 * static_cast<double>(i) + seed);
    return result;
  }

  double
  difference(const mortise::Vector &a, const mortise::Vector &b)
  {
    mortise::Vector d(a);
    d -= b;
    return d.l2_norm() / b.l2_norm();
  }

  void
  check(const bool tetrahedra, const unsigned int degree)
  {
    constexpr double  step = 1e-5;
    const MPI_Comm    comm = MPI_COMM_WORLD;
    EquationsOfScene  given(scene(tetrahedra, degree), {}, comm);
    Discretisation   &discretisation = given.discretisation;
    const std::string of =
      std::string(tetrahedra ? "tetrahedra" : "hexahedra") + ", degree " +
      std::to_string(degree) + ": ";
    const BlockSystem &system = discretisation.linear_system();
    const double       angle  = 0.7;
    const auto         moved  = linear_displacements(
      discretisation.bodies(),
      [&](const unsigned int, const unsigned int c, const Point<dim> &x) {
        const Point<dim> y(1.2 * x[0] + 0.1 * x[1], 0.9 * x[1], 0.7 * x[2]);
        const double     there[dim] = {y[0],
                                       std::cos(angle) * y[1] -
                                         std::sin(angle) * y[2],
                                       std::sin(angle) * y[1] +
                                         std::cos(angle) * y[2]};
        return there[c] - x[c];
      });
    SystemVector at = system.zero_vector();
    at.displacement =
      system.bulk->values_at_nodes([&](const auto body, const auto dof) {
        return moved[body].displacement(dof);
      });
    const auto pair = [&](const mortise::Vector &displacement) {
      SystemVector x = system.zero_vector();
      x.displacement = displacement;
      discretisation.pair(discretisation.solutions(SceneLoad(), x));
    };
    mortise::Vector direction = random(at.displacement, 1.);
    for (const unsigned int i : system.bulk->levels().front().constrained)
      direction.local_element(i) = 0.;
    pair(at.displacement);
    const mortise::Vector multiplier = [&] {
      mortise::Vector result = random(system.zero_vector().multiplier, 2.);
      for (double &value : result)
        value += 2.;
      return result;
    }();

    // gaps, and forces, beside their differences
    mortise::Vector closing(multiplier);
    system.constraint.vmult(closing, direction);
    mortise::SparseMatrix stiffness =
      force_stiffness(discretisation.interfaces().all(),
                      multiplier,
                      system.owned_displacement,
                      comm);
    mortise::Vector product(at.displacement);
    stiffness.vmult(product, direction);
    mortise::Vector forces[2], gaps[2];
    for (unsigned int side = 0; side < 2; ++side)
      {
        mortise::Vector there(at.displacement);
        there.add(side == 0 ? step : -step, direction);
        pair(there);
        SceneLoad    load = discretisation.load(given.fields());
        SystemVector x    = system.zero_vector();
        x.displacement    = there;
        forces[side]      = at.displacement;
        forces[side]      = 0.;
        system.constraint.Tvmult_add(forces[side], multiplier);
        mortise::Vector closed(multiplier);
        system.constraint.vmult_free(closed, there);
        gaps[side] = load.rhs.multiplier;
        gaps[side] -= closed;
      }
    for (auto *both : {forces, gaps})
      {
        both[0] -= both[1];
        both[0] *= 0.5 / step;
      }
    for (const unsigned int i : system.bulk->levels().front().constrained)
      product.local_element(i) = 0.;
    closing *= -1.;
    verdict(of + "constraint beside differences of gaps",
            difference(gaps[0], closing),
            1e-6);
    verdict(of + "stiffness beside differences of forces",
            difference(product, forces[0]),
            5e-5);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const bool tetrahedra : {false, true})
    for (const unsigned int degree : {1, 2, 3})
      check(tetrahedra, degree);
}
