// Proves that interfaces which are paired again in a configuration x = X + u
// are those of a mesh that lies there: the same solution where one body is
// moved along the interface as where its mesh is, the same solution and
// tractions where all is moved or stretched together, since areas are those of
// undeformed slaves, and what was there before where nothing moves. Gaps of
// contact are those of all displacements, wherever pairs are found.
#include <deal.II/base/mpi.h>

#include <verdict.h>

#include <algorithm>
#include <cmath>

#include "scenes/active_sets.h"

using namespace dealii;
using namespace mortise;
using namespace mortise::testing;

namespace
{
  /// Two blocks of unlike meshes on each other, pressed together; the upper one
  /// lies aside by @p shift and higher by @p gap.
  std::string
  blocks(const std::string &law,
         const bool         tetrahedra,
         const double       shift,
         const double       gap = 0.)
  {
    const auto block = [&](const std::string &name,
                           const std::string &extent,
                           const std::string &cells,
                           const std::string &boundary) {
      return "subsection Body " + name +
             "\n  set Degree = 2\n  subsection Mesh\n    set Source = box\n"
             "    set Extent = " +
             extent + "\n    set Subdivisions = " + cells +
             (tetrahedra ? "\n    set Cells = tetrahedra" : "") +
             "\n    set Translate = " +
             (name == "upper" ? number(shift) + ", 0, " + number(gap) :
                                "0, 0, 0") +
             "\n  end\n  subsection Material\n    set Young modulus = 10\n"
             "  end\n" +
             boundary + "end\n";
    };
    const std::string top =
                        "  subsection Boundary zmax\n    set Displacement = "
                        "0.02, 0, -0.05\n  end\n",
                      bottom = "  subsection Boundary zmin\n    set "
                               "Displacement = 0, 0, 0\n  end\n";
    return "set Bodies = lower, upper\nset Interfaces = glue\n" +
           block("lower", "0, 0, 0, 3, 2, 1", "5, 3, 2", bottom) +
           block("upper", "0.5, 0.5, 1, 2, 1.5, 2", "4, 3, 2", top) +
           "subsection Interface glue\n  set Slave = upper: zmin\n"
           "  set Master = lower: zmax\n  set Law = " +
           law + "\nend\n";
  }

  using Field = std::function<Tensor<1, dim>(unsigned int, const Point<dim> &)>;

  /// A field that is linear in each body.
  std::vector<BodySolution>
  moved(const Bodies &bodies, const Field &field)
  {
    return linear_displacements(bodies,
                                [&](const unsigned int body,
                                    const unsigned int c,
                                    const Point<dim>  &x) {
                                  return field(body, x)[c];
                                });
  }

  SystemVector
  solve(const EquationsOfScene &scene, LinearSolver &solver)
  {
    SystemVector x;
    solver.solve(scene.discretisation.load(scene.fields()).rhs, x);
    return x;
  }

  double
  difference(const mortise::Vector &a, const mortise::Vector &b)
  {
    mortise::Vector d(a);
    d -= b;
    return d.l2_norm() / b.l2_norm();
  }

  double
  difference(const SystemVector &a, const SystemVector &b)
  {
    return std::max(difference(a.displacement, b.displacement),
                    difference(a.multiplier, b.multiplier));
  }

  void
  check(const std::string &law,
        const bool         tetrahedra,
        const std::string &method,
        const Settings    &settings = {})
  {
    const MPI_Comm    comm = MPI_COMM_WORLD;
    const std::string of =
      law + (tetrahedra ? ", tetrahedra" : ", hexahedra") + ", " + method;
    constexpr double shift = 0.3;
    EquationsOfScene scene(blocks(law, tetrahedra, 0.), settings, comm),
      there(blocks(law, tetrahedra, shift), settings, comm);
    scene.follow_bodies();
    SolverOptions options;
    options.tolerance = 1e-12;
    options.method    = solver_method_from_name(method);
    const auto solver =
      make_linear_solver(scene.discretisation.linear_system(), options);
    const auto solver_there =
      make_linear_solver(there.discretisation.linear_system(), options);
    const SystemVector first = solve(scene, *solver);

    const Bodies &bodies = scene.discretisation.bodies();
    scene.discretisation.pair(
      moved(bodies, [&](const unsigned int body, const Point<dim> &) {
        return Tensor<1, dim>({body == 1 ? shift : 0., 0., 0.});
      }));
    solver->update_interfaces();
    verdict(of + ": paired where the upper block has moved to",
            difference(solve(scene, *solver), solve(there, *solver_there)),
            1e-9);

    // a rotation about the z axis and a translation
    const double angle = 0.7;
    scene.discretisation.pair(
      moved(bodies, [&](const unsigned int, const Point<dim> &x) {
        return Tensor<1, dim>(
          {std::cos(angle) * x[0] - std::sin(angle) * x[1] - x[0] + 5.,
           std::sin(angle) * x[0] + std::cos(angle) * x[1] - x[1] - 2.,
           3.});
      }));
    solver->update_interfaces();
    verdict(of + ": paired where both have moved together",
            difference(solve(scene, *solver), first),
            1e-9);

    scene.discretisation.pair(
      moved(bodies, [&](const unsigned int, const Point<dim> &x) {
        return Tensor<1, dim>(
          {x[0] + 0.4 * x[1], -0.3 * x[1] + 0.2 * x[0], 0.5 * (x[2] - 1.)});
      }));
    solver->update_interfaces();
    verdict(of + ": paired where both have been stretched together",
            difference(solve(scene, *solver), first),
            1e-9);

    scene.discretisation.pair(zero_solutions(bodies));
    solver->update_interfaces();
    verdict(of + ": paired where nothing has moved",
            difference(solve(scene, *solver), first),
            1e-9);
  }

