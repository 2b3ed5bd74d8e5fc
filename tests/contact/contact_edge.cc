// Proves that contact opens up to its true edge, but for three rows of nodes,
// where it pulls as it does beside an edge that is too far out; neither beyond
// it, nor on other surfaces, nor around a spot that pulls inside; and that
// nodes of other meshes find what the nearest is. The nodes are dealt out to
// the ranks.
#include <mortise/contact/contact_edge.h>
#include <mortise/contact/contact_records.h>
#include <verdict.h>

#include <cmath>
#include <iostream>

using namespace mortise;
using dealii::Point;

namespace
{
  /// Nodes 0 <= x <= 1 in rows of distance @p h, which are three wide, and what
  /// of them is active and pulls.
  struct Strip
  {
    Strip(const double h, const MPI_Comm comm, const unsigned int surface = 1)
    {
      const unsigned int n_ranks =
                           dealii::Utilities::MPI::n_mpi_processes(comm),
                         me = dealii::Utilities::MPI::this_mpi_process(comm);
      for (unsigned int k = 0; k * h < 1. + h / 2.; ++k)
        for (unsigned int j = 0; j < 3; ++j)
          if ((3 * k + j) % n_ranks == me)
            {
              positions.points.emplace_back(k * h, j * h, 0.);
              positions.surfaces.push_back(surface);
            }
    }

    NodePositions positions;
  };

  /// The least x of the multipliers that open, if the set is active up to x
  /// = 0.8, so that it ends half a row farther, and the true edge is @p edge.
  double
  opened_from(const double h, const double edge)
  {
    const Strip       strip(h, MPI_COMM_WORLD);
    std::vector<bool> active, turns;
    for (const Point<3> &position : strip.positions.points)
      {
        const double s = 0.8 + h / 2. - position[0], d = 0.8 + h / 2. - edge;
        active.push_back(s > 0.);
        turns.push_back(s > 0. && std::sqrt(s) - d / 2. / std::sqrt(s) < 0.);
      }
    ContactEdge(strip.positions, MPI_COMM_WORLD).extend(active, turns);
    double least = 1.;
    for (unsigned int i = 0; i < turns.size(); ++i)
      if (turns[i])
        least = std::min(least, strip.positions.points[i][0]);
    return dealii::Utilities::MPI::min(least, MPI_COMM_WORLD);
  }

  /// How many more turn where those do that have a place in @p pulls.
  template <typename Pulls>
  unsigned int
  n_more(const Strip &strip, const Pulls &pulls)
  {
    std::vector<bool> active, turns;
    for (unsigned int i = 0; i < strip.positions.points.size(); ++i)
      {
        active.push_back(strip.positions.points[i][0] < 0.8);
        turns.push_back(active[i] && pulls(i));
      }
    const std::vector<bool> before = turns;
    ContactEdge(strip.positions, MPI_COMM_WORLD).extend(active, turns);
    unsigned int n = 0;
    for (unsigned int i = 0; i < turns.size(); ++i)
      n += turns[i] != before[i] ? 1 : 0;
    return dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0)
    std::cout.setstate(std::ios_base::failbit); // one rank prints
  for (const double h : {0.04, 0.02, 0.01})
    for (const double edge : {0.4, 0.6, 0.7})
      {
        // wherever it is between rows
        double too_far = -1., too_few = 0.;
        for (unsigned int shift = 0; shift < 7; ++shift)
          {
            const double true_edge = edge + 0.3 * shift * h,
                         from      = opened_from(h, true_edge);
            too_far                = std::max(too_far, true_edge - from);
            too_few                = std::max(too_few, (from - true_edge) / h);
          }
        const std::string what =
          "rows of " + std::to_string(h) + ", edge at " + std::to_string(edge);
        verdict(what + ": not too far", too_far, 1e-9);
        verdict(what + ": far enough, in rows", too_few, 3.001);
      }
  const Strip strip(0.02, MPI_COMM_WORLD);
  verdict("nothing pulls",
          n_more(strip, [](const unsigned int) { return false; }),
          0);
  verdict("a spot inside",
          n_more(strip,
                 [&](const unsigned int i) {
                   return std::fabs(strip.positions.points[i][0] - 0.3) < 0.03;
                 }),
          0);
  Strip       both = strip;
  const Strip other(0.02, MPI_COMM_WORLD, 2);
  both.positions.points.insert(both.positions.points.end(),
                               other.positions.points.begin(),
                               other.positions.points.end());
  both.positions.surfaces.insert(both.positions.surfaces.end(),
                                 other.positions.surfaces.begin(),
                                 other.positions.surfaces.end());
  verdict("another surface goes on",
          double(n_more(both,
                        [&](const unsigned int i) {
                          return both.positions.surfaces[i] == 1 &&
                                 both.positions.points[i][0] > 0.7;
                        })) -
            double(n_more(strip,
                          [&](const unsigned int i) {
                            return strip.positions.points[i][0] > 0.7;
                          })),
          0);

  // up to 0.41 on the first surface, up to 0.81 on the second
  std::vector<ContactRecord> records(both.positions.points.size());
  for (unsigned int i = 0; i < records.size(); ++i)
    {
      const double x     = both.positions.points[i][0];
      records[i].closed  = x < (both.positions.surfaces[i] == 1 ? 0.41 : 0.81);
      records[i].slip[0] = x;
    }
  const ContactRecords known(both.positions, records, {}, MPI_COMM_WORLD);
  for (const unsigned int surface : {1, 2})
    {
      const Strip  finer(0.007, MPI_COMM_WORLD, surface);
      const auto   found = known.nearest(finer.positions);
      unsigned int wrong = 0;
      for (unsigned int i = 0; i < found.size(); ++i)
        {
          const double x = finer.positions.points[i][0];
          wrong += found[i].closed != (x < 0.4 * surface + 0.01) ||
                   std::fabs(found[i].slip[0] - x) > 0.0101;
        }
      verdict("as the nearest on surface " + std::to_string(surface) +
                ": not so",
              dealii::Utilities::MPI::sum(wrong, MPI_COMM_WORLD),
              0);
    }
  // half way between a closed and an open one
  NodePositions ends;
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    ends = {{Point<3>(0., 0., 0.), Point<3>(1., 0., 0.)}, {1, 1}};
  for (const bool first : {false, true})
    {
      std::vector<ContactRecord> of_ends(ends.points.size());
      if (!of_ends.empty())
        of_ends[first ? 0 : 1].closed = true;
      const ContactRecords both_kinds(ends, of_ends, {}, MPI_COMM_WORLD);
      verdict("a closed one where two are equally near",
              both_kinds.nearest({{Point<3>(0.5, 0., 0.)}, {1}})[0].closed ?
                0. :
                1.,
              0.);
    }
  const Strip fresh(0.02, MPI_COMM_WORLD, 3);
  const auto  found = known.nearest(fresh.positions);
  verdict("all of a surface that had none press: not so",
          dealii::Utilities::MPI::sum(std::count_if(found.begin(),
                                                    found.end(),
                                                    [](const auto &record) {
                                                      return !record.closed;
                                                    }),
                                      MPI_COMM_WORLD),
          0);
}
