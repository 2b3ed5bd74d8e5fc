// Speed of search, clipping and integration on one core: overlaps per second
// for meshes of growing size, triangles and quadrilaterals. Not a test: it
// prints times.
//
//   interface_integration [largest N]
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "../interface/synthetic_surface.h"

using namespace synthetic;

namespace
{
  double
  seconds()
  {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }

  void
  measure(const std::string              &name,
          const std::vector<SurfaceFace> &slaves,
          const std::vector<SurfaceFace> &masters,
          const unsigned int              degree)
  {
    const double start = seconds();
    {
      const FaceTree            tree(masters);
      std::vector<unsigned int> candidates;
      for (const auto &slave : slaves)
        tree.candidates(slave, candidates);
    }
    const double search = seconds() - start;
    const Total  total  = integrate(slaves, masters, degree);
    const double time   = seconds() - start - search;
    std::printf("%-32s %8zu %8zu %8u %9u %7.2f %9u %8.3f %8.3f %11.0f %10.2f\n",
                name.c_str(),
                slaves.size(),
                masters.size(),
                total.sum.n_pairs,
                total.sum.n_cells,
                static_cast<double>(total.sum.n_candidates) / total.sum.n_pairs,
                total.sum.n_points,
                search,
                time,
                total.sum.n_pairs / time,
                1e9 * time / total.sum.n_points);
  }
} // namespace

int
main(int argc, char **argv)
{
  const unsigned int largest = argc > 1 ? std::atoi(argv[1]) : 128;
  std::printf("%-32s %8s %8s %8s %9s %7s %9s %8s %8s %11s %10s\n",
              "case",
              "slaves",
              "masters",
              "pairs",
              "cells",
              "cand/p",
              "points",
              "search/s",
              "total/s",
              "overlaps/s",
              "ns/point");
  for (const Pairing &pairing : pairings())
    {
      for (const unsigned int degree : {1u, 2u})
        for (unsigned int n = 32; n <= largest; n *= 2)
          {
            Grid slave, master;
            slave.n_u = slave.n_v = 3 * n / 2;
            master.n_u = master.n_v = n;
            master.orientation      = -1;
            slave.shape             = pairing.slave;
            master.shape            = pairing.master;
            // The master reaches beyond the slave, so that every slave face is
            // covered.
            master.u_0 = master.v_0 = -0.2;
            master.u_1 = master.v_1 = 1.2;
            measure(pairing.name + ", flat 20 deg, p=" +
                      std::to_string(degree) + " N=" + std::to_string(n),
                    faces(plane(), slave),
                    faces(plane(20.), master),
                    degree);
          }
      for (const unsigned int degree : {1u, 2u, 3u, 4u, 6u})
        for (unsigned int n = 16; n <= largest / 2; n *= 2)
          {
            Grid slave, master;
            slave.n_u = slave.n_v = 3 * n / 2;
            master.n_u = master.n_v = n;
            slave.degree = master.degree = degree;
            master.orientation           = -1;
            slave.shape                  = pairing.slave;
            master.shape                 = pairing.master;
            measure(pairing.name + ", sphere, p=g=" + std::to_string(degree) +
                      " N=" + std::to_string(n),
                    faces(sphere(), slave),
                    faces(sphere(), master),
                    degree);
          }
    }
  return 0;
}
