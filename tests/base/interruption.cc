// Proves that a signal ends the program, as it should, also while METIS orders,
// which wants SIGTERM for itself; and that a patient program keeps the first.
#include <metis.h>
#include <mortise/base/interruption.h>
#include <sys/wait.h>
#include <unistd.h>
#include <verdict.h>

#include <csignal>
#include <iostream>
#include <string>
#include <vector>

namespace
{
  /// Order n x n x n points, each beside six others: seconds.
  int
  order_grid(const idx_t n)
  {
    std::vector<idx_t> begin = {0}, neighbours;
    for (idx_t i = 0; i < n * n * n; ++i)
      {
        for (const idx_t step : {idx_t(1), n, n * n})
          {
            const idx_t place = i / step % n;
            if (place > 0)
              neighbours.push_back(i - step);
            if (place < n - 1)
              neighbours.push_back(i + step);
          }
        begin.push_back(neighbours.size());
      }
    idx_t              size = n * n * n;
    std::vector<idx_t> order(size), place(size);
    return METIS_NodeND(&size,
                        begin.data(),
                        neighbours.data(),
                        nullptr,
                        nullptr,
                        order.data(),
                        place.data());
  }

  struct Ended
  {
    int         code;
    std::string printed;
  };

  /// A process that orders and gets @p signal meanwhile, @p times. A @p patient one
  /// that comes to its end has the exit code 0 if it knows of the signal then.
  Ended
  interrupt(const int          signal,
            const bool         patient = false,
            const unsigned int times   = 1)
  {
    int errors[2];
    if (pipe(errors) != 0)
      return {-1, "no pipe"};
    const pid_t child = fork();
    if (child == 0)
      {
        dup2(errors[1], STDERR_FILENO);
        mortise::interruption::catch_signals();
        mortise::interruption::be_patient(patient);
        if (write(STDERR_FILENO, "!", 1) != 1)
          _exit(1);
        const bool done = order_grid(patient ? 80 : 100) == METIS_OK;
        _exit(done && mortise::interruption::agreed_signal(MPI_COMM_SELF) ==
                        signal ?
                0 :
                1);
      }
    close(errors[1]);
    std::string printed;
    char        c;
    if (read(errors[0], &c, 1) == 1)
      {
        for (unsigned int time = 0; time < times; ++time)
          {
            usleep(time == 0 ? 500000 : 200000);
            kill(child, signal);
          }
      }
    while (read(errors[0], &c, 1) == 1)
      printed += c;
    close(errors[0]);
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status),
            printed};
  }
} // namespace

int
main()
{
  verdict(order_grid(10) == METIS_OK,
          "METIS orders without anyone who catches");
  mortise::interruption::catch_signals();
  verdict(order_grid(10) == METIS_OK, "METIS orders with signals caught");
  for (const auto &[signal, name] :
       {std::make_pair(SIGTERM, "SIGTERM"), std::make_pair(SIGINT, "SIGINT")})
    {
      const Ended ended = interrupt(signal);
      verdict(ended.code == 128 + signal,
              std::string(name) + " while METIS orders: the exit code");
      verdict(ended.printed == std::string("interrupted by ") + name +
                                 ": nothing was written\n",
              std::string(name) + " while METIS orders: one message");
      const Ended done = interrupt(signal, true);
      verdict(done.code == 0 && done.printed.empty(),
              std::string(name) + " is kept by a patient program",
              std::to_string(done.code) + ": " + done.printed);
      const Ended twice = interrupt(signal, true, 2);
      verdict(twice.code == 128 + signal && twice.printed == ended.printed,
              std::string(name) + " twice ends it",
              std::to_string(twice.code) + ": " + twice.printed);
    }
}
