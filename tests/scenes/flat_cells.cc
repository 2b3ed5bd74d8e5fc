// Proves that two tied layers of flat cells and a film on a block take 15
// iterations at most and are exact, hexahedra and tetrahedra (of degree 3:
// flat_tetrahedra.cc), meshes that match or do not, degrees that are mixed in
// one of the layers. The same on every number of ranks.
#include "flat_scene.h"

using namespace mortise;
using namespace mortise::testing;

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const double h : {1e-2, 1e-3})
    for (const unsigned int p : {1, 2, 3})
      {
        const std::string name =
          "height " + std::to_string(h) + ", degree " + std::to_string(p);
        check("matching, " + name,
              heights(h, h) + meshes("4, 4, 3", "4, 4, 3", p),
              15);
        check("3 on 4, " + name,
              heights(h, h) + meshes("3, 3, 3", "4, 4, 2", p),
              15);
        if (p < 3)
          check("tetrahedra, " + name,
                heights(h, h) + meshes("4, 4, 3", "3, 3, 2", p) + tetrahedra,
                15);
      }
  for (const std::string body : {"lower", "upper"})
    check("degree 3, in part of the " + body + " layer 4",
          heights(1e-2, 1e-2) + meshes("3, 3, 3", "4, 4, 2", 3) +
            Settings{"Body " + body + "/Degree near=0, 0, 0.01, 0.3, 4"},
          15);
  const Settings film_is_slave = {"Interface glue/Slave=upper: zmin",
                                  "Interface glue/Master=lower: zmax"};
  for (const unsigned int p : {2, 3})
    {
      const std::string name = "a film, degree " + std::to_string(p);
      const Settings film = heights(1., 1e-3) + meshes("3, 3, 3", "4, 4, 2", p);
      check(name, film, 15);
      check(name + ", the film is the slave", film + film_is_slave, 15);
      if (p < 3)
        check(name + ", tetrahedra", film + tetrahedra, 15);
    }
}
