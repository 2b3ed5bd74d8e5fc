// Proves that a run with a target cuts cells and raises degrees until the error
// is what was asked for, and says how large it is within a factor of four, on
// hexahedra and tetrahedra, with and without a pressure, beside a corner and on
// part of the cells alone; and that what limits it is told. The same on any
// number of ranks. gmsh makes meshes of tetrahedra again at a corner.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  Settings
  target(const double error)
  {
    return {"Adaptivity/Target error=" + number(error)};
  }

  /// The sides of an interface are apart by less than the solution is off one
  /// whose sides are not.
  void
  check_parts(const std::string       &what,
              const AdaptivitySummary &of,
              const double             error)
  {
    verdict(what + ": parts 1e-12",
            std::fabs(std::hypot(*of.estimate_bulk, *of.estimate_interface) -
                      *of.estimate),
            1e-12);
    verdict(what + ": interface", *of.estimate_interface, error);
  }

  void
  check(const std::string &what,
        const std::string &text,
        const double       error,
        const Settings    &settings)
  {
    const auto steps = run_scene(text, target(error) + settings).steps;
    for (unsigned int c = 1; c < steps.size(); ++c)
      {
        const std::string cycle = what + ", cycle " + std::to_string(c);
        if (!steps[c].adaptivity->effectivity)
          {
            verdict(cycle + ": a new mesh, degree",
                    steps[c].bodies.back().degree_max,
                    steps[c - 1].bodies.back().degree_max - 2);
            continue;
          }
        const double effectivity = *steps[c].adaptivity->effectivity;
        verdict(cycle + ": too much by", effectivity, 4.);
        verdict(cycle + ": too little by", 1. / effectivity, 1.25);
        verdict(cycle + ": number of it",
                std::fabs(double(steps[c].cycle) - c),
                0.);
        check_parts(cycle, *steps[c].adaptivity, *steps[c].errors->energy);
      }
    verdict(what + ": error", *steps.back().errors->energy, error);
  }

  /// One cell below many: what these change by comes from it, and that it
  /// cannot follow them is told as the error of the interface.
  void
  check_coarse_slave()
  {
    const auto steps =
      run_scene(manufactured(),
                target(1e-3) + Settings{"Body lower/Mesh/Subdivisions=1, 1, 1",
                                        "Body upper/Mesh/Subdivisions=5, 5, "
                                        "5"})
        .steps;
    for (unsigned int c = 1; c < steps.size(); ++c)
      check_parts("coarse slave, cycle " + std::to_string(c),
                  *steps[c].adaptivity,
                  *steps[c].errors->energy);
    double most = 0.; // of the error
    for (unsigned int c = 1; c < steps.size(); ++c)
      most = std::max(most,
                      *steps[c].adaptivity->estimate_interface /
                        *steps[c].errors->energy);
    verdict("coarse slave: interface has half of the error", 0.5 / most, 1.);
    verdict("coarse slave: error", *steps.back().errors->energy, 1e-3);
    verdict("coarse slave: unknowns", steps.back().dofs.displacement, 1e5);
  }

  /// Errors of a pressure make displacements rough where the solution is
  /// smooth, which does not call for smaller cells. Degrees begin with the
  /// least of the mixed form.
  void
  check_nearly_incompressible()
  {
    constexpr double error  = 1e-3;
    const Settings   common = {"Body lower/Mesh/Subdivisions=3, 3, 1",
                               "Body upper/Mesh/Subdivisions=2, 2, 2",
                               "Body lower/Material/Poisson ratio=0.4999",
                               "Body upper/Material/Poisson ratio=0.4999"};
    const auto steps = run_scene(manufactured(), target(error) + common).steps;
    verdict("nearly incompressible: error",
            *steps.back().errors->energy,
            error);
    verdict("nearly incompressible: first degree",
            std::fabs(steps.front().bodies[0].degree_max - 2.),
            0.);
    for (unsigned int p = 3; p <= max_degree; ++p)
      {
        const auto uniform =
          run_scene(manufactured(),
                    common + Settings{"Body lower/Degree=" + std::to_string(p),
                                      "Body upper/Degree=" + std::to_string(p)})
            .steps.back();
        if (*uniform.errors->energy > error)
          continue;
        verdict("nearly incompressible: unknowns by those of one degree",
                double(steps.back().dofs.total) / uniform.dofs.total,
                1.5);
        return;
      }
  }

  /// From degree two on coefficients dispel the doubt of a first rise: it is
  /// the last one where its error is a quarter of what is allowed.
  void
  check_smooth_first_rise(const Settings &shells)
  {
    const Settings degrees = {"Body inner/Degree=2", "Body outer/Degree=2"};
    const double   after   = *run_scene(two_layers(true),
                                    shells + Settings{"Body inner/Degree=3",
                                                      "Body outer/Degree=3"})
                            .steps.back()
                            .errors->energy;
    verdict("first rise, smooth: cycles",
            run_scene(two_layers(true), target(4. * after) + shells + degrees)
              .steps.size(),
            2);
  }

  /// By step, the last cycle; cycles of each step are counted from zero on.
  std::map<unsigned int, const StepSummary *>
  last_cycles(const std::string &what, const std::vector<StepSummary> &steps)
  {
    std::map<unsigned int, const StepSummary *> result;
    double                                      other = 0.;
    for (const StepSummary &step : steps)
      {
        const auto         before = result.find(step.step);
        const unsigned int next =
          before == result.end() ? 0 : before->second->cycle + 1;
        other += step.cycle == next ? 0. : 1.;
        result[step.step] = &step;
      }
    verdict(what + ": numbers of cycles", other, 0.);
    return result;
  }

  /// Every step has cycles of its own, which begin with the mesh of the step
  /// before: under the same load the same within the target, whatever was
  /// between.
  void
  check_steps(const Settings &shells)
  {
    const auto steps =
      run_scene(two_layers(true),
                target(1e-2) + shells +
                  Settings{"Steps/Step=1, 2, 3",
                           "Exact solution/Displacement=",
                           "Interface glue/Law=contact",
                           "Interface glue/Offset=0.02*(1 - (t - 2)^2)"})
        .steps;
    auto last = last_cycles("steps", steps);
    for (const auto &[number, step] : last)
      {
        verdict("steps: time", std::fabs(*step->time - step->step), 1e-12);
        verdict("steps: estimate", *step->adaptivity->estimate, 1e-2);
      }
    verdict("steps: number", std::fabs(last.size() - 3.), 0.);
    verdict("steps: later ones need fewer cycles",
            last[3]->cycle < last[1]->cycle ? 0. : 1.,
            0.);
    verdict("steps: less pressure in the second",
            last[2]->interfaces[0].contact->pressure_mean <
                0.9 * last[1]->interfaces[0].contact->pressure_mean ?
              0. :
              1.,
            0.);
    verdict("steps: pressure",
            std::fabs(last[3]->interfaces[0].contact->pressure_mean /
                        last[1]->interfaces[0].contact->pressure_mean -
                      1.),
            1e-2);
  }

  /// A concentrated solution moves along a body and over a tie: cells are
  /// refined where it is, and merged where it was. Each first cycle has an
  /// estimate.
  void
  check_moving()
  {
    constexpr double error = 0.03;
    std::ifstream    file(std::filesystem::path(__FILE__).parent_path() /
                       "../field/bump_moves_over_a_tie.prm");
    const auto       steps =
      run_scene(std::string(std::istreambuf_iterator<char>(file), {}), {})
        .steps;
    auto         last  = last_cycles("moving", steps);
    unsigned int least = steps.front().bodies[0].cells, most = 0;
    for (const StepSummary &step : steps)
      if (step.step > 1 && step.cycle == 0)
        {
          verdict("moving: estimate of a first cycle by error",
                  *step.adaptivity->effectivity,
                  2.);
          verdict("moving: error by estimate of a first cycle",
                  1. / *step.adaptivity->effectivity,
                  1.5);
        }
    for (const auto &[number, step] : last)
      {
        verdict("moving: error", *step->errors->energy, error);
        most = std::max<unsigned int>(most, step->bodies[0].cells);
      }
    verdict("moving: cells of the left body are merged behind it",
            double(last[5]->bodies[0].cells - least) / (most - least),
            0.6);
  }

  /// A block pressed on a part of another: faces beside it become smaller than
  /// what it moves, and still it is looked for.
  void
  check_search()
  {
    const auto box = [](const std::string &name,
                        const std::string &extent,
                        const std::string &boundary) {
      return "subsection Body " + name +
             "\nset Degree = 1\nsubsection Mesh\nset Source = box\nset Extent = " +
             extent +
             "\nset Subdivisions = 1, 1, 1\nend\nsubsection Material\n"
             "set Young modulus = 1\nset Poisson ratio = 0.3\nend\n" +
             boundary + "end\n";
    };
    const std::string text =
      "set Bodies = lower, upper\nset Interfaces = touch\n" +
      box("lower",
          "0, 0, 0, 2, 1, 1",
          "subsection Boundary zmin\nset Displacement = 0, 0, 0\nend\n") +
      box("upper",
          "0, 0, 1, 1, 1, 2",
          "subsection Boundary zmax\nset Displacement = 0, 0, -0.3\nend\n") +
      "subsection Interface touch\nset Slave = lower: zmax\n"
      "set Master = upper: zmin\nset Law = contact\nend\n";
    const auto steps =
      run_scene(text,
                target(1e-3) +
                  Settings{"Adaptivity/Strategy=h",
                           "Adaptivity/Largest number of unknowns=2e4"})
        .steps;
    // with halvings of cells of sides 1 and 2 faces are small enough
    verdict("search: cells", 512. / steps.back().bodies[0].cells, 1.);
    verdict("search: motion",
            0.2 / steps.back().interfaces[0].contact->motion_max,
            1.);
  }

  /// Seven cubes, the upper three as tetrahedra that gmsh makes.
  void
  check_new_meshes()
  {
    const auto    top = std::filesystem::path(__FILE__).parent_path() / "../..";
    std::ifstream file(top / "prm/fichera.prm");
    const Settings coarse = {"Body lower/Degree=1",
                             "Body lower/Mesh/Subdivisions=2, 2, 1",
                             "Body lower/Mesh/Refine near=",
                             "Body upper/Degree=1",
                             "Body upper/Mesh/Refinements=0",
                             "Body upper/Mesh/Refine near=",
                             "Body upper/Mesh/Mesh size=0.7",
                             "Body upper/Mesh/File=" +
                               (top / "meshes/l_shape_tet.geo").string()};
    check("new meshes at a corner",
          std::string(std::istreambuf_iterator<char>(file), {}),
          1e-2,
          coarse);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Settings shells = {"Body inner/Mesh/Subdivisions=3, 1",
                           "Body outer/Mesh/Subdivisions=4, 2"};
  check("spheres", two_layers(true), 1e-4, shells);
  check("spheres from degree 2",
        two_layers(true),
        1e-4,
        shells + Settings{"Body inner/Degree=2", "Body outer/Degree=2"});
  check("spheres, tetrahedra",
        two_layers(true),
        1e-3,
        shells + Settings{"Body inner/Mesh/Cells=tetrahedra",
                          "Body outer/Mesh/Cells=tetrahedra"});
  check("spheres, incompressible",
        two_layers(true),
        1e-3,
        shells + Settings{"Body inner/Degree=2",
                          "Body outer/Degree=2",
                          "Body inner/Material/Poisson ratio=0.5",
                          "Body outer/Material/Poisson ratio=0.5"});
  check("manufactured",
        manufactured(),
        1e-4,
        {"Body lower/Mesh/Subdivisions=3, 3, 1",
         "Body upper/Mesh/Subdivisions=2, 2, 2"});
  check("a part with a corner",
        two_boxes(),
        1e-2,
        {"Body lower/Mesh/Subdivisions=2, 2, 2",
         "Body upper/Mesh/Subdivisions=3, 3, 1",
         "Exact solution/Displacement=0.1*(x^2 + y^2 + z^2)^0.3; 0.05*(x^2 + "
         "y^2 + z^2)^0.3; 0"});

  check_coarse_slave();
  check_nearly_incompressible();
  check_smooth_first_rise(shells);
  check_new_meshes();
  check_search();

  const auto few =
    run_scene(two_layers(true),
              target(1e-6) + shells +
                Settings{"Adaptivity/Largest number of unknowns=5000"});
  verdict("few unknowns: told",
          few.status == "target not reached" ? 0. : 1.,
          0.);
  verdict("few unknowns", few.steps.back().dofs.displacement, 5000);
  const auto low =
    run_scene(two_layers(true),
              target(1e-4) + shells + // which higher degrees reach
                Settings{"Adaptivity/Largest degree=2",
                         "Adaptivity/Largest number of unknowns=20000"});
  verdict("low degrees: told",
          low.status == "target not reached" ? 0. : 1.,
          0.);
  verdict("low degrees", low.steps.back().bodies[0].degree_max, 2);
  check_steps(shells);
  check_moving();
  check_message("no degree left",
                two_layers(true),
                target(1e-2) + shells + Settings{"Adaptivity/Largest degree=1"},
                "above all degrees that are given");
}
