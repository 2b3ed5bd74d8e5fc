#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/interruption.h>
#include <mortise/problem/boundary_list.h>
#include <mortise/problem/import/deck_import.h>
#include <mortise/problem/input/examples.h>
#include <mortise/problem/input/parameter_schema.h>
#include <mortise/problem/mesh_info.h>
#include <mortise/problem/pair_list.h>
#include <mortise/problem/run_command.h>
#include <mortise/problem/simulation.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <optional>

namespace mortise
{
  namespace
  {
    /// May lines be written again? mpirun gives its ranks a terminal wherever
    /// it writes itself.
    bool
    has_terminal(const MPI_Comm comm)
    {
      const char *const kind = std::getenv("TERM");
      return dealii::Utilities::MPI::n_mpi_processes(comm) == 1 &&
             std::getenv("OMPI_COMM_WORLD_RANK") == nullptr &&
             isatty(STDOUT_FILENO) != 0 && kind != nullptr &&
             std::string(kind) != "dumb";
    }

    void
    run_scene(const CommandLine &command, const MPI_Comm comm)
    {
      std::optional<RunCheckpoint> checkpoint;
      if (!command.restart.empty())
        checkpoint = read_run_checkpoint(command.restart, comm);
      const Parameters parameters =
        checkpoint ?
          restart_parameters(*checkpoint, command.settings, command.restart) :
          read_parameters(command.file, command.settings, comm);
      validate(parameters);

      RunLog log(std::cout, comm, has_terminal(comm));
      if (!parameters.title.empty())
        log.line(parameters.title);
      Simulation simulation(parameters, log, comm);
      if (checkpoint)
        simulation.resume(*checkpoint, command.restart);
      if (command.action == CommandLine::Action::validate)
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
                                   interruption::what_is_complete();
    }
  } // namespace

  void
  run_command(const CommandLine &command, const MPI_Comm comm)
  {
    using Action      = CommandLine::Action;
    const bool prints = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    switch (command.action)
      {
        case Action::print_help:
          if (prints)
            std::cout << help_text();
          break;
        case Action::print_version:
          if (prints)
            std::cout << version_text();
          break;
        case Action::print_parameters:
          if (prints)
            std::cout << parameter_reference();
          break;
        case Action::print_parameters_as_json:
          if (prints)
            std::cout << parameter_reference_as_json();
          break;
        case Action::info:
        case Action::boundaries:
        case Action::pairs:
        case Action::import:
          {
            const std::string text =
              (command.action == Action::pairs ?
                 list_pairs :
               command.action == Action::info ?
                 mesh_info :
               command.action == Action::import ?
                 import_deck :
                 list_boundaries)(command.file, command.settings, comm);
            if (prints)
              std::cout << text;
            break;
          }
        case Action::example:
          {
            const std::string text = command.file.empty() ?
                                       list_of_examples() :
                                       write_example(command.file, comm);
            if (prints)
              std::cout << text;
            break;
          }
        default:
          run_scene(command, comm);
      }
    throw_if_any(what_was_not_printed(), comm);
  }
} // namespace mortise
