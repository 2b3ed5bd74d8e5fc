// Proves that stages, warnings and tables print once, aligned, on one rank, and
// that times are the largest of all ranks, with stages that only some ranks
// entered.
#include <deal.II/base/mpi.h>

#include <mortise/base/run_log.h>
#include <verdict.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <thread>

using namespace mortise;
namespace Ranks = dealii::Utilities::MPI;

namespace
{
  void
  everywhere(const bool fine, const std::string &what)
  {
    verdict(Ranks::min(fine ? 1 : 0, MPI_COMM_WORLD) == 1, what);
  }

  void
  test_timers()
  {
    const unsigned int me = Ranks::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int n  = Ranks::n_mpi_processes(MPI_COMM_WORLD);
    Timers             timers;
    timers.add("b", 1. + me);
    timers.add("b", 1.);
    if (me == n - 1)
      timers.add("last rank only", 5.);
    {
      const auto scope = timers.scope("a");
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    const auto walls = timers.walls(MPI_COMM_WORLD);
    everywhere(walls.size() == 4 && walls[0].first == "total" &&
                 walls[1].first == "b",
               "names of all ranks in order of first use, total first");
    double a = 0., b = 0., last = 0.;
    for (const auto &[name, seconds] : walls)
      (name == "a"              ? a :
       name == "b"              ? b :
       name == "last rank only" ? last :
                                  a) = seconds;
    everywhere(b == 1. + n && last == 5.,
               "sums on a rank, maximum over the ranks");
    everywhere(timers.seconds("a") >= 0.02 &&
                 timers.total() >= timers.seconds("a"),
               "a scope measures its life");
    everywhere(timers.seconds("never") == 0., "a name that was never entered");
    const PeakMemory memory = peak_memory_mib(MPI_COMM_WORLD);
    everywhere(memory.max_rank > 1. &&
                 memory.sum_over_ranks >= memory.max_rank &&
                 memory.sum_over_ranks <= n * memory.max_rank,
               "peak memory: sum and maximum over the ranks");
  }

  void
  test_log()
  {
    const bool         prints = Ranks::this_mpi_process(MPI_COMM_WORLD) == 0;
    std::ostringstream out;
    RunLog             log(out, MPI_COMM_WORLD);
    Timers             timers;
    log.stage_line("interface_search", 12.345, "96 faces");
    log.stage_line("mesh", 0.1);
    log.warning("once");
    log.warning("once");
    log.table({{"body", "cells"}, {"a", "96"}, {"longer", "7"}});
    const std::string expected = "  interface search      12.35 s   96 faces\n"
                                 "  mesh                   0.10 s\n"
                                 "warning: once\n"
                                 "  body    cells\n"
                                 "  a          96\n"
                                 "  longer      7\n";
    everywhere(out.str() == (prints ? expected : ""),
               "lines as they should look, on rank 0 only");
    everywhere(log.warnings() == std::vector<std::string>{"once"},
               "warnings are kept");

    out.str("");
    {
      auto stage = log.stage(timers, "solve");
      stage.details("7 iterations");
    }
    everywhere((out.str().find("solve") != std::string::npos &&
                out.str().find("7 iterations") != std::string::npos) == prints,
               "a stage prints at its end");
    out.str("");
    try
      {
        auto stage = log.stage(timers, "fails");
        throw std::runtime_error("no");
      }
    catch (const std::runtime_error &)
      {}
    everywhere(out.str().empty(),
               "a stage that ends by an error prints nothing");
    {
      auto stage = log.stage(timers, "early");
      stage.done();
    }
    const std::string early = out.str();
    everywhere(std::count(early.begin(), early.end(), '\n') == (prints ? 1 : 0),
               "a stage that was ended early prints once");
    everywhere(timers.seconds("fails") > 0. && timers.seconds("early") > 0.,
               "stages enter the timers");
    std::ostringstream file, screen;
    {
      RunLog of_file(file, MPI_COMM_WORLD),
        of_screen(screen, MPI_COMM_WORLD, true);
      for (RunLog *one : {&of_file, &of_screen})
        {
          one->progress(0.5, 2., 3.);
          one->line("step 2");
        }
    }
    const std::string bar   = "  [###############...............] 50 % done in "
                              "2 s, about 3 s left",
                      clear = "\r\033[K";
    everywhere(file.str() ==
                 (prints ? "  50 % done in 2 s, about 3 s left\nstep 2\n" : ""),
               "progress is a line in a file");
    everywhere(screen.str() ==
                 (prints ? bar + clear + "step 2\n" + bar + clear : ""),
               "on a terminal a bar, always below the lines, gone at the end");
    everywhere(RunLog::number(0.000123456) == "0.0001235" &&
                 RunLog::number(96.) == "96",
               "numbers for people");
  }
} // namespace

int
main(int argc, char *argv[])
{
  Ranks::MPI_InitFinalize mpi(argc, argv, 1);
  test_timers();
  test_log();
  return 0;
}
