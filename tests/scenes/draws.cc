// Proves that no tie is lost and no multipliers depend on each other wherever
// bodies meet around edges and points, whatever is slave, in whatever order,
// with whatever meshes and degrees: scenes drawn at random, whose linear
// displacement every mesh holds, are exact, or refused with the names of the
// interfaces where the multipliers that are left do not hold a body.
//
// With arguments (family, number, first seed, method, law, multiplier) it draws
// as many scenes as asked for and reports each that is not exact; it prints a
// scene that is the only one.
#include <mortise/base/error.h>

#include <cstdlib>
#include <functional>
#include <map>

#include "box_draws.h"
#include "scene.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  constexpr unsigned int max_drawn_degree = 4;

  const std::map<std::string, std::function<DrawnScene(BoxDraws &)>> families =
    {{"2x2x2 cubes",
      [](BoxDraws &draws) { return draws.cubes(2, max_drawn_degree); }},
     {"3x3x3 cubes", [](BoxDraws &draws) { return draws.cubes(3, 3); }},
     {"bricks",
      [](BoxDraws &draws) { return draws.bricks(5, max_drawn_degree); }},
     {"many bricks",
      [](BoxDraws &draws) { return draws.bricks(12, max_drawn_degree); }},
     {"towers", [](BoxDraws &draws) { return draws.tower(max_drawn_degree); }}};

  enum Outcome
  {
    exact,
    refused,
    wrong
  };

  /// Outcome of a scene, and the reason.
  std::pair<Outcome, std::string>
  run(const DrawnScene &scene, const std::string &method)
  {
    std::ostringstream text;
    try
      {
        const Summary summary =
          run_scene(scene.text(), {"Solver/Method=" + method});
        const ErrorSummary &errors   = *summary.steps.back().errors;
        const double        traction = errors.multiplier_l2.value_or(0.);
        text << summary.status << ", displacement " << *errors.displacement_l2
             << ", stress " << *errors.energy << ", traction " << traction;
        // tractions where moduli of 1 to 1e4 meet on cells covered by a tenth
        return {summary.status == "done" && *errors.displacement_l2 < 1e-10 &&
                    *errors.energy < 1e-10 && traction < 2e-9 ?
                  exact :
                  wrong,
                text.str()};
      }
    catch (const InputError &error)
      {
        return {std::string(error.what()).find("tied by i") !=
                    std::string::npos ?
                  refused :
                  wrong,
                error.what()};
      }
    catch (const std::exception &error)
      {
        return {wrong, error.what()};
      }
  }

  /// Draw @p n scenes of a family from seed @p first on.
  void
  check(const std::string              &family,
        const unsigned int              n,
        const unsigned int              first,
        const std::vector<std::string> &methods,
        const bool                      report,
        const std::string              &law        = "tie",
        const std::string              &multiplier = "standard")
  {
    unsigned int n_wrong = 0, n_refused = 0;
    for (unsigned int seed = first; seed < first + n; ++seed)
      {
        BoxDraws   draws(seed);
        DrawnScene scene = families.at(family)(draws);
        set_law(law, multiplier, scene);
        if (report && n == 1)
          std::cout << scene.text();
        for (const std::string &method : methods)
          {
            const auto [outcome, text] = run(scene, method);
            n_wrong += outcome == wrong;
            n_refused += outcome == refused;
            if ((outcome == wrong || (report && outcome != exact)) &&
                dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
              std::cout << family << ", seed " << seed << ", " << method << ": "
                        << text << std::endl;
          }
      }
    const std::string what =
      std::to_string(n) + " scenes of " + family + ", " + join_names(methods) +
      (law == "tie" ? "" : ", " + law) +
      (multiplier == "standard" ? "" : ", " + multiplier);
    verdict(what + ": none wrong", n_wrong, 0);
    verdict(what + ": refused at most one in twenty",
            n_refused,
            0.05 * n * methods.size());
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc > 4)
    {
      check(argv[1],
            std::atoi(argv[2]),
            std::atoi(argv[3]),
            {argv[4]},
            true,
            argc > 5 ? argv[5] : "tie",
            argc > 6 ? argv[6] : "standard");
      return 0;
    }
  const unsigned int n_ranks =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const auto share = [&](const unsigned int n) {
    return n_ranks == 1 ? n : (n + 14) / 15;
  };
  check("2x2x2 cubes", share(6), 1, {"condensed"}, false);
  check("2x2x2 cubes", share(6), 101, {"saddle point"}, false);
  check("2x2x2 cubes", share(6), 201, {"direct"}, false);
  check("3x3x3 cubes", share(3), 1, {"condensed"}, false);
  check("3x3x3 cubes", share(3), 101, {"saddle point"}, false);
  check("3x3x3 cubes", share(3), 201, {"direct"}, false);
  check("many bricks", share(4), 1, {"auto"}, false);
  check("bricks", share(8), 301, {"direct", "auto"}, false);
  check("towers", share(6), 301, {"direct", "auto"}, false);
  for (const std::string family : {"2x2x2 cubes", "bricks", "towers"})
    {
      check(family, share(6), 401, {"auto"}, false, "tie", "dual");
      check(family, share(6), 401, {"saddle point"}, false, "slide");
      check(family, share(6), 401, {"condensed"}, false, "spring");
    }
}
