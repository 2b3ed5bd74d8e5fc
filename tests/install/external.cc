// A program of others that runs a scene with the library.
#include <deal.II/base/mpi.h>

#include <mortise/problem/simulation.h>

#include <iostream>

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const auto                               parameters =
    mortise::read_parameters(argv[1],
                             {"Output/Directory=results/external"},
                             MPI_COMM_WORLD);
  mortise::validate(parameters);
  mortise::RunLog     log(std::cout, MPI_COMM_WORLD);
  mortise::Simulation simulation(parameters, log, MPI_COMM_WORLD);
  simulation.run();
}
