// Proves that every rank receives the master faces near to its slave faces,
// with their payload, and that the pairs are the same on any number of ranks,
// ranks without faces included.
#include <deal.II/base/mpi.h>

#include "synthetic_surface.h"

using namespace synthetic;
using namespace dealii;

namespace
{
  std::vector<SurfaceFace>
  part(const std::vector<SurfaceFace> &all,
       const unsigned int              rank,
       const unsigned int              n_ranks)
  {
    std::vector<SurfaceFace> result;
    for (unsigned int i = 0; i < all.size(); ++i)
      if (i * n_ranks / all.size() == rank)
        {
          result.push_back(all[i]);
          result.back().owner   = rank;
          result.back().payload = {char('a' + all[i].id % 26),
                                   char(all[i].degree)};
        }
    return result;
  }

  void
  check(const Pairing     &pairing,
        const std::string &case_name,
        const bool         only_first_has_slaves,
        const MPI_Comm     comm)
  {
    const std::string  name    = pairing.name + ", " + case_name;
    const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    const auto         slaves =
      faces(sphere(), {9, 9, 3, 0, 1, 0, 1, 1, false, 0, pairing.slave});
    const auto masters =
      faces(sphere(),
            {7, 7, 3, -.1, 1.1, -.1, 1.1, -1, false, 0, pairing.master});

    auto owned_slaves = only_first_has_slaves ? part(slaves, rank, 1) :
                                                part(slaves, rank, n_ranks);
    // Masters in another order, so that a rank needs those of others.
    auto owned_masters = part(masters, n_ranks - 1 - rank, n_ranks);
    for (auto &master : owned_masters)
      master.owner = rank;
    const auto near =
      exchange_near_faces(owned_slaves, owned_masters, SearchDistance(), comm);

    bool sorted = true, intact = true;
    for (unsigned int i = 0; i < near.size(); ++i)
      {
        sorted = sorted && (i == 0 || near[i - 1].id < near[i].id);
        intact = intact && near[i].payload.size() == 2 &&
                 near[i].payload[0] == char('a' + near[i].id % 26) &&
                 near[i].shape == pairing.master &&
                 near[i].points == masters[near[i].id].points &&
                 near[i].frame.center == masters[near[i].id].frame.center;
      }
    // The pairs and areas of this rank against those of its slaves with all
    // masters.
    std::vector<double> got, expected;
    const auto          collect = [](std::vector<double> &values) {
      return [&values](const SurfaceFace       &slave,
                       const SurfaceFace       &master,
                       const PairResult        &pair,
                       const IntegrationPoints &points) {
        values.insert(values.end(),
                               {double(slave.id),
                       double(master.id),
                       pair.area,
                       double(points.size())});
      };
    };
    const Total total = integrate(owned_slaves, near, 3, collect(got));
    integrate(owned_slaves, masters, 3, collect(expected));
    const bool     same     = got == expected;
    const double   area     = Utilities::MPI::sum(total.sum.covered_area, comm);
    const double   all_area = integrate(slaves, masters, 3).sum.covered_area;
    const unsigned pairs    = Utilities::MPI::sum(total.sum.n_pairs, comm);
    const unsigned all      = integrate(slaves, masters, 3).sum.n_pairs;
    const double   bad =
      Utilities::MPI::max((sorted && intact && same) ? 0. : 1., comm);
    const bool   too_many = only_first_has_slaves && rank > 0 && !near.empty();
    const double extra    = Utilities::MPI::max(too_many ? 1. : 0., comm);
    if (rank == 0)
      {
        verdict(name + ": sorted, intact, the same pairs as with all masters",
                bad,
                0);
        verdict(name + ": area over all ranks",
                std::abs(area / all_area - 1),
                1e-13);
        verdict(name + ": pairs over all ranks", pairs == all ? 0 : 1, 0);
        verdict(name + ": a rank without slaves receives nothing", extra, 0);
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const Pairing &pairing : pairings())
    {
      check(pairing, "both sides on all ranks", false, MPI_COMM_WORLD);
      check(pairing, "slaves on the first rank only", true, MPI_COMM_WORLD);
    }
  return 0;
}
