// Proves that forces of contact that follows the bodies are the derivatives of
// the gaps, and that force_stiffness() is the derivative of these forces at
// fixed multipliers, by differences in random directions where the sides touch:
// hexahedra on hexahedra, tetrahedra on hexahedra, stretched and turned; and
// that it is with friction for motions that leave the axes of tractions.
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
  scene(const bool         tetrahedra,
        const unsigned int degree,
        const bool         has_friction = false)
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
           "  set Sliding = finite\n  set Quadrature points = 12\n" +
           (has_friction ? "  set Friction coefficient = 0.3\n" : "") + "end\n";
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

  constexpr double step = 1e-5, angle = 0.7;

  /// Stretched and turned about the x axis.
  Tensor<1, dim>
  place(const Point<dim> &x)
  {
    const Tensor<1, dim> y({1.2 * x[0] + 0.1 * x[1], 0.9 * x[1], 0.7 * x[2]});
    return Tensor<1, dim>({y[0],
                           std::cos(angle) * y[1] - std::sin(angle) * y[2],
                           std::sin(angle) * y[1] + std::cos(angle) * y[2]});
  }

  /// The displacement @p u(body, place in the body) at nodes.
  template <typename Field>
  mortise::Vector
  at_nodes(const Discretisation &discretisation, const Field &u)
  {
    const auto linear =
      linear_displacements(discretisation.bodies(),
                           [&](const unsigned int body,
                               const unsigned int c,
                               const Point<dim>  &x) { return u(body, x)[c]; });
    return discretisation.linear_system().bulk->values_at_nodes(
      [&](const auto body, const auto dof) {
        return linear[body].displacement(dof);
      });
  }

  void
  check(const bool tetrahedra, const unsigned int degree)
  {
    const MPI_Comm    comm = MPI_COMM_WORLD;
    EquationsOfScene  given(scene(tetrahedra, degree), {}, comm);
    Discretisation   &discretisation = given.discretisation;
    const std::string of =
      std::string(tetrahedra ? "tetrahedra" : "hexahedra") + ", degree " +
      std::to_string(degree) + ": ";
    const BlockSystem &system = discretisation.linear_system();
    SystemVector       at     = system.zero_vector();
    at.displacement =
      at_nodes(discretisation, [](const unsigned int, const Point<dim> &x) {
        return place(x) - Tensor<1, dim>(x);
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

  /// With friction, at fixed multipliers: differences for a slave that is moved
  /// along, where frames stay; and a rotation about axes in the surface, which
  /// turns all forces.
  void
  check_friction(const bool tetrahedra, const unsigned int degree)
  {
    const MPI_Comm     comm = MPI_COMM_WORLD;
    EquationsOfScene   given(scene(tetrahedra, degree, true), {}, comm);
    Discretisation    &discretisation = given.discretisation;
    const BlockSystem &system         = discretisation.linear_system();
    const std::string  of             = std::string("friction, ") +
                           (tetrahedra ? "tetrahedra" : "hexahedra") +
                           ", degree " + std::to_string(degree) + ": ";
    const auto &constrained = system.bulk->levels().front().constrained;
    const mortise::Vector at =
      at_nodes(discretisation, [](const unsigned int, const Point<dim> &x) {
        return place(x) - Tensor<1, dim>(x);
      });
    mortise::Vector multiplier;
    const auto      forces = [&](const mortise::Vector &displacement) {
      SystemVector x = system.zero_vector();
      x.displacement = displacement;
      discretisation.pair(discretisation.solutions(SceneLoad(), x));
      if (multiplier.size() == 0)
        {
          multiplier = random(system.zero_vector().multiplier, 2.);
          for (double &value : multiplier)
            value += 2.;
        }
      mortise::Vector result(at);
      result = 0.;
      system.constraint.Tvmult_add(result, multiplier);
      return result;
    };
    const auto product = [&](const mortise::Vector &direction) {
      const mortise::Vector forces_here = forces(at);
      mortise::Vector       result(at);
      force_stiffness(discretisation.interfaces().all(),
                      multiplier,
                      system.owned_displacement,
                      comm)
        .vmult(result, direction);
      for (const unsigned int i : constrained)
        result.local_element(i) = 0.;
      return result;
    };

    const Tensor<1, dim> along(
      {1., 0.5 * std::cos(angle), 0.5 * std::sin(angle)});
    const mortise::Vector motion =
      at_nodes(discretisation,
               [&](const unsigned int body, const Point<dim> &) {
                 return body == 1 ? along : Tensor<1, dim>();
               });
    mortise::Vector differences[2];
    for (unsigned int side = 0; side < 2; ++side)
      {
        mortise::Vector there(at);
        there.add(side == 0 ? step : -step, motion);
        differences[side] = forces(there);
      }
    differences[0] -= differences[1];
    differences[0] *= 0.5 / step;
    verdict(of + "a slave that is moved along, beside differences",
            difference(product(motion), differences[0]),
            5e-5);

    for (const Tensor<1, dim> &axis :
         {Tensor<1, dim>({1., 0., 0.}),
          Tensor<1, dim>({0., std::cos(angle), std::sin(angle)})})
      {
        const mortise::Vector turned =
          product(at_nodes(discretisation,
                           [&](const unsigned int, const Point<dim> &x) {
                             return cross_product_3d(axis, place(x));
                           }));
        mortise::Vector wanted = forces(at);
        for (unsigned int i = 0; i < wanted.locally_owned_size(); i += dim)
          {
            Tensor<1, dim> force;
            for (unsigned int c = 0; c < dim; ++c)
              force[c] = wanted.local_element(i + c);
            force = cross_product_3d(axis, force);
            for (unsigned int c = 0; c < dim; ++c)
              wanted.local_element(i + c) = force[c];
          }
        verdict(of + "a rotation turns the forces",
                difference(turned, wanted),
                1e-8);
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const bool tetrahedra : {false, true})
    for (const unsigned int degree : {1, 2, 3})
      {
        check(tetrahedra, degree);
        check_friction(tetrahedra, degree);
      }
}
