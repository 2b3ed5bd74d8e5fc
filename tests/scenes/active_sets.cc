// Proves that constraints hold on the multipliers that are active and on no
// other: the iterative solvers agree with the factorisation of the whole, keep
// to 12 iterations on what contact makes, and go on when the set grows.
#include "active_sets.h"

#include "scene.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  using Active = std::vector<bool>;

  class Scene
  {
  public:
    Scene(const std::string &name,
          const Settings    &settings,
          const std::string &method)
      : name(name)
      , equations(two_layers(true),
                  settings + Settings{"Solver/Method=" + method},
                  MPI_COMM_WORLD)
      , assembled(two_layers(true),
                  settings + Settings{"Solver/Method=direct"},
                  MPI_COMM_WORLD)
      , nodes(equations.discretisation.interfaces().contact_nodes())
      , iterative(solver(equations.discretisation))
      , direct(solver(assembled.discretisation))
    {}

    /// By multiplier, from the places of nodes.
    Active
    active(const PointSet &set) const
    {
      Active result(
        equations.discretisation.linear_system().owned_multiplier.n_elements());
      for (const ContactNode *node : nodes)
        for (unsigned int r = 0; r < node->n_multipliers; ++r)
          result[node->multipliers[r]] = set(node->position);
      return result;
    }

    /// @p anew: or only for what has changed.
    void
    check(const std::string &set_name,
          const PointSet    &set,
          const unsigned int max_iterations,
          const bool         anew = true)
    {
      chosen = active(set);
      equations.discretisation.select(chosen);
      if (anew)
        {
          std::vector<NodeStatus> statuses;
          for (const ContactNode *node : nodes)
            statuses.push_back(set(node->position) ? NodeStatus::stick :
                                                     NodeStatus::open);
          equations.discretisation.update_penalties(statuses);
          iterative->update();
        }
      else
        iterative->update_active();
      const SolveReport report = iterative->solve(equations.load.rhs, solution);
      verdict(name + ", " + set_name + ": iterations",
              report.converged ? report.iterations : 1000,
              max_iterations);
    }

    /// The last set with a factorisation of the whole, for which displacements
    /// are other coefficients.
    void
    compare()
    {
      SystemVector exact;
      assembled.discretisation.select(chosen);
      direct->update();
      direct->solve(assembled.load.rhs, exact);
      const double work =
                     solution.displacement * equations.load.rhs.displacement,
                   right = exact.displacement * assembled.load.rhs.displacement;
      verdict(name + ": work of the load 1e-9",
              std::fabs(work / right - 1.),
              1e-9);
      mortise::Vector error(solution.multiplier);
      error -= exact.multiplier;
      verdict(name + ": multipliers 1e-6",
              error.l2_norm() / exact.multiplier.l2_norm(),
              1e-6);
      double on_others = 0.;
      for (unsigned int i = 0; i < chosen.size(); ++i)
        if (!chosen[i])
          on_others = std::max(on_others,
                               std::fabs(solution.multiplier.begin()[i]) +
                                 std::fabs(exact.multiplier.begin()[i]));
      verdict(name + ": none where nothing is active",
              dealii::Utilities::MPI::max(on_others, MPI_COMM_WORLD),
              0.);
    }

  private:
    static std::unique_ptr<LinearSolver>
    solver(const Discretisation &discretisation)
    {
      SolverOptions options;
      options.method    = discretisation.choice().method;
      options.tolerance = 1e-8;
      return make_linear_solver(discretisation.linear_system(), options);
    }

    const std::string                name;
    EquationsOfScene                 equations, assembled;
    std::vector<const ContactNode *> nodes;
    std::unique_ptr<LinearSolver>    iterative, direct;
    Active                           chosen; ///< last
    SystemVector                     solution;
  };

  Settings
  settings(const bool has_friction, const unsigned int p, const std::string &nu)
  {
    Settings result{"Interface glue/Law=contact",
                    "Interface glue/Mesh gap=ignored",
                    std::string("Interface glue/Friction coefficient=") +
                      (has_friction ? "1" : ""),
                    "Exact solution/Displacement=",
                    "Body inner/Mesh/Subdivisions=3, 2",
                    "Body outer/Mesh/Subdivisions=4, 2"};
    for (const std::string body : {"inner", "outer"})
      {
        result.push_back("Body " + body + "/Degree=" + std::to_string(p));
        result.push_back("Body " + body + "/Material/Poisson ratio=" + nu);
      }
    return result;
  }

  void
  check(Scene &scene, const unsigned int max_iterations)
  {
    std::map<std::string, PointSet> sets;
    for (const auto &[name, set] : point_sets(true))
      sets[name] = set;
    for (const std::string set : {"all", "none", "disc 0.15", "disc 0.5"})
      scene.check(set, sets[set], max_iterations);
    scene.compare();
    scene.check("random half", sets["random half"], max_iterations + 2);
    scene.compare();
    scene.check("disc 0.3", sets["disc 0.3"], max_iterations);
    scene.check("grown to 0.32", sets["disc 0.32"], max_iterations, false);
    scene.compare();
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const bool has_friction : {true, false})
    for (const unsigned int p : {1, 3})
      {
        Scene scene((has_friction ? "friction, p = " : "no friction, p = ") +
                      std::to_string(p),
                    settings(has_friction, p, "0.3"),
                    "condensed");
        check(scene, 12);
      }
  Scene mixed("mixed form", settings(false, 2, "0.5"), "saddle point");
  check(mixed, 20);
}
