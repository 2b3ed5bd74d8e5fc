// Iterations where constraints hold on a part of the multipliers' nodes:
// active_sets [NAME=VALUE]... prints one line for each set: iterations, seconds
// of the setup with that set and of the solve. It never fails.
//   scene=sphere|blocks  p=2  law=tie|slide  contrast=1 (modulus of the slave
//   over the master's)  fine=0 (cells of the slave for each of the master's, in
//   a line; 0: about 3 : 2)  n=4 (cells in a line)  nu=0.3  tolerance=1e-8
#include <deal.II/base/mpi.h>

#include <mortise/mortar/nodal_block.h>
#include <mortise/problem/discretisation.h>
#include <mortise/problem/scene_data.h>
#include <mortise/solvers/solve.h>

#include <cmath>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>

#include "scenes/scenes.h"

using namespace dealii;
using namespace mortise;
using namespace mortise::testing;

namespace
{
  using Options = std::map<std::string, std::string>;
  using Set     = std::function<bool(const Point<dim> &)>;

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
    Settings settings{"Interface glue/Law=" + given.at("law"),
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
            for (const std::string side : {"xmin", "xmax", "ymin", "ymax"})
              settings.push_back(
                "Body " + body + "/Boundary " + side +
                "/Displacement=" + (side[0] == 'x' ? "0, -, -" : "-, 0, -"));
          }
      }
    settings.push_back("Exact solution/Displacement=");
    if (!sphere)
      {
        settings.push_back("Body lower/Boundary zmin/Displacement=-, -, 0");
        settings.push_back("Body upper/Boundary zmax/Displacement=-, -, 0.01");
        settings.push_back("Body upper/Boundary zmax/Traction=");
      }
    return settings;
  }

  /// Where the owned multipliers are: the mean of the nodes that they move.
  std::vector<Point<dim>>
  places(const Discretisation &discretisation, const MPI_Comm comm)
  {
    const IndexSet &owned = discretisation.linear_system().owned_multiplier;
    IndexSet        ghosts(owned);
    for (const Coupling &coupling : discretisation.interfaces().all())
      for (const auto &rows : coupling.multipliers->rows())
        ghosts.add_indices(rows.index.begin(), rows.index.end());
    std::vector<LinearAlgebra::distributed::Vector<double>> sums(dim + 1);
    for (auto &sum : sums)
      sum.reinit(owned, ghosts, comm);
    for (const Coupling &coupling : discretisation.interfaces().all())
      {
        const BodySurface &slave = coupling.interface->slave();
        for (unsigned int s = 0; s < slave.faces.size(); ++s)
          {
            const auto &rows = coupling.multipliers->rows()[s];
            const auto  nodes =
              face_nodes(slave.traces[s].shape, slave.traces[s].degree);
            for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
              for (unsigned int e = rows.begin[r]; e < rows.begin[r + 1]; ++e)
                {
                  const Point<dim> x =
                    face_point(slave.faces[s], nodes[r % rows.n_nodes()]);
                  const double w = std::fabs(rows.weight[e]);
                  for (unsigned int c = 0; c < dim; ++c)
                    sums[c](rows.index[e]) += w * x[c];
                  sums[dim](rows.index[e]) += w;
                }
          }
      }
    for (auto &sum : sums)
      sum.compress(VectorOperation::add);
    std::vector<Point<dim>> result(owned.n_elements());
    for (unsigned int i = 0; i < result.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        result[i][c] = sums[c].local_element(i) / sums[dim].local_element(i);
    return result;
  }

  /// A number from 0 to 1 that only the place decides.
  double
  draw(const Point<dim> &x)
  {
    double sum = 0.;
    for (unsigned int c = 0; c < dim; ++c)
      sum += std::round(1e5 * x[c]) * (12.9898 + 65.233 * c);
    const double value = std::fabs(std::sin(sum)) * 43758.5453;
    return value - std::floor(value);
  }

  std::vector<std::pair<std::string, Set>>
  sets_of(const bool sphere)
  {
    const Point<dim> centre =
      sphere ? Point<dim>(1.5 / std::sqrt(3.) * Tensor<1, dim>({1., 1., 1.})) :
               Point<dim>(0.5, 0.5, 0.5);
    const double size = sphere ? 1.5 : 1.;
    const auto   disc = [=](const double radius) {
      return
        [=](const Point<dim> &x) { return x.distance(centre) < radius * size; };
    };
    const auto board = [=](const double width) {
      return [=](const Point<dim> &x) {
        return (static_cast<int>(std::floor(x[0] / width + 0.37)) +
                static_cast<int>(std::floor(x[1] / width + 0.37))) %
                 2 ==
               0;
      };
    };
    return {{"all", [](const auto &) { return true; }},
            {"none", [](const auto &) { return false; }},
            {"random half", [](const auto &x) { return draw(x) < 0.5; }},
            {"random tenth", [](const auto &x) { return draw(x) < 0.1; }},
            {"board, fine", board(0.12 * size)},
            {"board, coarse", board(0.3 * size)},
            {"disc 0.15", disc(0.15)},
            {"disc 0.3", disc(0.3)},
            {"disc 0.32", disc(0.32)},
            {"disc 0.5", disc(0.5)}};
  }

  void
  run(const Options &given, const MPI_Comm comm)
  {
    std::string      text;
    const Settings   settings   = settings_of(given, text);
    const Parameters parameters = parse_parameters(text, "benchmark", settings);
    std::ostringstream silence;
    RunLog             log(silence, comm);
    Timers             timers;
    FieldChecks        checks;
    validate(parameters);
    const RunContext context{parameters, log, timers, comm};
    const SceneData  data(parameters, 1., checks);
    Bodies           bodies = create_meshes(context);
    Discretisation   discretisation(context, data, bodies);
    SolverOptions    options;
    options.method    = discretisation.choice().method;
    options.tolerance = std::stod(given.at("tolerance"));
    auto solver = make_linear_solver(discretisation.linear_system(), options);
    const SceneLoad load = discretisation.load(data);
    const auto      x    = places(discretisation, comm);
    auto            sets = sets_of(given.at("scene") == "sphere");
    // the node nearest to the centre of the discs, if that is one node
    double nearest = 1e300;
    for (const auto &place : x)
      nearest = std::min(nearest, place.distance(Point<dim>(0.6, 0.7, 0.9)));
    nearest = Utilities::MPI::min(nearest, comm);
    sets.emplace_back("one node", [=](const Point<dim> &place) {
      return place.distance(Point<dim>(0.6, 0.7, 0.9)) < nearest * (1. + 1e-9);
    });
    for (const auto &[name, set] : sets)
      {
        std::vector<bool> active;
        for (const auto &place : x)
          active.push_back(set(place));
        discretisation.select(active);
        solver->update();
        SystemVector      solution;
        const SolveReport report = solver->solve(load.rhs, solution);
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
                    << "  solve " << report.solve_seconds << std::endl;
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
