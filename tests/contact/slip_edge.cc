// Proves that slip goes on to the nearest nodes that bear up to their bounds
// two fifths of what exceeds the bounds of those that begin to slip, all or
// none of equally near ones, along the force of the nearest of these, and on
// their surface alone. The nodes are dealt out to the ranks.
#include <mortise/contact/slip_edge.h>
#include <verdict.h>

using namespace mortise;
using dealii::Point;
using dealii::Tensor;

namespace
{
  /// Of what exceeds bounds, borne by other nodes.
  constexpr double borne = 0.4;

  struct Nodes
  {
    NodePositions                positions;
    std::vector<TangentialForce> forces;
  };

  /// Three nodes at x = 0, of y = -1, 0 and 1, exceed their bounds of 2 by
  /// @p excess together, the one in the middle along y, the others along x.
  /// Pairs of nodes at x = 1, ..., 8 and y = -1 and 1 have bounds of 1; their
  /// forces are 1/4 along x and y, so that each bears 3/4. As many are on
  /// another surface.
  Nodes
  draw(const double excess)
  {
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(
                         MPI_COMM_WORLD),
                       me = dealii::Utilities::MPI::this_mpi_process(
                         MPI_COMM_WORLD);
    Nodes        result;
    unsigned int number = 0;
    const auto   add    = [&](const Point<3>        &at,
                         const TangentialForce &of_node,
                         const unsigned int     surface) {
      if (number++ % n_ranks != me)
        return;
      result.positions.points.push_back(at);
      result.positions.surfaces.push_back(surface);
      result.forces.push_back(of_node);
    };
    const double       size = 2. + excess / 3.;
    const Tensor<1, 3> along({size, 0., 0.}), across({0., size, 0.});
    const Tensor<1, 3> inside({0.25, 0.25, 0.});
    for (const int y : {-1, 0, 1})
      add(Point<3>(0., y, 0.),
          {TangentialForce::begins, y == 0 ? across : along, 2.},
          1);
    for (unsigned int x = 1; x <= 8; ++x)
      for (const int y : {-1, 1})
        for (const unsigned int surface : {1, 2})
          add(Point<3>(x, y, 0.),
              {TangentialForce::may_slip, inside, 1.},
              surface);
    add(Point<3>(0.5, 1., 0.), {TangentialForce::other, inside, 1.}, 1);
    return result;
  }

  /// Verdict: @p n_pairs slip along @p direction, and nothing else.
  void
  check(const std::string  &what,
        const Nodes        &nodes,
        const unsigned int  n_pairs,
        const Tensor<1, 3> &direction)
  {
    const auto slip =
      extend_slip(nodes.positions, nodes.forces, MPI_COMM_WORLD);
    unsigned int wrong = 0;
    for (unsigned int i = 0; i < slip.size(); ++i)
      {
        const bool slips = nodes.positions.surfaces[i] == 1 &&
                           nodes.forces[i].kind == TangentialForce::may_slip &&
                           nodes.positions.points[i][0] < n_pairs + 0.5;
        const Tensor<1, 3> expected = (slips ? 1. : 0.) * direction;
        wrong += (slip[i] - expected).norm() < 1e-14 ? 0 : 1;
      }
    verdict(what + ": not so",
            dealii::Utilities::MPI::sum(wrong, MPI_COMM_WORLD),
            0);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int n_pairs : {0, 1, 3, 7})
    for (const double beyond : {0.1, 1.4}) // less than what the next pair bears
      check(std::to_string(n_pairs) + " pairs slip",
            draw((1.5 * n_pairs + beyond) / borne),
            n_pairs,
            Tensor<1, 3>({1., 0., 0.}));
  Nodes nodes = draw(3.1 / borne);
  for (Point<3> &at : nodes.positions.points)
    at[1] *= at[0] > 0.75 ? 0.1 : 1.; // nearest to the one in the middle
  check("along the nearest", nodes, 2, Tensor<1, 3>({0., 1., 0.}));
}
