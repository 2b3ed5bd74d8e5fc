// Proves that meshes of files that were not refined take few iterations, the
// same on any number of ranks: their vertices are coarsened without a coarser
// mesh.
#include <filesystem>
#include <fstream>

#include "scene.h"

using namespace mortise;
using namespace mortise::testing;

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::filesystem::path                    here =
    std::filesystem::path(__FILE__).parent_path();
  std::ifstream     file(here / "../../prm/thick_sphere_gmsh.prm");
  std::stringstream scene;
  scene << file.rdbuf();
  const std::string geometry =
    (here / "../../meshes/thick_sphere_tet.geo").string();
  Settings settings = {"Solver/Tolerance=1e-8",
                       "Body inner/Mesh/Mesh size=0.09"};
  for (const std::string body : {"inner", "outer"})
    settings = settings + Settings{"Body " + body + "/Degree=1",
                                   "Body " + body + "/Mesh/Refinements=0",
                                   "Body " + body + "/Mesh/File=" + geometry};
  settings.push_back("Body outer/Mesh/Mesh size=0.1");
  const SolverSummary solver =
    *run_scene(scene.str(), settings).steps.back().solver;
  verdict("vertices on several levels",
          solver.preconditioner->find(" levels") == std::string::npos,
          0.);
  verdict("at most 12 iterations to 1e-8", *solver.iterations, 12.);
}
