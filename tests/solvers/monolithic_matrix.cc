// Proves that the matrix of the direct solver is the operator that residuals
// are computed with, on every number of ranks: hexahedra and tetrahedra,
// hanging nodes, several degrees, mixed form, ties, what slides, springs, and a
// part of the multipliers, forces through other rows than the constraint's. It
// solves the last, which the iterative methods refuse.
#include <mortise/solvers/factorisation/monolithic_matrix.h>
#include <scenes/scene.h>

#include <cmath>

#include "scenes/active_sets.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  /// Numbers that do not depend on the ranks, zero where the matrix has its
  /// diagonal alone.
  SystemVector
  unknowns(const BlockSystem &system)
  {
    SystemVector x   = system.zero_vector();
    const auto   set = [](mortise::Vector &v, const double shift) {
      for (const auto i : v.locally_owned_elements())
        v(i) = std::sin(12.9898 * i + shift);
    };
    set(x.displacement, 1.);
    const MultigridLevel &level = system.bulk->levels().front();
    for (const unsigned int index : level.constrained)
      x.displacement.begin()[index] = 0.;
    if (system.mixed())
      {
        set(x.pressure, 2.);
        const auto nodes = system.bulk->pressure()->nodes();
        for (const auto &line : nodes.space.hanging_nodes().get_lines())
          if (nodes.layout.in_local_range(line.index))
            x.pressure.begin()[nodes.layout.global_to_local(line.index)] = 0.;
      }
    if (x.multiplier.size() > 0)
      {
        set(x.multiplier, 3.);
        system.clear_inactive(x.multiplier);
      }
    return x;
  }

  enum Part
  {
    all,
    half
  };

  void
  select_half(Discretisation &discretisation)
  {
    std::vector<bool> active;
    for (const auto i : discretisation.linear_system().owned_multiplier)
      active.push_back(i % 2 == 0);
    discretisation.select(active);
  }

  /// Frames whose entries are the constraint's but for factors from 0.5 to 1.5.
  void
  act_through_others(Discretisation &discretisation)
  {
    const SparseMatrix &frames =
      discretisation.linear_system().constraint.frames();
    SparseMatrix others = frames;
    others.for_each_entry(
      [&](const unsigned int row, const auto column, double &value) {
        value *= 1. + 0.5 * std::sin(3. * frames.global_row(row) +
                                     7. * frames.global_column(column));
      });
    discretisation.act_through(std::move(others));
  }

  void
  check(const std::string &name, const Discretisation &discretisation)
  {
    const BlockSystem   &system = discretisation.linear_system();
    const ScaledResidual residual(system);
    const SparseMatrix   matrix =
      monolithic_matrix(system, residual, MonolithicNumbering(system));
    const SystemVector x = unknowns(system);
    SystemVector       r = system.zero_vector();
    residual.compute(system.zero_vector(), x, r);

    std::vector<double> v, product(matrix.n_rows());
    for (const auto *part : {&x.displacement, &x.pressure, &x.multiplier})
      for (unsigned int i = 0; i < part->locally_owned_size(); ++i)
        v.push_back(part->local_element(i));
    matrix.vmult(product.data(), v.data());
    double       error = 0., largest = 0.;
    unsigned int next = 0;
    for (const auto *part : {&r.displacement, &r.pressure, &r.multiplier})
      for (unsigned int i = 0; i < part->locally_owned_size(); ++i, ++next)
        {
          error   = std::max(error, std::abs(product[next] + part->begin()[i]));
          largest = std::max(largest, std::abs(product[next]));
        }
    largest = dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
    verdict(name + ", 1e-13", error / largest, 1e-13);
  }

  EquationsOfScene
  equations(const std::string &text, const Settings &settings)
  {
    return {text, settings + Settings{"Solver/Method=direct"}, MPI_COMM_WORLD};
  }

  void
  check(const std::string &name,
        const std::string &text,
        const Settings    &settings,
        const Part         part = all)
  {
    EquationsOfScene scene = equations(text, settings);
    if (part == half)
      select_half(scene.discretisation);
    check(name, scene.discretisation);
  }

  /// Multipliers that act through rows which are not those of the constraint.
  void
  check_other_forces(const std::string &text, const Settings &settings)
  {
    EquationsOfScene   scene  = equations(text, settings);
    const BlockSystem &system = scene.discretisation.linear_system();
    act_through_others(scene.discretisation);
    check("other forces", scene.discretisation);
    SolverOptions options;
    options.method           = SolverMethod::direct;
    const auto        direct = make_linear_solver(system, options);
    SystemVector      x;
    const SolveReport report = direct->solve(scene.load.rhs, x);
    verdict(report.converged && x.multiplier.l2_norm() > 0.,
            "other forces: solved");
    const ScaledResidual residual(system);
    SystemVector         r = system.zero_vector();
    residual.compute(scene.load.rhs, x, r);
    verdict("other forces: equations, 1e-11",
            residual.norm(r) / residual.norm(scene.load.rhs),
            1e-11);
    for (const auto &[method, name] :
         {std::pair{SolverMethod::condensed, "condensed"},
          std::pair{SolverMethod::saddle_point, "saddle point"}})
      {
        options.method    = method;
        const auto solver = make_linear_solver(system, options);
        check_message(std::string("other forces: refused by ") + name,
                      [&, &solver = solver] { solver->update(); },
                      {"Solver/Method = ",
                       "symmetric system; allowed: direct"});
      }
    select_half(scene.discretisation);
    check("other forces, a half", scene.discretisation);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const auto both = [](const std::string &setting) {
    return Settings{"Body inner/" + setting, "Body outer/" + setting};
  };
  const Settings meshes    = {"Body inner/Mesh/Subdivisions=2, 1",
                              "Body outer/Mesh/Subdivisions=3, 1"},
                 refined   = {"Body outer/Mesh/Refine near=2, 0, 0, 0.8, 1"},
                 shapes    = both("Mesh/Cells=tetrahedra");
  const std::string sphere = two_layers(true);
  for (const unsigned int p : {1, 2, 4})
    {
      const Settings    degree = meshes + both("Degree=" + std::to_string(p));
      const std::string name   = ", p = " + std::to_string(p);
      check("hexahedra" + name, sphere, degree);
      check("hanging nodes" + name, sphere, degree + refined);
      check("tetrahedra" + name, sphere, degree + shapes);
      if (p == 1)
        continue;
      const Settings mixed =
        degree + both("Formulation=mixed") + both("Material/Poisson ratio=0.5");
      check("mixed form, hanging nodes" + name, sphere, mixed + refined);
      check("mixed form, tetrahedra" + name, sphere, mixed + shapes);
    }
  const Settings p_2 = meshes + both("Degree=2");
  check("slide", sphere, p_2 + Settings{"Interface glue/Law=slide"});
  check("slide, a half",
        sphere,
        p_2 + Settings{"Interface glue/Law=slide"},
        half);
  check("tie, a half", sphere, p_2, half);
  check("spring",
        sphere,
        p_2 + Settings{"Interface glue/Law=spring",
                       "Interface glue/Normal stiffness=20",
                       "Interface glue/Tangential stiffness=5"});
  check_other_forces(sphere, p_2 + Settings{"Interface glue/Law=slide"});
}
