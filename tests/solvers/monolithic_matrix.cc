// Proves that the matrix of the direct solver is the operator that residuals
// are computed with, on every number of ranks: hexahedra and tetrahedra,
// hanging nodes, several degrees, mixed form, ties, what slides, springs, and a
// part of the multipliers, directions turned as by friction, and forces through
// other rows than the constraint's. All methods solve the last.
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

  std::vector<bool>
  active_ones(const Discretisation &discretisation, const Part part)
  {
    std::vector<bool> active;
    for (const auto i : discretisation.linear_system().owned_multiplier)
      active.push_back(part == all || i % 2 == 0);
    return active;
  }

  /// Turn the nodes of contact to the normal, a tangent and what is across,
  /// which has a compliance, and scale their multipliers. @p friction: of the pressure acts along the
  /// tangent; without, the system stays symmetric.
  void
  turn_nodes(Discretisation &discretisation,
             const double    friction,
             const Part      part)
  {
    const BlockSystem               &system = discretisation.linear_system();
    const auto                      &owned  = system.owned_multiplier;
    std::vector<SparseMatrix::Entry> turn, inverse, of_forces;
    std::vector<double>              compliance(owned.n_elements(), 0.);
    for (const ContactNode *node : discretisation.interfaces().contact_nodes())
      {
        const unsigned int m = node->n_multipliers;
        // any tangent; the identity where components are prescribed
        std::array<dealii::Tensor<1, dim>, dim> rows{
          {dealii::Tensor<1, dim>({1., 0., 0.}),
           dealii::Tensor<1, dim>({0., 1., 0.}),
           dealii::Tensor<1, dim>({0., 0., 1.})}};
        if (m == dim)
          {
            rows[0] = node->normal;
            rows[1] = dealii::cross_product_3d(
              node->normal, dealii::Tensor<1, dim>({0.3, -0.5, 0.2}));
            rows[1] /= rows[1].norm();
            rows[2] = dealii::cross_product_3d(rows[0], rows[1]);
            compliance[node->multipliers[2]] = 0.1 * node->area;
          }
        for (unsigned int r = 0; r < m; ++r)
          for (unsigned int c = 0; c < m; ++c)
            {
              const auto row    = owned.nth_index_in_set(node->multipliers[r]),
                         column = owned.nth_index_in_set(node->multipliers[c]);
              // as the areas of components differ
              const double share = 1. + 0.2 * std::sin(3. * column);
              turn.push_back({row, column, share * rows[r][c]});
              inverse.push_back({row, column, rows[r][c] / share});
              of_forces.push_back(
                {row,
                 column,
                 share * (rows[r][c] +
                          (m == dim && r == 0 ? friction * rows[1][c] : 0.))});
            }
      }
    const auto matrix = [&](const auto &entries) {
      return SparseMatrix(owned, owned, MPI_COMM_WORLD, entries);
    };
    std::optional<SparseMatrix> forces;
    if (friction > 0.)
      forces = matrix(of_forces);
    discretisation.select(active_ones(discretisation, part),
                          matrix(turn),
                          matrix(inverse),
                          std::move(forces),
                          compliance);
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
      scene.discretisation.select(active_ones(scene.discretisation, part));
    check(name, scene.discretisation);
  }

  /// The solution in directions, of which LinearSolver::solve() makes
  /// multipliers; their inverse for a friction of the pressure along a tangent.
  double
  error_of_equations(const Discretisation &discretisation,
                     const SystemVector   &load,
                     const double          friction,
                     SystemVector          x)
  {
    const BlockSystem &system = discretisation.linear_system();
    SystemVector       rhs    = load;
    system.to_directions(rhs, x);
    system.clear_inactive(rhs.multiplier);
    for (const ContactNode *node : discretisation.interfaces().contact_nodes())
      if (node->n_multipliers == dim)
        x.multiplier.begin()[node->multipliers[1]] -=
          friction * x.multiplier.begin()[node->multipliers[0]];
    const ScaledResidual residual(system);
    SystemVector         r = system.zero_vector();
    residual.compute(rhs, x, r);
    return residual.norm(r) / residual.norm(rhs);
  }

  /// Solve a scene of turned nodes; @p exact: the multipliers of the first one.
  void
  solve(const std::string &text,
        const Settings    &settings,
        const SolverMethod method,
        const double       friction,
        const Part         part,
        mortise::Vector   &exact)
  {
    const std::string name = solver_method_names()[static_cast<int>(method)];
    EquationsOfScene  scene(text,
                           settings + Settings{"Solver/Method=" + name},
                           MPI_COMM_WORLD);
    turn_nodes(scene.discretisation, friction, part);
    const BlockSystem &system = scene.discretisation.linear_system();
    SolverOptions      options;
    options.method           = method;
    options.tolerance        = 1e-12;
    const auto        solver = make_linear_solver(system, options);
    SystemVector      x;
    const SolveReport report = solver->solve(scene.load.rhs, x);
    const std::string what =
      std::string("other forces") + (part == half ? ", a half, " : ", ") + name;
    verdict(report.converged && x.multiplier.l2_norm() > 0., what + ": solved");
    verdict(
      what + ": equations, 1e-11",
      error_of_equations(scene.discretisation, scene.load.rhs, friction, x),
      1e-11);
    if (exact.size() == 0)
      exact = x.multiplier;
    x.multiplier -= exact;
    verdict(what + ": the same multipliers, 1e-8",
            x.multiplier.l2_norm() / exact.l2_norm(),
            1e-8);
  }

  /// Multipliers in other directions, and such that act through rows which are
  /// not those of the constraint.
  void
  check_directions(const std::string &text, const Settings &settings)
  {
    constexpr double friction = 0.3;
    for (const Part part : {all, half})
      {
        const std::string of = part == half ? ", a half" : "";
        mortise::Vector   exact;
        EquationsOfScene  symmetric = equations(text, settings);
        turn_nodes(symmetric.discretisation, 0., part);
        check("turned" + of, symmetric.discretisation);
        EquationsOfScene   scene  = equations(text, settings);
        const BlockSystem &system = scene.discretisation.linear_system();
        turn_nodes(scene.discretisation, friction, part);
        check("other forces" + of, scene.discretisation);
        verdict(
          symmetric.discretisation.linear_system().has_symmetric_coupling() &&
            !system.has_symmetric_coupling(),
          "other forces" + of + ": symmetry is told");
        for (const SolverMethod method : {SolverMethod::direct,
                                          SolverMethod::saddle_point,
                                          SolverMethod::condensed})
          solve(text, settings, method, friction, part, exact);
      }
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
  check_directions(
    sphere,
    p_2 + Settings{"Interface glue/Law=contact",
                   "Interface glue/Friction coefficient=0.3",
                   "Body outer/Boundary outside/Displacement=0, 0, 0"});
}
