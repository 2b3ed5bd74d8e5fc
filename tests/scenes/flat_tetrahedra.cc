// The proof of flat_cells.cc for tetrahedra of degree 3; a film on a block
// takes 25 iterations at most. Assertions of deal.II know no systems of such
// elements.
#include "flat_scene.h"

using namespace mortise;
using namespace mortise::testing;

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const double h : {1e-2, 1e-3})
    check("height " + std::to_string(h),
          heights(h, h) + meshes("4, 4, 3", "3, 3, 2", 3) + tetrahedra,
          15);
  check("a film",
        heights(1., 1e-3) + meshes("3, 3, 3", "4, 4, 2", 3) + tetrahedra,
        25);
}
