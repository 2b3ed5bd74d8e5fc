// Proves that the largest displacement and the largest von Mises stress are
// found with their places, at corners and edges too, on any number of ranks,
// the same place of many; that stresses which jump between cells are averaged
// and the jump is told; and that volumes are exact on straight and curved
// cells.
#include <mortar/tied_scene.h>
#include <mortise/operators/body_volume.h>
#include <mortise/output/extremes.h>
#include <verdict.h>

#include "polynomial_field.h"

namespace mortise::testing
{
  using namespace dealii;

  constexpr double modulus = 5., ratio = 0.25;

  std::unique_ptr<Body>
  make_body(const MeshParameters &mesh, const unsigned int degree)
  {
    auto body =
      std::make_unique<Body>("body", 0, LinearElastic{modulus, ratio});
    body->create_mesh(mesh, MPI_COMM_WORLD, "body");
    body->create_space(degree, {}, "body");
    return body;
  }

  Extremes
  extremes_of(
    const Body                                                    &body,
    const std::function<double(unsigned int, const Point<dim> &)> &function)
  {
    BodySolution solution;
    solution.displacement =
      interpolate(body, body.dof_handler, body.relevant_dofs, function);
    return extremes(body, solution);
  }

  double
  distance(const std::vector<double> &at, const Point<dim> &expected)
  {
    return at.size() == 3 ? expected.distance({at[0], at[1], at[2]}) : 1e9;
  }

  /// Pure bending: sigma_xx = E z alone, the largest on the whole face z = 1,
  /// of which (0, 0, 1) is the first.
  void
  check_bending(const std::string &what,
                const bool         tetrahedra,
                const unsigned int p)
  {
    const auto body =
      make_body(box_mesh({0, 0, 0, 3, 1, 1}, {3, 2, 2}, tetrahedra), p);
    const Extremes found =
      extremes_of(*body, [](const unsigned int c, const Point<dim> &x) {
        return c == 0 ?
                 x[0] * x[2] :
               c == 1 ?
                 -ratio * x[1] * x[2] :
                 -0.5 * x[0] * x[0] - 0.5 * ratio * (x[2] * x[2] - x[1] * x[1]);
      });
    verdict(what + ": stress",
            std::fabs(found.von_mises.value - modulus),
            1e-9);
    verdict(what + ": its place",
            distance(found.von_mises.at, {0, 0, 1}),
            1e-12);
    verdict(what + ": averaged",
            std::fabs(found.von_mises.averaged - modulus),
            1e-9);
    verdict(what + ": jump", found.von_mises.jump.value_or(1.), 1e-9);
    // at (3, 0, 1): (3, 0, -4.5 - 0.125)
    verdict(what + ": displacement",
            std::fabs(found.displacement.value - std::hypot(3., 4.625)),
            1e-12);
    verdict(what + ": its place",
            distance(found.displacement.at, {3, 0, 1}),
            1e-12);
    verdict(what + ": volume", std::fabs(body_volume(*body) - 3.), 1e-13);
  }

  /// Uniaxial strain 1 in one cell and 3 in the next one: sigma = 2 mu e.
  void
  check_jump()
  {
    const auto     body = make_body(box_mesh({0, 0, 0, 2, 1, 1}, {2, 1, 1}), 1);
    const Extremes found =
      extremes_of(*body, [](const unsigned int c, const Point<dim> &x) {
        return c > 0 ? 0. : x[0] < 1. ? x[0] : 3. * x[0] - 2.;
      });
    const double two_mu = modulus / (1. + ratio);
    verdict("two cells: stress",
            std::fabs(found.von_mises.value - 3. * two_mu),
            1e-12);
    verdict("two cells: its place, on the side that has it",
            distance(found.von_mises.at, {1, 0, 0}),
            1e-12);
    verdict("two cells: averaged",
            std::fabs(found.von_mises.averaged - 2. * two_mu),
            1e-12);
    verdict("two cells: jump",
            std::fabs(found.von_mises.jump.value_or(0.) - 2. * two_mu),
            1e-12);
    const auto     one = make_body(box_mesh({0, 0, 0, 1, 1, 1}, {1, 1, 1}), 2);
    const Extremes alone =
      extremes_of(*one, [](const unsigned int, const Point<dim> &x) {
        return x[0] * x[0];
      });
    verdict("one cell: no jump", alone.von_mises.jump ? 1. : 0., 0.);
  }

  void
  check_volumes()
  {
    MeshParameters shell;
    shell.source       = "shell octant";
    shell.extent       = {1., 2.};
    shell.subdivisions = {2, 2};
    const double exact = numbers::PI / 6. * 7.;
    verdict("shell: volume",
            std::fabs(body_volume(*make_body(shell, 6)) / exact - 1.),
            1e-7);
  }
} // namespace mortise::testing

int
main(int argc, char *argv[])
{
  using namespace mortise::testing;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int p : {2, 3, 6})
    check_bending("hexahedra, p = " + std::to_string(p), false, p);
  for (const unsigned int p : {2, 3})
    check_bending("tetrahedra, p = " + std::to_string(p), true, p);
  check_jump();
  check_volumes();
  return 0;
}
