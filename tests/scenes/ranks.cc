// Proves that a scene gives the same on any number of ranks, also when bodies
// have fewer cells than there are ranks: each rank solves the scene alone and
// compares with all ranks together.
#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  void
  check(const std::string &what,
        const std::string &text,
        const Settings    &settings)
  {
    const StepSummary alone =
      run_scene(text, settings, MPI_COMM_SELF).steps.back();
    const StepSummary together = run_scene(text, settings).steps.back();

    const auto same =
      [&](const std::string &quantity, const double a, const double b) {
        verdict(what + ": " + quantity + " 1e-8",
                std::fabs(a - b) / std::max(std::fabs(b), 1e-300),
                1e-8);
      };
    same("displacement dofs",
         together.dofs.displacement,
         alone.dofs.displacement);
    same("multipliers", *together.dofs.multiplier, *alone.dofs.multiplier);
    for (unsigned int i = 0; i < alone.interfaces.size(); ++i)
      {
        const InterfaceSummary &a = together.interfaces[i],
                               &b = alone.interfaces[i];
        same("slave faces", a.slave_faces, b.slave_faces);
        same("master faces", a.master_faces, b.master_faces);
        same("pairs", a.pairs, b.pairs);
        same("quadrature points", a.quadrature_points, b.quadrature_points);
        same("covered area", a.covered_area, b.covered_area);
      }
    same("L2 error",
         *together.errors->displacement_l2,
         *alone.errors->displacement_l2);
    same("energy error", *together.errors->energy, *alone.errors->energy);
    same("multiplier error",
         *together.errors->multiplier_l2,
         *alone.errors->multiplier_l2);
    if (alone.dofs.pressure)
      {
        same("pressures", *together.dofs.pressure, *alone.dofs.pressure);
        same("pressure error",
             *together.errors->pressure_l2,
             *alone.errors->pressure_l2);
      }
    for (unsigned int i = 0; i < alone.quantities.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        same(alone.quantities[i].first + " " + std::to_string(c),
             together.quantities[i].second[c],
             alone.quantities[i].second[c]);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Settings quantities = {"Output/Points=tip: outer: 0, 0, 2",
                               "Output/Resultants=held: outer: zmin",
                               "Body inner/Mesh/Subdivisions=2, 1",
                               "Body outer/Mesh/Subdivisions=3, 1"};
  for (const std::string method : {"direct", "condensed", "saddle point"})
    {
      Settings settings = quantities;
      settings.insert(settings.end(),
                      {"Solver/Method=" + method,
                       "Solver/Tolerance=1e-12",
                       "Body inner/Degree=2",
                       "Body outer/Degree=2"});
      check("sphere, " + method, two_layers(true), settings);
    }
  Settings settings = quantities;
  settings.insert(settings.end(),
                  {"Solver/Method=direct",
                   "Body inner/Degree=1",
                   "Body outer/Degree=2",
                   "Body inner/Degree by region=0: 3; 1: 2",
                   "Body outer/Degree by region=1: 3",
                   "Body inner/Mesh/Refine near=0, 0, 1.5, 0.6, 1",
                   "Body outer/Mesh/Refine near=1.5, 0, 0, 0.5, 1"});
  check("sphere with hanging nodes and mixed degrees",
        two_layers(true),
        settings);
  const Settings incompressible = {"Body inner/Material/Poisson ratio=0.5",
                                   "Body outer/Material/Poisson ratio=0.5"};
  check("incompressible, hanging nodes and mixed degrees",
        two_layers(true),
        quantities + incompressible +
          Settings{"Solver/Method=direct",
                   "Body inner/Degree=2",
                   "Body outer/Degree=2",
                   "Body inner/Degree by region=0: 3",
                   "Body outer/Degree by region=1: 4",
                   "Body inner/Mesh/Refine near=0, 0, 1.5, 0.6, 1",
                   "Body outer/Mesh/Refine near=1.5, 0, 0, 0.5, 1"});
  for (const std::string method : {"direct", "saddle point"})
    check("incompressible tetrahedra on hexahedra, " + method,
          two_layers(true),
          quantities + incompressible +
            Settings{"Solver/Method=" + method,
                     "Solver/Tolerance=1e-12",
                     "Body inner/Mesh/Cells=tetrahedra",
                     "Body inner/Degree=2",
                     "Body outer/Degree=3"});
  check("no vertex of the slave free along the axis",
        two_layers(false),
        {"Solver/Method=direct",
         "Body inner/Degree=1",
         "Body outer/Degree=1",
         "Body inner/Mesh/Subdivisions=9, 1, 1",
         "Body outer/Mesh/Subdivisions=11, 1, 2"});
  check("one cell each",
        two_layers(false),
        {"Solver/Method=direct",
         "Body inner/Degree=3",
         "Body outer/Degree=3",
         "Body inner/Mesh/Subdivisions=1, 1, 1",
         "Body outer/Mesh/Subdivisions=1, 1, 1"});
  // Degrees up to 2: deal.II 9.4's assertions take no more on tetrahedra.
  const Settings tetrahedra = {"Body inner/Mesh/Cells=tetrahedra",
                               "Body inner/Degree=2",
                               "Body outer/Degree=2"};
  for (const std::string method : {"direct", "condensed", "saddle point"})
    check("tetrahedra on hexahedra, " + method,
          two_layers(true),
          quantities + tetrahedra +
            Settings{"Solver/Method=" + method, "Solver/Tolerance=1e-12"});
  check("tetrahedra on tetrahedra with mixed degrees",
        two_layers(true),
        quantities + tetrahedra +
          Settings{"Solver/Method=direct",
                   "Body outer/Mesh/Cells=tetrahedra",
                   "Body inner/Degree by region=1: 1",
                   "Body outer/Degree by region=0: 1"});
  check("clamped rim of tetrahedra",
        manufactured(),
        {"Solver/Method=direct",
         "Body lower/Mesh/Cells=tetrahedra",
         "Body upper/Mesh/Cells=tetrahedra",
         "Body lower/Degree=1",
         "Body upper/Degree=2",
         "Body lower/Mesh/Subdivisions=3, 3, 1",
         "Body upper/Mesh/Subdivisions=2, 2, 1"});
  check("six tetrahedra each",
        two_layers(false),
        {"Solver/Method=direct",
         "Body inner/Mesh/Cells=tetrahedra",
         "Body outer/Mesh/Cells=tetrahedra",
         "Body inner/Degree=2",
         "Body outer/Degree=2",
         "Body inner/Mesh/Subdivisions=1, 1, 1",
         "Body outer/Mesh/Subdivisions=1, 1, 1"});
}
