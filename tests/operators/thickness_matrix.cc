// Proves that the functions across the thickness of flat bodies hold all
// degrees along the plane times what is linear across it, that those of other
// bodies are of degree one but where nodes stay besides, and that their matrix
// is P^T K P, for hexahedra and tetrahedra, prescribed components included. The
// same on every number of ranks.
#include "thickness_check.h"

int
main(int argc, char *argv[])
{
  using namespace mortise;
  using namespace mortise::testing;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int p : {1, 2, 3, 4})
    check("hexahedra, degree " + std::to_string(p),
          {box("hexahedra", 0.01, {4, 7, 3})},
          p,
          2 * (4 * p + 1) * (7 * p + 1));
  // 24 steps: three parts, which end between cells
  check("hexahedra, degree 8",
        {box("hexahedra", 0.01, {2, 3, 3})},
        8,
        4 * (2 * 8 + 1) * (3 * 8 + 1));
  for (const unsigned int p : {1, 2})
    check("tetrahedra, degree " + std::to_string(p),
          {box("tetrahedra", 0.01, {4, 7, 2})},
          p,
          2 * (4 * p + 1) * (7 * p + 1));
  for (const unsigned int p : {1, 2, 3})
    check("beside a block, degree " + std::to_string(p),
          {box("hexahedra", 0.01, {4, 7, 3}),
           box("hexahedra", 4. * layer, {3, 5, 4})},
          p,
          2 * (4 * p + 1) * (7 * p + 1) + 4 * 6 * 3 +
            (3 * p + 1) * (5 * p + 1) * (p + 1));
}
