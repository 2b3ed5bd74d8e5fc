// Proves what contact.cc does for triangles of degree 3 and more, for which
// deal.II's assertions know no systems of elements: their multipliers are
// Bernstein coefficients.
#include "contact_scene.h"

using namespace mortise::testing;

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int p : {3, 4})
    {
      check_triangles(p);
      for (const std::string slave : {"lower", "upper"})
        check_bending("tetrahedra", slave, p);
    }
}
