// Proves that what breaks the law of an interface is measured as the energy
// that is derived with evaluate_interface(), of displacements and tractions
// that are given: across a tie, along the normal where bodies slide, beside
// what springs give way, and under contact of overlaps, tension, and the less
// of gap and pressure at one point; and not across a periodic tie, whose jump
// is given. The same on any number of ranks.
#include <mortise/mortar/interface_evaluation.h>
#include <verdict.h>

#include "tied_scene.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  using Vec = dealii::Tensor<1, dim>;

  constexpr unsigned int degree = 2, n_cells = 3;
  /// pi p / h over 2 (1/E_1 + 1/E_2) with moduli of 1 and 2.
  const double c = dealii::numbers::PI * degree * n_cells / 3.;

  /// Below and above z = 0 on the unit square.
  TiedScene
  halves(const bool   tetrahedra,
         const bool   one_sided,
         const double thickness = 1.)
  {
    return TiedScene(
      {box_mesh({0, 0, -thickness, 1, 1, 0}, {n_cells, n_cells, 1}),
       "zmax",
       degree,
       {},
       {}},
      {box_mesh({0, 0, 0, 1, 1, thickness}, {2, 2, 1}, tetrahedra),
       "zmin",
       degree,
       {},
       {}},
      MPI_COMM_WORLD,
      false,
      MultiplierBasis::standard,
      one_sided);
  }

  /// The master moves by @p jump and bears @p traction; the slave stays.
  InterfaceEvaluation
  violations(TiedScene    &scene,
             const Field  &jump,
             const Vec    &traction,
             const Offset &offset = {})
  {
    TraceDisplacement u{scene.displacement(), scene.displacement()};
    scene.interpolate(1, jump, u.free);
    std::vector<std::vector<double>> tractions;
    for (const FaceTrace &trace : scene.coupling().interface->slave().traces)
      {
        tractions.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          for (const auto &function : trace.basis().functions)
            tractions.back().push_back(function.dimension == 0 ? traction[d] :
                                                                 0.);
      }
    return evaluate_interface(
      scene.coupling(), u, tractions, offset, {}, scene.comm);
  }

  double
  energy(TiedScene    &scene,
         const Field  &jump,
         const Vec    &traction,
         const Offset &offset = {})
  {
    const auto by_face = violations(scene, jump, traction, offset).energies;
    return dealii::Utilities::MPI::sum(
      std::accumulate(by_face.begin(), by_face.end(), 0.), scene.comm);
  }

  void
  check(const std::string &what, const double got, const double expected)
  {
    verdict(what + " 1e-12", std::fabs(got - expected), 1e-12);
  }

  /// With u_slave = Q u_master + a given jump = 0, of a quarter of a turn.
  double
  turned(TiedScene &scene)
  {
    RigidMotion &placement = scene.couplings[0].placement;
    placement              = RigidMotion({{0., 0., 90.}}, {});
    const Vec    jump({0.1, -0.2, 0.3});
    const Vec    of_master = -1. * (transpose(placement.rotation) * jump);
    const double result =
      energy(scene, [&](const auto &) { return of_master; }, {}, {{}, jump});
    placement = RigidMotion();
    return result;
  }

  void
  check_ties(const bool tetrahedra)
  {
    const std::string of    = tetrahedra ? ", tetrahedra" : "";
    TiedScene         scene = halves(tetrahedra, false);
    const Field       jump  = [](const dealii::Point<dim> &x) {
      return Vec({0.1 + 0.2 * x[0], -0.3 * x[1], 0.05});
    };
    // of the integral of the squares over the unit square
    const double across = 0.01 + 0.02 + 0.04 / 3. + 0.09 / 3., along = 0.0025;
    check("tie" + of, energy(scene, jump, {}), c * (across + along));
    scene.couplings[0].law.constrained = ConstrainedDirections::normal;
    check("sliding" + of, energy(scene, jump, {}), c * along);
    scene.couplings[0].law.constrained = ConstrainedDirections::all;

    const Field constant   = [](const auto &) { return Vec({0.1, 0, 0.2}); };
    scene.couplings[0].law = {Law::spring,
                              ConstrainedDirections::all,
                              false,
                              [](const auto &) {
                                return InterfaceStiffness{10., 5.};
                              }};
    check("spring that gives way" + of,
          energy(scene, constant, Vec({-0.5, 0., -2.})),
          0.);
    check("spring, half of it" + of,
          energy(scene, constant, Vec({-0.25, 0., -1.})),
          c * (std::pow(0.05 / (1. + c / 5.), 2) +
               std::pow(0.1 / (1. + c / 10.), 2)));
    scene.couplings[0].law = {};
    check("offset" + of,
          energy(scene,
                 [](const auto &) {
                   return Vec({0, 0, -0.1});
                 },
                 {},
                 {[](const auto &) { return 0.1; }, {}}),
          0.);
    check("periodic" + of, turned(scene), 0.);
  }

  void
  check_plates(const bool tetrahedra)
  {
    constexpr double thickness = 0.01;
    TiedScene        scene     = halves(tetrahedra, false, thickness);
    const double     k         = dealii::numbers::PI * degree * n_cells;
    check(std::string("plates") + (tetrahedra ? ", tetrahedra" : ""),
          energy(scene,
                 [](const auto &) {
                   return Vec({0, 0, 0.1});
                 },
                 {}),
          c * std::pow(k * thickness, 3) / 6. * 0.01);
  }

  void
  check_contact(const bool tetrahedra)
  {
    const std::string of    = tetrahedra ? ", tetrahedra" : "";
    TiedScene         scene = halves(tetrahedra, true);
    const auto        at    = [&](const double gap, const double pressure) {
      // across the normal anything may happen
      return energy(
        scene,
        [&](const auto &) {
          return Vec({1., 0., gap});
        },
        Vec({0., 0., pressure}));
    };
    check("open" + of, at(0.1, 0.), 0.);
    check("pressing" + of, at(0., 2.), 0.);
    check("overlap" + of, at(-0.1, 2.), c * 0.01);
    check("tension" + of, at(0.1, -0.2), 0.04 / c);
    check("overlap and tension" + of, at(-0.1, -0.2), c * 0.01 + 0.04 / c);
    check("a gap that presses hard" + of, at(0.1, 10.), c * 0.01);
    check("a large gap that presses" + of, at(1., 0.2), 0.04 / c);

    // bodies overlap up to x = 0.25, which is inside of one row of faces
    const InterfaceEvaluation opens =
      violations(scene,
                 [](const auto &x) {
                   return Vec({0., 0., 1e-3 * (x[0] - 0.25)});
                 },
                 {});
    const auto number = [&](const std::vector<bool> &at_edge) {
      return dealii::Utilities::MPI::sum(
        std::count(at_edge.begin(), at_edge.end(), true), scene.comm);
    };
    check("slaves at the edge" + of, number(opens.slave_at_edge), n_cells);
    check("masters at the edge" + of,
          number(opens.master_at_edge),
          tetrahedra ? 4 : 2);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const bool tetrahedra : {false, true})
    {
      check_ties(tetrahedra);
      check_plates(tetrahedra);
      check_contact(tetrahedra);
    }
}
