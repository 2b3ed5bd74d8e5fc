// Proves that what is tied depends neither on the order of interfaces nor on
// which side is slave, where two and three interfaces share one face of a body,
// with partners beside each other or one over the other: all orders and sides
// give exact fields, and every order the same number of multipliers.
#include <map>

#include "box_draws.h"
#include "scene.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  DrawnBox
  drawn_box(const std::string             &name,
            const std::array<double, 6>   &extent,
            const std::array<unsigned, 3> &cells,
            const unsigned int             degree)
  {
    DrawnBox box;
    box.name   = name;
    box.extent = extent;
    box.cells  = cells;
    box.degree = degree;
    return box;
  }

  /// A base with others on top from x = begin to x = end.
  DrawnScene
  scene(const std::vector<std::pair<double, double>> &tops,
        const unsigned int                            base_degree)
  {
    DrawnScene result;
    result.boxes.push_back(
      drawn_box("base", {{0., 0., 0., 1., 1., 1.}}, {{3, 3, 2}}, base_degree));
    result.boxes[0].prescribed[4] = 7;
    for (unsigned int i = 0; i < tops.size(); ++i)
      {
        result.boxes.push_back(
          drawn_box("top" + std::to_string(i),
                    {{tops[i].first, 0., 1., tops[i].second, 1., 2.}},
                    {{2 + i % 2, 4 - i, 2}},
                    1 + i));
        result.ties.push_back({"i" + std::to_string(i), {i + 1, 4}, {0, 5}});
      }
    const double G[3][3] = {{0.1, 0.03, -0.01},
                            {0.01, 0.05, 0.04},
                            {0.02, 0.06, -0.07}};
    for (unsigned int c = 0; c < 3; ++c)
      std::copy_n(G[c], 3, result.G[c]);
    return result;
  }

  void
  check(const std::string &what, const DrawnScene &plain)
  {
    double       worst = 0.;
    unsigned int n     = 0;
    // by what is slave: numbers of multipliers
    std::map<unsigned int, std::vector<std::uint64_t>> multipliers;
    std::vector<unsigned int>                          order;
    for (unsigned int i = 0; i < plain.ties.size(); ++i)
      order.push_back(i);
    do
      for (unsigned int sides = 0; sides < 1u << order.size(); ++sides)
        {
          DrawnScene scene = plain;
          for (unsigned int i = 0; i < order.size(); ++i)
            {
              scene.ties[i] = plain.ties[order[i]];
              if (sides & (1u << order[i]))
                std::swap(scene.ties[i].slave, scene.ties[i].master);
            }
          const StepSummary   step   = run_scene(scene.text(), {}).steps.back();
          const ErrorSummary &errors = *step.errors;
          worst                      = std::max({worst,
                                                 *errors.displacement_l2,
                                                 *errors.energy,
                                                 *errors.multiplier_l2});
          multipliers[sides].push_back(*step.dofs.multiplier);
          ++n;
        }
    while (std::next_permutation(order.begin(), order.end()));
    verdict(what + ", " + std::to_string(n) +
              " orders and sides: exact to 1e-10",
            worst,
            1e-10);
    unsigned int differ = 0;
    for (const auto &[sides, numbers] : multipliers)
      for (const auto number : numbers)
        differ += number != numbers.front();
    verdict(what + ": orders with another number of multipliers", differ, 0);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int degree : {1, 3})
    {
      const std::string text = ", base of degree " + std::to_string(degree);
      check("two apart" + text, scene({{0., 0.5}, {0.5, 1.}}, degree));
      check("two with a gap" + text,
            scene({{0., 1. / 3.}, {2. / 3., 1.}}, degree));
      check("two overlapping" + text,
            scene({{0., 2. / 3.}, {1. / 3., 1.}}, degree));
      check("three apart" + text,
            scene({{0., 0.25}, {0.25, 0.6}, {0.6, 1.}}, degree));
    }
}