  double
  largest(const std::vector<double> &values, const MPI_Comm comm)
  {
    double result = 0.;
    for (const double value : values)
      result = std::max(result, std::fabs(value));
    return Utilities::MPI::max(result, comm);
  }

  void
  check_gaps(const bool tetrahedra)
  {
    constexpr double gap  = 0.1;
    const MPI_Comm   comm = MPI_COMM_WORLD;
    EquationsOfScene scene(blocks("contact", tetrahedra, 0., gap),
                           {"Interface glue/Offset=0.01*x + 0.02*y"},
                           comm);
    scene.follow_bodies();
    const std::string of =
      std::string("gaps, ") + (tetrahedra ? "tetrahedra" : "hexahedra");
    Discretisation &discretisation = scene.discretisation;
    const auto      gaps_of        = [&](const Field &field) {
      const SceneLoad load = discretisation.load(scene.fields());
      return discretisation.gaps(discretisation.weighted_gaps(
        load,
        discretisation.system_vector(moved(discretisation.bodies(), field),
                                     load)));
    };
    const auto difference_to = [&](std::vector<double>        values,
                                   const std::vector<double> &others) {
      for (unsigned int i = 0; i < values.size(); ++i)
        values[i] -= others[i];
      return largest(values, comm);
    };
    const Field any = [](const unsigned int body, const Point<dim> &x) {
      return Tensor<1, dim>({0.1 * x[0] - 0.3 * x[1],
                             0.2 * x[2],
                             (body == 1 ? 0.07 : 0.02) * x[0] - 0.05 * x[1]});
    };
    const Field nothing = [](const unsigned int, const Point<dim> &) {
      return Tensor<1, dim>();
    };
    const auto places = [&] {
      std::vector<double> result;
      for (const ContactNode *node :
           discretisation.interfaces().contact_nodes())
        for (unsigned int c = 0; c < dim; ++c)
          result.push_back(node->position[c]);
      return result;
    };
    const std::vector<double> first = gaps_of(any), start = gaps_of(nothing),
                              at = places();
    discretisation.pair(
      moved(discretisation.bodies(),
            [&](const unsigned int body, const Point<dim> &) {
              return Tensor<1, dim>({0., 0., body == 1 ? -0.6 * gap : 0.});
            }));
    verdict(of + ": paired where the upper block has come down",
            difference_to(gaps_of(any), first),
            1e-12);

    const double angle = 0.7;
    const Field  turn  = [&](const unsigned int, const Point<dim> &x) {
      return Tensor<1, dim>(
        {5.,
         std::cos(angle) * x[1] - std::sin(angle) * x[2] - x[1],
         std::sin(angle) * x[1] + std::cos(angle) * x[2] - x[2] - 3.});
    };
    discretisation.pair(moved(discretisation.bodies(), turn));
    verdict(of + ": those of the start where both have turned together",
            difference_to(gaps_of(turn), start),
            1e-12);
    verdict(of + ": nodes are where they are in the undeformed body",
            difference_to(places(), at),
            1e-12);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const bool tetrahedra : {false, true})
    for (const std::string law : {"tie", "slide"})
      check(law, tetrahedra, "condensed");
  for (const std::string method : {"saddle point", "direct"})
    check("slide", false, method);
  for (const bool tetrahedra : {false, true})
    check_gaps(tetrahedra);
  check("tie",
        false,
        "saddle point",
        {"Body lower/Formulation=mixed", "Body upper/Formulation=mixed"});
}
