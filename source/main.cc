// The program: command line, parameters, one run.
#include <deal.II/base/mpi.h>

#include <mortise/problem/command_line.h>
#include <mortise/problem/guard.h>
#include <mortise/problem/parameter_schema.h>
#include <mortise/problem/simulation.h>

#include <cstdlib>
#include <iostream>

extern "C" void
openblas_set_num_threads(int) __attribute__((weak));

namespace
{
  /// Parallelism is between ranks: threads of BLAS would fight with them for
  /// the cores (the assembly of a scene of degree 4 took four times as long).
  /// An OPENBLAS_NUM_THREADS of the user stays.
  void
  use_one_blas_thread()
  {
    if (openblas_set_num_threads != nullptr &&
        std::getenv("OPENBLAS_NUM_THREADS") == nullptr)
      openblas_set_num_threads(1);
  }

  /// A run without mpirun needs neither a daemon of Open MPI nor a network,
  /// which take a tenth and a fifth of a second to start and to look for
  /// (measured); others do not know the variables.
  void
  start_alone()
  {
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    for (const char *name : {"PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
      if (std::getenv(name) != nullptr)
        return; // one of several
    setenv("OMPI_MCA_pml", "ob1", 0);
  }

  void
  run_command(const mortise::CommandLine &command, const MPI_Comm comm)
  {
    using Action      = mortise::CommandLine::Action;
    const bool prints = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    switch (command.action)
      {
        case Action::print_help:
          if (prints)
            std::cout << mortise::help_text();
          return;
        case Action::print_version:
          if (prints)
            std::cout << mortise::version_text();
          return;
        case Action::print_parameters:
          if (prints)
            std::cout << mortise::parameter_reference();
          return;
        default:
          break;
      }
    const mortise::Parameters parameters =
      mortise::read_parameters(command.file, command.settings, comm);
    mortise::validate(parameters);

    mortise::RunLog log(std::cout, comm);
    if (!parameters.title.empty())
      log.line(parameters.title);
    mortise::Simulation simulation(parameters, log, comm);
    if (command.action == Action::validate)
      {
        mortise::check_output_directory(parameters, comm);
        simulation.create_meshes();
        log.line("The scene is valid.");
      }
    else
      simulation.run();
  }
} // namespace

int
main(int argc, char *argv[])
{
  use_one_blas_thread();
  start_alone();
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::vector<std::string>           arguments(argv + 1, argv + argc);
  return mortise::run_guarded(
    MPI_COMM_WORLD,
    [&] {
      run_command(mortise::parse_command_line(arguments), MPI_COMM_WORLD);
    },
    std::cerr);
}
