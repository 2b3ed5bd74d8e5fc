// Proves that forces on boundaries are those of the balance: exact where the
// elements hold the solution, whatever boundaries share; in balance for each
// body on any mesh and of any degree, with every law of interfaces, loads of
// every kind and supports; that interfaces tell what they carry; and that a
// target of a reaction that equilibrium gives is met at once. The same on any
// number of ranks.
#include <deal.II/base/quadrature_lib.h>

#include <array>

#include "scene.h"
#include "scenes.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  using Vector3 = dealii::Tensor<1, 3>;

  const Settings accurate = {"Solver/Tolerance=1e-12"};

  const Settings boxes = {"Body lower/Mesh/Subdivisions=2, 2, 2",
                          "Body upper/Mesh/Subdivisions=3, 2, 1"};

  Vector3
  vector(const std::vector<double> &values)
  {
    Vector3 result;
    for (unsigned int c = 0; c < 3; ++c)
      result[c] = values.at(c);
    return result;
  }

  Vector3
  quantity(const StepSummary &step, const std::string &name)
  {
    for (const auto &[key, values] : step.quantities)
      if (key == name)
        return vector(values);
    throw std::runtime_error("no quantity " + name);
  }

  /// "zmin of lower: lower: zmin; ..."
  std::string
  resultants(const std::vector<std::string> &bodies,
             const std::vector<std::string> &boundaries)
  {
    std::string text;
    for (const std::string &body : bodies)
      for (const std::string &boundary : boundaries)
        text += (text.empty() ? "Output/Resultants=" : "; ") + boundary +
                " of " + body + ": " + body + ": " + boundary;
    return text;
  }

  const std::vector<std::string> faces =
    {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};

  /// Stress of u = (x^2 + y z, x y + z^2 / 2, z^2 - x z) / 10 in the bodies of
  /// scenes.h.
  dealii::SymmetricTensor<2, 3>
  quadratic_stress(const dealii::Point<3> &x)
  {
    dealii::Tensor<2, 3> gradient;
    gradient[0] = Vector3({2. * x[0], x[2], x[1]});
    gradient[1] = Vector3({x[1], x[0], x[2]});
    gradient[2] = Vector3({-x[2], 0., 2. * x[2] - x[0]});
    gradient *= 0.1;
    const double lambda = 900. * 0.25 / (1.25 * 0.5), mu = 900. / 2.5;
    return lambda * dealii::trace(gradient) *
             dealii::unit_symmetric_tensor<3>() +
           2. * mu * dealii::symmetrize(gradient);
  }

  /// Force on face @p f of the box @p low to @p high, and its moment about @p about.
  std::array<Vector3, 2>
  exact_force(const dealii::Point<3> &low,
              const dealii::Point<3> &high,
              const unsigned int      f,
              const dealii::Point<3> &about)
  {
    const unsigned int      d = f / 2, a = (d + 1) % 3, b = (d + 2) % 3;
    const dealii::QGauss<2> rule(3);
    std::array<Vector3, 2>  result;
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        dealii::Point<3> x;
        x[d] = f % 2 == 0 ? low[d] : high[d];
        x[a] = low[a] + rule.point(q)[0] * (high[a] - low[a]);
        x[b] = low[b] + rule.point(q)[1] * (high[b] - low[b]);
        Vector3 normal;
        normal[d]           = f % 2 == 0 ? -1. : 1.;
        const Vector3 force = quadratic_stress(x) * normal * rule.weight(q) *
                              (high[a] - low[a]) * (high[b] - low[b]);
        result[0] += force;
        result[1] += dealii::cross_product_3d(x - about, force);
      }
    return result;
  }

  void
  check_exact(const std::string &what, const Settings &settings)
  {
    const dealii::Point<3> about(0.3, -2., 1.);
    const StepSummary      step =
      run_scene(two_boxes(),
                accurate + boxes +
                  Settings{"Exact solution/Displacement=0.1*(x^2 + y*z); "
                           "0.1*(x*y + z^2/2); 0.1*(z^2 - x*z)",
                           "Body lower/Body force=auto",
                           "Body upper/Body force=auto",
                           resultants({"lower", "upper"}, faces),
                           "Output/Moments about=0.3, -2, 1"} +
                  settings)
        .steps.back();
    double force = 0., moment = 0.;
    for (const std::string body : {"lower", "upper"})
      for (unsigned int f = 0; f < 6; ++f)
        {
          const double bottom = body == "lower" ? 0. : 0.5;
          const auto   exact =
            exact_force({0., 0., bottom}, {1., 1., bottom + 0.5}, f, about);
          const std::string name = faces[f] + " of " + body;
          force = std::max(force, (quantity(step, name) - exact[0]).norm());
          moment =
            std::max(moment,
                     (quantity(step, name + ", moment") - exact[1]).norm());
        }
    verdict(what + ": forces of 100 1e-7", force, 1e-7);
    verdict(what + ": moments 3e-7", moment, 3e-7);
  }

  /// Of each of @p bodies, without forces in their volume.
  void
  check_balance(const std::string              &what,
                const std::string              &text,
                const Settings                 &settings,
                const std::vector<std::string> &boundaries)
  {
    const StepSummary step =
      run_scene(text,
                settings + accurate +
                  Settings{resultants({"inner", "outer"}, boundaries)})
        .steps.back();
    double size = 0., worst = 0.;
    for (const std::string body : {"inner", "outer"})
      {
        Vector3 sum;
        for (const std::string &boundary : boundaries)
          {
            const Vector3 force = quantity(step, boundary + " of " + body);
            sum += force;
            size = std::max(size, force.norm());
          }
        worst = std::max(worst, sum.norm());
      }
    verdict(what + ": something acts", size > 1e-4 ? 0. : 1., 0.);
    verdict(what + ": each body 1e-8", worst / size, 1e-8);
    verdict(what + ": all 1e-8",
            vector(step.equilibrium->sum).norm() / size,
            1e-8);
    const InterfaceSummary &glue = step.interfaces.front();
    verdict(what + ": carried, as the slave has it 1e-8",
            (vector(glue.force) + quantity(step, "outside of inner")).norm() /
              size,
            1e-8);
    verdict(what + ": carried, as the master has it 1e-8",
            (vector(glue.force) - quantity(step, "inside of outer")).norm() /
              size,
            1e-8);
  }

  void
  check_balances()
  {
    const Settings coarse = {"Body inner/Mesh/Subdivisions=2, 1",
                             "Body outer/Mesh/Subdivisions=3, 1"};
    const std::vector<std::string> sphere = {
      "inside", "outside", "xmin", "ymin", "zmin"};
    const auto check = [&](const std::string &what, const Settings &settings) {
      check_balance(what, two_layers(true), coarse + settings, sphere);
    };
    for (const std::string p : {"1", "2", "3"})
      check("tie, degree " + p,
            {"Body inner/Degree=" + p, "Body outer/Degree=" + p});
    check("slide",
          {"Interface glue/Law=slide", "Exact solution/Displacement="});
    check("spring",
          {"Interface glue/Law=spring",
           "Interface glue/Normal stiffness=20",
           "Interface glue/Tangential stiffness=5",
           "Exact solution/Displacement="});
    check("contact",
          {"Interface glue/Law=contact",
           "Interface glue/Offset=-0.01",
           "Body inner/Degree=2"});
    check("tetrahedra",
          {"Body inner/Mesh/Cells=tetrahedra",
           "Body outer/Mesh/Cells=tetrahedra",
           "Body outer/Degree=2"});
    check("incompressible",
          {"Body inner/Degree=2",
           "Body outer/Degree=2",
           "Body inner/Material/Poisson ratio=0.5",
           "Body outer/Material/Poisson ratio=0.5"});
    check("hanging nodes and degrees",
          {"Body inner/Mesh/Refine near=1, 0, 0, 0.3, 2",
           "Body inner/Degree near=1, 0, 0, 0.1, 4",
           "Body inner/Degree=2"});
    check("thermal",
          {"Body inner/Temperature=10*x",
           "Body inner/Material/Thermal expansion=1e-3",
           "Exact solution/Displacement="});
  }

  /// A block in two parts under its weight and other loads, beside inclined
  /// rollers.
  void
  check_loads()
  {
    const std::string text =
      tied("lower, upper", "lower: zmax", "upper: zmin") +
      box("lower", "0, 0, 0, 1, 1, 0.5", "", "") +
      box("upper", "0, 0, 0.5, 1, 1, 1", "", "");
    const StepSummary step =
      run_scene(text,
                accurate + boxes +
                  Settings{"Gravity=1; 0; -10",
                           "Body lower/Material/Density=2",
                           "Body upper/Body force=0; 3; 0",
                           "Body upper/Boundary zmax/Force=0; 1; -2",
                           "Body upper/Boundary zmax/Moment=0.1; 0; 0.2",
                           "Body upper/Boundary xmax/Pressure=4",
                           "Body lower/Mesh/Rotate=0, 0, 30",
                           "Body upper/Mesh/Rotate=0, 0, 30",
                           "Body lower/Boundary zmin/Displacement=0, 0, 0",
                           "Body upper/Boundary ymin/Displacement=normal: 0",
                           "Output/Resultants=base: lower: zmin; side: "
                           "upper: ymin; top: upper: zmax"})
        .steps.back();
    const double  c = std::cos(dealii::numbers::PI / 6.), s = 0.5;
    const Vector3 applied({1. - 2. * c, 1.5 + 1. - 2. * s, -10. - 2.});
    verdict("loads: applied 1e-12",
            (vector(step.equilibrium->applied) - applied).norm(),
            1e-12);
    verdict("loads: reactions 1e-9",
            (vector(step.equilibrium->reactions) + applied).norm(),
            1e-9);
    const Vector3 side = quantity(step, "side");
    verdict("loads: supports 1e-9",
            (quantity(step, "base") + side + applied).norm(),
            1e-9);
    verdict("loads: rollers 1e-9", std::fabs(side * Vector3({c, s, 0.})), 1e-9);
    verdict("loads: top 1e-12",
            (quantity(step, "top") - Vector3({0., 1., -2.})).norm(),
            1e-12);
  }

  /// A force beside a column, which its foot bears with a moment.
  void
  check_moments()
  {
    const StepSummary step =
      run_scene(tied("lower, upper", "upper: zmin", "lower: zmax") +
                  box("lower", "0, 0, 0, 1, 1, 0.5", "", "") +
                  box("upper", "0, 0, 0.5, 1, 1, 2", "", ""),
                accurate + boxes +
                  Settings{"Body lower/Boundary zmin/Displacement=0, 0, 0",
                           "Body upper/Boundary zmax/Traction=10; 0; 4",
                           "Output/Resultants=foot: lower: zmin",
                           "Output/Moments about=0.5, 0.5, 1"})
        .steps.back();
    const Vector3 force({10., 0., 4.}), moment({0., 10., 0.});
    verdict("foot: force 1e-9", (quantity(step, "foot") + force).norm(), 1e-9);
    verdict("foot: moment 1e-9",
            (quantity(step, "foot, moment") + moment).norm(),
            1e-9);
    const InterfaceSummary &glue = step.interfaces.front();
    verdict("tie: force 1e-9", (vector(glue.force) - force).norm(), 1e-9);
    verdict("tie: moment 1e-9", (vector(glue.moment) - moment).norm(), 1e-9);
    verdict("tie: area 1e-12", std::fabs(glue.covered_area - 1.), 1e-12);
  }

  void
  check_target()
  {
    const Settings of = {"Body lower/Boundary zmin/Displacement=0, 0, 0",
                         "Body upper/Boundary zmax/Traction=10; 0; 4",
                         "Output/Resultants=foot: lower: zmin",
                         "Adaptivity/Quantity=foot, x",
                         "Adaptivity/Target error=1e-6"};
    const Summary  summary =
      run_scene(tied("lower, upper", "upper: zmin", "lower: zmax") +
                  box("lower", "0, 0, 0, 1, 1, 0.5", "", "") +
                  box("upper", "0, 0, 0.5, 1, 1, 2", "", ""),
                boxes + of);
    verdict("target: met", summary.status == "done" ? 0. : 1., 0.);
    verdict("target: in the second cycle", summary.steps.size(), 2.);
    verdict("target: value",
            std::fabs(*summary.steps.back().adaptivity->value + 10.),
            1e-5);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_exact("hexahedra",
              {"Body lower/Degree=2",
               "Body upper/Degree=2",
               "Body lower/Mesh/Subdivisions=2, 2, 1",
               "Body upper/Mesh/Subdivisions=3, 2, 2"});
  check_exact("hexahedra of degrees 3 and 4, hanging nodes",
              {"Body lower/Degree=3",
               "Body upper/Degree=4",
               "Body lower/Mesh/Refine near=0, 0, 0, 0.4, 1",
               "Body lower/Degree near=1, 1, 0, 0.1, 5",
               "Body upper/Mesh/Subdivisions=2, 1, 1"});
  check_exact("tetrahedra",
              {"Body lower/Degree=3",
               "Body upper/Degree=3",
               "Body lower/Mesh/Cells=tetrahedra",
               "Body upper/Mesh/Cells=tetrahedra",
               "Body lower/Mesh/Subdivisions=2, 2, 1"});
  check_exact("mixed form",
              {"Body lower/Degree=3",
               "Body upper/Degree=3",
               "Body lower/Formulation=mixed",
               "Body upper/Formulation=mixed"});
  check_balances();
  check_loads();
  check_moments();
  check_target();
}
