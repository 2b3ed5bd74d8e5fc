// The program: command line, parameters, one run.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/interruption.h>
#include <mortise/problem/guard.h>
#include <mortise/problem/input/command_line.h>
#include <mortise/problem/input/parameter_schema.h>
#include <mortise/problem/simulation.h>
#include <mortise/problem/start.h>

#include <iostream>
#include <optional>

namespace
{
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
    std::optional<mortise::RunCheckpoint> checkpoint;
    if (!command.restart.empty())
      checkpoint = mortise::read_run_checkpoint(command.restart, comm);
    const mortise::Parameters parameters =
      checkpoint ?
        mortise::restart_parameters(*checkpoint,
                                    command.settings,
                                    command.restart) :
        mortise::read_parameters(command.file, command.settings, comm);
    mortise::validate(parameters);

    mortise::RunLog log(std::cout, comm);
    if (!parameters.title.empty())
      log.line(parameters.title);
    mortise::Simulation simulation(parameters, log, comm);
    if (checkpoint)
      simulation.resume(*checkpoint, command.restart);
    if (command.action == Action::validate)
      {
        simulation.validate();
        log.line("The scene is valid.");
      }
    else
      simulation.run();
  }

  /// An error message if something printed was lost, to a full disk perhaps.
  std::string
  what_was_not_printed()
  {
    return std::cout.flush() ? "" :
                               "cannot write to the standard output; " +
                                 mortise::interruption::what_is_complete();
  }
} // namespace

int
main(int argc, char *argv[])
{
  mortise::prepare_process(argv);
  // PETSc, which deal.II may be built with, takes all arguments for its own
  int                                      n_for_libraries = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_for_libraries, argv, 1);
  mortise::interruption::catch_signals(); // libraries have taken some of them
  mortise::interruption::share_silence(MPI_COMM_WORLD);
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return mortise::run_guarded(
    MPI_COMM_WORLD,
    [&] {
      run_command(mortise::parse_command_line(arguments), MPI_COMM_WORLD);
      mortise::throw_if_any(what_was_not_printed(), MPI_COMM_WORLD);
    },
    std::cerr);
}
