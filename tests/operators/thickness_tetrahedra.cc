// The proof of thickness_matrix.cc for tetrahedra from degree 3 on, some of
// whose nodes lie on no line across the body. Assertions of deal.II know no
// systems of such elements.
#include "thickness_check.h"

int
main(int argc, char *argv[])
{
  using namespace mortise;
  using namespace mortise::testing;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int p : {3, 4, 6})
    check("tetrahedra, degree " + std::to_string(p),
          {box("tetrahedra", 0.01, {4, 7, 2})},
          p,
          2 * (4 * p + 1) * (7 * p + 1));
}
