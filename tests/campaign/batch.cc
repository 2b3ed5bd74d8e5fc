// Runs many command lines of mortise in one process, or on several ranks: the
// start of a process, which takes longer than the check of a small scene, is
// spent once. Verdicts are those of the program, since all of it but the start
// is the same; whoever finds something here tries it again with the program
// itself.
//
// The file of its argument, a named pipe, has requests, each a line with the
// number of arguments, a line with a directory, and a line for each argument.
// What a run prints goes to out and err in that directory; the answer is a line
// with its exit code.
#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <mortise/base/interruption.h>
#include <mortise/problem/guard.h>
#include <mortise/problem/run_command.h>
#include <mortise/problem/start.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace
{
  /// The directory and the arguments; empty at the end of the input.
  std::vector<std::string>
  read_request(std::istream &in)
  {
    std::vector<std::string> request;
    std::string              line;
    if (!std::getline(in, line))
      return request;
    for (int left = 1 + std::stoi(line); left > 0 && std::getline(in, line);
         --left)
      request.push_back(line);
    return request;
  }

  void
  print_to(const std::string &file, const int descriptor)
  {
    const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    if (opened < 0)
      std::exit(99);
    dup2(opened, descriptor);
    close(opened);
  }
} // namespace

int
main(int argc, char *argv[])
{
  if (argc != 2)
    return 2;
  mortise::prepare_process(argv);
  int                                      n_for_libraries = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_for_libraries, argv, 1);
  mortise::interruption::catch_signals();
  mortise::interruption::share_silence(MPI_COMM_WORLD);
  const bool first =
    dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  const int     answers = dup(STDOUT_FILENO);
  std::ifstream requests;
  if (first)
    requests.open(argv[1]);
  while (true)
    {
      std::vector<std::string> request;
      if (first)
        request = read_request(requests);
      request = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, request, 0);
      if (request.empty())
        return 0;
      print_to(request[0] + "/out", STDOUT_FILENO);
      print_to(request[0] + "/err", STDERR_FILENO);
      const int code = mortise::run_guarded(
        MPI_COMM_WORLD,
        [&] {
          mortise::run_command(mortise::parse_command_line(
                                 {request.begin() + 1, request.end()}),
                               MPI_COMM_WORLD);
        },
        std::cerr);
      std::cout.flush();
      std::cerr.flush();
      MPI_Barrier(MPI_COMM_WORLD);
      const std::string answer = std::to_string(code) + "\n";
      if (first && write(answers, answer.data(), answer.size()) < 0)
        return 1;
    }
}
