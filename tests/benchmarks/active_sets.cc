// Iterations where constraints hold on a part of the multipliers' nodes:
// active_sets [NAME=VALUE]... prints one line for each set: iterations, seconds
// of the setup with that set and of the solve. scene=sphere|blocks p=2
// law=tie|slide contrast=1 (modulus of the slave over the master's) fine=0
// (cells of the slave for each of the master's, in a line; 0: about 3 : 2) n=4
// (cells in a line) nu=0.3 tolerance=1e-8
#include "scenes/active_sets.h"

#include <deal.II/base/mpi.h>

#include <iomanip>
#include <iostream>
#include <map>

using namespace dealii;
using namespace mortise;
using namespace mortise::testing;

namespace
{
  using Options = std::map<std::string, std::string>;

  Settings
  settings_of(const Options &given, std::string &text)
  {
    const bool sphere = given.at("scene") == "sphere";
    const int  n = std::stoi(given.at("n")), fine = std::stoi(given.at("fine"));
    const std::string slave  = sphere ? "inner" : "lower",
                      master = sphere ? "outer" : "upper";
    const int  m             = fine > 0 ? std::max(1, n / fine) : 3 * n / 2;
    const auto cells         = [&](const int k) {
      const std::string one  = std::to_string(k),
                        half = std::to_string(std::max(1, k / 2));
      return sphere ? one + ", " + half : one + ", " + one + ", " + half;
    };
    text = sphere ? two_layers(true) : manufactured();
    // the nodes of a tie are those of contact that sticks
    Settings settings{"Interface glue/Law=contact",
                      "Interface glue/Mesh gap=ignored",
                      std::string("Interface glue/Friction coefficient=") +
                        (given.at("law") == "tie" ? "1" : ""),
                      "Body " + slave + "/Mesh/Subdivisions=" + cells(n),
                      "Body " + master + "/Mesh/Subdivisions=" + cells(m),
                      "Body " + slave + "/Material/Young modulus=" +
                        number(10. * std::stod(given.at("contrast")))};
    for (const std::string &body : {slave, master})
      {
        settings.push_back("Body " + body + "/Degree=" + given.at("p"));
        settings.push_back("Body " + body +
                           "/Material/Poisson ratio=" + given.at("nu"));
        if (!sphere)
          {
            settings.push_back("Body " + body + "/Body force=0, 0, 1");
            // what cannot change its volume goes out at one side
            const bool open = std::stod(given.at("nu")) >= 0.49;
            for (const std::string side : {"xmin", "xmax", "ymin", "ymax"})
              settings.push_back("Body " + body + "/Boundary " + side +
                                 "/Displacement=" +
                                 (open && side == "xmax" ? "-, -, -" :
                                  side[0] == 'x'         ? "0, -, -" :
                                                           "-, 0, -"));
          }
      }
    settings.push_back("Exact solution/Displacement=");
    settings.push_back(
      std::string("Solver/Method=") +
      (std::stod(given.at("nu")) < 0.49 ? "condensed" : "saddle point"));
    if (!sphere)
      {
        settings.push_back("Body lower/Boundary zmin/Displacement=-, -, 0");
        settings.push_back("Body upper/Boundary zmax/Displacement=-, -, 0.01");
        settings.push_back("Body upper/Boundary zmax/Traction=");
      }
    return settings;
  }

  void
  run(const Options &given, const MPI_Comm comm)
  {
    std::string      text;
    const Settings   settings = settings_of(given, text);
    EquationsOfScene scene(text, settings, comm);
    Discretisation  &discretisation = scene.discretisation;
    SolverOptions    options;
    options.method    = discretisation.choice().method;
    options.tolerance = std::stod(given.at("tolerance"));
    auto solver = make_linear_solver(discretisation.linear_system(), options);
    const auto nodes = discretisation.interfaces().contact_nodes();
    auto       sets  = point_sets(given.at("scene") == "sphere");
    // the node nearest to the centre of the discs, if that is one node
    double nearest = 1e300;
    for (const ContactNode *node : nodes)
      nearest =
        std::min(nearest, node->position.distance(Point<dim>(0.6, 0.7, 0.9)));
    nearest = Utilities::MPI::min(nearest, comm);
    sets.emplace_back("one node", [=](const Point<dim> &place) {
      return place.distance(Point<dim>(0.6, 0.7, 0.9)) < nearest * (1. + 1e-9);
    });
    for (const auto &[name, set] : sets)
      {
        std::vector<bool> active(
          discretisation.linear_system().owned_multiplier.n_elements());
        std::vector<NodeStatus> statuses;
        for (const ContactNode *node : nodes)
          {
            const bool holds = set(node->position);
            statuses.push_back(holds ? NodeStatus::stick : NodeStatus::open);
            for (unsigned int r = 0; r < node->n_multipliers; ++r)
              active[node->multipliers[r]] = holds;
          }
        discretisation.select(active);
        SystemVector solution;
        solver->update_active();
        const SolveReport changed = solver->solve(scene.load.rhs, solution);
        discretisation.update_penalties(statuses);
        solver->update();
        const SolveReport report = solver->solve(scene.load.rhs, solution);
        const auto        n_active =
          Utilities::MPI::sum(std::count(active.begin(), active.end(), true),
                              comm);
        if (Utilities::MPI::this_mpi_process(comm) == 0)
          std::cout << std::left << std::setw(14) << name << std::right
                    << std::setw(7) << n_active << " of " << std::setw(6)
                    << discretisation.linear_system().owned_multiplier.size()
                    << "  iterations " << std::setw(4) << report.iterations
                    << (report.converged ? "" : " not converged") << "  setup "
                    << std::setprecision(3) << report.setup_seconds
                    << "  solve " << report.solve_seconds
                    << "  with the coarse levels of the set before "
                    << changed.iterations << "  setup " << changed.setup_seconds
                    << std::endl;
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  Options                                given{{"scene", "sphere"},
                                               {"p", "2"},
                                               {"law", "slide"},
                                               {"contrast", "1"},
                                               {"fine", "0"},
                                               {"n", "4"},
                                               {"nu", "0.3"},
                                               {"tolerance", "1e-8"}};
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (int i = 1; i < argc; ++i)
    {
      const std::string argument = argv[i];
      const auto        equals   = argument.find('=');
      if (equals == std::string::npos ||
          given.count(argument.substr(0, equals)) == 0)
        {
          std::cerr << "active_sets: got " << argument << "; see its source\n";
          return 2;
        }
      given[argument.substr(0, equals)] = argument.substr(equals + 1);
    }
  run(given, MPI_COMM_WORLD);
}
