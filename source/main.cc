// The program: command line, parameters, one run.
#include <deal.II/base/mpi.h>

#include <mortise/base/interruption.h>
#include <mortise/problem/guard.h>
#include <mortise/problem/report_program.h>
#include <mortise/problem/run_command.h>
#include <mortise/problem/start.h>

#include <iostream>

int
main(int argc, char *argv[])
{
  mortise::prepare_process(argv);
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (const auto code = mortise::make_report_if_asked(arguments))
    return *code;
  // PETSc, which deal.II may be built with, takes all arguments for its own
  int                                      n_for_libraries = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_for_libraries, argv, 1);
  mortise::interruption::catch_signals(); // libraries have taken some of them
  mortise::interruption::share_silence(MPI_COMM_WORLD);
  return mortise::run_guarded(
    MPI_COMM_WORLD,
    [&] {
      mortise::run_command(mortise::parse_command_line(arguments),
                           MPI_COMM_WORLD);
    },
    std::cerr);
}
