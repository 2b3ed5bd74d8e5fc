// Proves on small meshes that the pressures of the mixed form and the
// multipliers of a tie, clamped rims included, are inf-sup stable, pressures in
// deformed states, too: constants from eigenvalues stay above bounds, while
// pressures of the displacement's degree and multipliers without the reduction
// beside rims have none. The bounds are 0.9 times what
// doc/measurements/inf_sup.md shows.
#include "../verdict.h"
#include "inf_sup_multiplier.h"
#include "inf_sup_stretched.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  const std::vector<std::string> sides = {"xmin", "xmax", "ymin", "ymax"};

  /// Far below any bound: what a space is worth that is not stable.
  constexpr double nothing = 0.01;

  InfSupBody
  cube(const std::string &cells, const unsigned int degree)
  {
    InfSupBody body;
    body.mesh.cells        = cells;
    body.mesh.extent       = {0., 0., 0., 1., 1., 1.};
    body.mesh.subdivisions = {2, 2, 2};
    body.degree            = degree;
    body.clamped           = sides;
    body.clamped.insert(body.clamped.end(), {"zmin", "zmax"});
    return body;
  }

  void
  check_pressures(const std::string &what,
                  const InfSupBody  &body,
                  const double       bound)
  {
    const PressureInfSup pair = pressure_inf_sup(body, true);
    verdict(what + ": pressures without a force", pair.kernel, 1);
    verdict(what + ": 1 / beta of the pressures", 1. / pair.beta, 1. / bound);
    verdict(what + ": the same with pressures of equal degree, beta",
            pressure_inf_sup(body, true, true).beta,
            nothing);
  }

  void
  check_all_pressures()
  {
    check_pressures("hexahedra, degree 2", cube("hexahedra", 2), 0.34);
    check_pressures("hexahedra, degree 3", cube("hexahedra", 3), 0.28);
    check_pressures("tetrahedra, degree 2", cube("tetrahedra", 2), 0.18);
    check_pressures("tetrahedra, degree 3", cube("tetrahedra", 3), 0.14);
    InfSupBody mixed       = cube("hexahedra", 2);
    mixed.degree_by_region = {{0, 3}, {3, 4}};
    mixed.mesh.refine_near = "1, 1, 1, 0.1, 1";
    check_pressures("hanging nodes, degrees 2 to 4", mixed, 0.29);
  }

  void
  check_stretched_pressures()
  {
    for (const std::string cells : {"hexahedra", "tetrahedra"})
      for (const unsigned int p : {2, 3})
        {
          const bool        hexahedra = cells == "hexahedra";
          const InfSupBody  body      = cube(cells, p);
          const std::string what      = cells + ", degree " + std::to_string(p);
          const auto        check     = [&](const std::string &kind,
                                 const double       size,
                                 const double       bound) {
            const PressureInfSup pair =
              stretched_inf_sup(body, deformation(kind, size));
            const std::string name = what + ", " + kind;
            // by an affine deformation the rule is exact
            if (kind != "twist")
              verdict(name + ": pressures without a force", pair.kernel, 1);
            verdict(name + ": 1 / beta of the pressures",
                    1. / pair.beta,
                    1. / bound);
          };
          verdict(what + ", not deformed: beta",
                  std::fabs(
                    stretched_inf_sup(body, deformation("stretch", 1.)).beta /
                      pressure_inf_sup(body, true).beta -
                    1.),
                  1e-6);
          check("stretch", 4., hexahedra ? 0.15 : 0.11);
          check("press", 2., hexahedra ? 0.24 : 0.117);
          check("shear", 3., hexahedra ? 0.18 : 0.133);
          check("twist", 1., hexahedra ? 0.26 : 0.13);
        }
  }

  InfSupBody
  layer(const bool         lower,
        const std::string &cells,
        const unsigned int degree,
        const unsigned int n)
  {
    const double bottom = lower ? 0. : 0.5;
    InfSupBody   body;
    body.mesh.extent       = {0., 0., bottom, 1., 1., bottom + 0.5};
    body.mesh.cells        = cells;
    body.mesh.subdivisions = {n, n, (n + 1) / 2};
    body.degree            = degree;
    return body;
  }

  /// Slave 3 x 3 squares of @p cells, master 2 x 2 of hexahedra.
  void
  check_multipliers(const std::string &cells,
                    const unsigned int degree,
                    const double       bound,
                    const double       bound_clamped)
  {
    InfSupBody slave  = layer(true, cells, degree, 3),
               master = layer(false, "hexahedra", degree, 2);
    const std::string what =
      "multipliers on " + cells + ", degree " + std::to_string(degree) + ": ";
    verdict(what + "1 / beta",
            1. / multiplier_inf_sup(slave, master).beta,
            1. / bound);
    slave.clamped = master.clamped = sides;
    verdict(what + "clamped, 1 / beta",
            1. / multiplier_inf_sup(slave, master).beta,
            1. / bound_clamped);
    verdict(what + "clamped, no reduction, beta",
            multiplier_inf_sup(slave, master, false).beta,
            nothing);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_all_pressures();
  check_stretched_pressures();
  check_multipliers("hexahedra", 1, 0.5, 0.44);
  check_multipliers("hexahedra", 2, 0.51, 0.37);
  check_multipliers("tetrahedra", 1, 0.34, 0.3);
}
